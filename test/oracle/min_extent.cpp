#include "min_extent.hpp"

#include "axes.hpp"
#include "rational.hpp"

#include <algorithm>
#include <cmath>

namespace abut::oracle {

using namespace detail;

template <int D>
MinExtent<D> min_extent(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic) {
    const DVec<D> origin = middle(a);
    const LocalPair<double, D> approximate(a, b, origin);
    const bool flat = is_nearly_flat(approximate);
    // The bound of some twenty roundings. The errors of the unit vectors only move the axis.
    const double error_bound = 1e-14 * largest_coordinate(a, b);

    MinExtent<D> result;
    std::vector<bool> undecided;
    each_candidate_axis(approximate, flat, [&](const std::array<double, static_cast<std::size_t>(D)>& axis) {
        DVec<D> n;
        for (int i = 0; i < D; ++i) n[i] = axis[static_cast<std::size_t>(i)];
        undecided.push_back(true);
        if (length_squared(n) < 1e-280) return;
        n = normalized(n);
        std::array<double, static_cast<std::size_t>(D)> unit;
        for (int i = 0; i < D; ++i) unit[static_cast<std::size_t>(i)] = n[i];
        const std::array<double, 2> overlaps = extents(approximate, unit);
        for (const double sign : {1.0, -1.0}) {
            const double extent = overlaps[sign > 0 ? 0 : 1];
            if (extent < result.extent) {
                result.extent = extent;
                result.normal = n * sign;
            }
        }
        undecided.back() = std::min(overlaps[0], overlaps[1]) < error_bound;
    });
    result.overlap = result.extent > 0;
    if (std::abs(result.extent) > error_bound || arithmetic == Arithmetic::floating_point) return result;

    const LocalPair<Rational, D> exact(a, b, origin);
    result.rational = true;
    result.overlap = true;
    std::size_t index = 0;
    each_candidate_axis(exact, flat, [&](const std::array<Rational, static_cast<std::size_t>(D)>& axis) {
        if (!result.overlap || !undecided[index++]) return;
        const std::array<Rational, 2> overlaps = extents(exact, axis);
        result.overlap = overlaps[0] >= 0 && overlaps[1] >= 0;
    });
    return result;
}

template MinExtent<2> min_extent(const Polytope<2>&, const Polytope<2>&, Arithmetic);
template MinExtent<3> min_extent(const Polytope<3>&, const Polytope<3>&, Arithmetic);

}  // namespace abut::oracle
