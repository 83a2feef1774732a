#pragma once

// Is an answer right? Any answer of `closest` can be checked by its owner, without trusting how it was found.

#include <abut/query/closest.hpp>

namespace abut {

/// What was found out about an answer. All lengths are in the unit of the shapes; errors are not below zero.
template <int D>
struct Certificate {
    double margin = 0;  ///< of doubt, how far an answer about these two may be off: 1e-5 of the size of the smaller,
                        ///< and 16 units in the last place of a float as large as the largest coordinate seen from A
    double plane = 0;   ///< error of the distance, seen along the normal: of the gap between two parallel planes, one
                        ///< on each shape, or of the move that truly parts them
    double off_a = 0;   ///< how far on_a is off the surface of A, along the normal, or outside of A
    double off_b = 0;
    double across = 0;      ///< how far on_b is from on_a + distance * normal
    Vec<D> common{};        ///< of shapes that overlap: a point of both. It needn't lie between on_a and on_b
    double off_common = 0;  ///< how far it is outside of either
    bool holds = false;     ///< each error is within the margin, and the rounding of positions to floats

    explicit operator bool() const { return holds; }
};

template <int D>
Certificate<D> certify(const View<D>& a, const View<D>& b, const Closest<D>& answer);

/// Checks the answer of closest(a, b). Where the shapes are apart that proves it: the plane between them, and the two
/// points at its sides. Where they overlap, it proves that they do and that the depth is a move that parts them; that
/// there is no smaller one is not checked. Beside a distance function it proves what the function is at the place that
/// the answer names, and looks once more for one where it is less. Of composite shapes the two parts that the answer
/// names are looked at, not all the others.
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
