#pragma once

// A check of any answer of `closest`, independent of the algorithm that found it.

#include <abut/query/closest.hpp>

namespace abut {

/// The errors found in an answer. Lengths are in the unit of the shapes; errors are not negative.
template <int D>
struct Certificate {
    double margin = 0;  ///< the tolerance of an answer about this pair: 1e-5 of the size of the smaller shape, and 16
                        ///< ulp of a float as large as the largest coordinate seen from A
    double plane = 0;   ///< error of the distance along the normal: of the gap between two parallel planes, one on each
                        ///< shape, or of the separating move
    double off_a = 0;   ///< how far on_a is off the surface of A along the normal, or outside of A
    double off_b = 0;
    double across = 0;      ///< how far on_b is from on_a + distance * normal
    Vec<D> common{};        ///< a point of both overlapping shapes; it needn't lie between on_a and on_b
    double off_common = 0;  ///< how far `common` is outside of either shape
    bool holds = false;     ///< each error is within the margin and the rounding of positions to floats

    explicit operator bool() const { return holds; }
};

template <int D>
Certificate<D> certify(const View<D>& a, const View<D>& b, const Closest<D>& answer);

/// Checks the answer of closest(a, b). If the shapes are apart, the separating plane and the two points beside it prove
/// the answer. If they overlap, it proves the overlap and that the depth is a separating move; it doesn't check that no
/// smaller move exists. Beside a distance function it proves the value of the function at the place that the answer
/// names, and searches once more for a lower one. Of composite shapes it checks the two parts that the answer names and
/// no others; of solids that overlap, the whole solids.
template <class A, class B>
requires Pair<A, B> Certificate<dimension<A>> certify(const A& a, const B& b, const Closest<dimension<A>>& answer) {
    constexpr int D = dimension<A>;
    return detail::with_view(a, [&](const View<D>& x) {
        return detail::with_view(b, [&](const View<D>& y) { return certify(x, y, answer); });
    });
}
template <class A, class B, class Why = detail::WhyNoPair<A, B>>
auto certify(const A& a, const B& b, const Closest<detail::dimension_or_3<A>>& answer);

}  // namespace abut
