#pragma once

// Point sets for hulls in 3D, and the peers' hulls: one file per peer. Two values per hull, volume and surface area,
// relative to the points' scale and to one of the vertices: so neither depends on the position.

#include "../bench.hpp"
#include <abut/math/dvec.hpp>

#include <memory>
#include <vector>

namespace abut::bench {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;

using SharedPoints = std::shared_ptr<const std::vector<Vec3>>;

/// Sums up the triangles of a closed surface, counter-clockwise seen from outside.
class SurfaceSum {
public:
    void add(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
        if (!any_) origin_ = a;
        any_ = true;
        const DVec<3> normal = cross(b - a, c - a);
        six_volumes_ += dot(normal, a - origin_);
        twice_area_ += length(normal);
    }
    void write(std::span<double> values) const {
        values[0] = six_volumes_ / 6;
        values[1] = twice_area_ / 2;
    }

private:
    DVec<3> origin_{0.0};
    double six_volumes_ = 0, twice_area_ = 0;
    bool any_ = false;
};

/// libqhull_r in double, with its recommended options: facets that rounding makes concave are merged.
Side qhull_hull(const SharedPoints& points);
/// convex_hull_3 with exact predicates.
Side cgal_hull(const SharedPoints& points);
/// btConvexHullComputer, in integers on a grid of about ten thousand steps.
Side bullet_hull(const SharedPoints& points);

}  // namespace abut::bench
