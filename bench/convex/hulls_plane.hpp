#pragma once

// Point sets for hulls in 2D, and the peers' hulls: one file per peer. Two values per hull: area and perimeter.

#include "../bench.hpp"
#include <abut/math/dvec.hpp>

#include <memory>
#include <vector>

namespace abut::bench {

using detail::cross;
using detail::length;

using SharedPoints2 = std::shared_ptr<const std::vector<Vec2>>;

/// Writes the values of a closed polygon of consistent orientation.
template <class At>
void write_loop(std::size_t count, At at, std::span<double> values) {
    values[0] = values[1] = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const detail::DVec<2> a = at(i) - at(0), b = at(i + 1 == count ? 0 : i + 1) - at(0);
        values[0] += 0.5 * cross(a, b);
        values[1] += length(b - a);
    }
}

/// libqhull_r in double.
Side qhull_hull_2(const SharedPoints2& points);
/// convex_hull_2 and ch_akl_toussaint with exact predicates; the points are CGAL's own.
Side cgal_hull_2(const SharedPoints2& points);
Side cgal_akl_toussaint(const SharedPoints2& points);

}  // namespace abut::bench
