#include "least_extent.hpp"

#include "axes.hpp"

#include <algorithm>
#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>

namespace abut::oracle {

template <int D>
LeastExtent<D> least_extent(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic) {
    const DVec<D> origin = middle(a);
    const Setting<double, D> rough(a, b, origin);
    const bool flat = nearly_flat(rough);
    // Some twenty roundings of numbers no larger than this, in unit vectors whose own error moves nothing but the axis.
    const double doubt = 1e-14 * largest_coordinate(a, b);

    LeastExtent<D> result;
    std::vector<bool> undecided;
    each_axis(rough, flat, [&](const std::array<double, static_cast<std::size_t>(D)>& axis) {
        DVec<D> n;
        for (int i = 0; i < D; ++i) n[i] = axis[static_cast<std::size_t>(i)];
        undecided.push_back(true);
        if (length_squared(n) < 1e-280) return;
        n = normalized(n);
        std::array<double, static_cast<std::size_t>(D)> unit;
        for (int i = 0; i < D; ++i) unit[static_cast<std::size_t>(i)] = n[i];
        const std::array<double, 2> both = extents(rough, unit);
        for (const double sign : {1.0, -1.0}) {
            const double extent = both[sign > 0 ? 0 : 1];
            if (extent < result.extent) {
                result.extent = extent;
                result.normal = n * sign;
            }
        }
        undecided.back() = std::min(both[0], both[1]) < doubt;
    });
    result.overlap = result.extent > 0;
    if (std::abs(result.extent) > doubt || arithmetic == Arithmetic::rough) return result;

    using Rational = boost::multiprecision::cpp_rational;
    const Setting<Rational, D> exact(a, b, origin);
    result.rational = true;
    result.overlap = true;
    std::size_t index = 0;
    each_axis(exact, flat, [&](const std::array<Rational, static_cast<std::size_t>(D)>& axis) {
        if (!result.overlap || !undecided[index++]) return;
        const std::array<Rational, 2> both = extents(exact, axis);
        result.overlap = both[0] >= 0 && both[1] >= 0;
    });
    return result;
}

template LeastExtent<2> least_extent(const Polytope<2>&, const Polytope<2>&, Arithmetic);
template LeastExtent<3> least_extent(const Polytope<3>&, const Polytope<3>&, Arithmetic);

}  // namespace abut::oracle
