#pragma once

// The true signed distance of two polytopes, with a bound of its error.
//
// A gap is the least distance between a feature (corner, edge, face) of A and one of B. The separating plane
// perpendicular to it proves that no two points are closer. A depth is the least extent of the Minkowski difference
// A - B over the normals of its faces: the face normals of A and B, and the cross products of an edge of each.

#include "min_extent.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::DVec;

template <int D>
struct Truth {
    bool overlap = false;    ///< with the radii; exact for polytopes without radius and Arithmetic::exact
    double distance = 0;     ///< signed, with the radii
    DVec<D> normal{0.0};     ///< of length 1, from A to B
    double duality_gap = 0;  ///< the gap found minus the gap that a plane proves: rounding, or a bug of the oracle
    bool rational = false;
};

/// The corners of a polytope relative to some origin, with its edges and triangles.
template <int D>
struct LocalPolytope {
    std::vector<DVec<D>> corners;
    const std::vector<std::array<std::uint32_t, 2>>& edges;
    const std::vector<std::array<std::uint32_t, 2>>& edge_directions;
    const std::vector<std::array<std::uint32_t, 3>>& triangles;

    LocalPolytope(const Polytope<D>& polytope, const DVec<D>& origin)
        : corners(corners_relative_to(polytope, origin)),
          edges(polytope.edges),
          edge_directions(polytope.edge_directions),
          triangles(polytope.triangles) {}

    double min_along(const DVec<D>& n) const {
        double result = std::numeric_limits<double>::infinity();
        for (const DVec<D>& p : corners) result = std::min(result, dot(n, p));
        return result;
    }
    double max_along(const DVec<D>& n) const { return -min_along(-n); }
};

template <int D>
DVec<D> nearest_on_segment(const DVec<D>& p, const DVec<D>& from, const DVec<D>& to) {
    const DVec<D> along = to - from;
    const double length_squared = dot(along, along);
    return length_squared > 0 ? from + along * std::clamp(dot(p - from, along) / length_squared, 0.0, 1.0) : from;
}

/// Projects p onto the plane of the triangle. False if the projection is outside, where an edge is nearer. `on` is
/// always in the triangle.
inline bool project_onto_triangle(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, DVec<3>& on) {
    const DVec<3> normal = cross(b - a, c - a);
    const double u = dot(cross(b - a, p - a), normal), v = dot(cross(c - b, p - b), normal),
                 w = dot(cross(a - c, p - c), normal);
    // The tolerance keeps points from falling between the two triangles of a square.
    const double length_squared = u + v + w;
    if (!(length_squared > 0) || std::min({u, v, w}) < -1e-12 * length_squared) return false;
    on = a + (b - a) * std::clamp(w / length_squared, 0.0, 1.0) + (c - a) * std::clamp(u / length_squared, 0.0, 1.0);
    return true;
}

/// The gap between A and B along n, without their radii; below zero where they overlap along it.
template <int D>
double gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n);

template <int D>
Truth<D> truth(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic = Arithmetic::exact);

}  // namespace abut::oracle
