#pragma once

// The true signed distance of two polytopes, with what it can be wrong by.
//
// A gap is the least distance between a corner, edge or face of one and of the other, and the plane across it proves
// that there is no less. A depth is the least extent of A - B over the normals of its faces: those of A, those of B,
// and across an edge of each.

#include "least_extent.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::oracle {

template <int D>
struct Truth {
    bool overlap = false;  ///< with the radii; exact for polytopes without, where asked for exactly
    double distance = 0;   ///< signed, with the radii
    DVec<D> normal{0.0};   ///< of length 1, from A to B
    double unproved = 0;   ///< by how much the gap found is above the gap proved by a plane; rounding, or a bug here
    bool rational = false;
};

/// A polytope's corners seen from some origin, with the edges and triangles between them.
template <int D>
struct Located {
    std::vector<DVec<D>> corners;
    const std::vector<std::array<std::uint32_t, 2>>& edges;
    const std::vector<std::array<std::uint32_t, 2>>& edge_directions;
    const std::vector<std::array<std::uint32_t, 3>>& triangles;

    Located(const Polytope<D>& polytope, const DVec<D>& origin)
        : corners(corners_seen_from(polytope, origin)),
          edges(polytope.edges),
          edge_directions(polytope.edge_directions),
          triangles(polytope.triangles) {}

    double least(const DVec<D>& n) const {
        double result = std::numeric_limits<double>::infinity();
        for (const DVec<D>& p : corners) result = std::min(result, dot(n, p));
        return result;
    }
    double most(const DVec<D>& n) const { return -least(-n); }
};

template <int D>
DVec<D> nearest_on_segment(const DVec<D>& p, const DVec<D>& from, const DVec<D>& to) {
    const DVec<D> along = to - from;
    const double whole = dot(along, along);
    return whole > 0 ? from + along * std::clamp(dot(p - from, along) / whole, 0.0, 1.0) : from;
}

/// Where p projects into the triangle; what projects outside is nearer to an edge. The point given is always in it.
inline bool project(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, DVec<3>& on) {
    const DVec<3> normal = cross(b - a, c - a);
    const double u = dot(cross(b - a, p - a), normal), v = dot(cross(c - b, p - b), normal),
                 w = dot(cross(a - c, p - c), normal);
    // With some slack, so that nothing falls between the two triangles of a square.
    const double whole = u + v + w;
    if (!(whole > 0) || std::min({u, v, w}) < -1e-12 * whole) return false;
    on = a + (b - a) * std::clamp(w / whole, 0.0, 1.0) + (c - a) * std::clamp(u / whole, 0.0, 1.0);
    return true;
}

/// The gap between A and B along n, without their radii; below zero where they overlap along it.
template <int D>
double gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n);

template <int D>
Truth<D> truth(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic = Arithmetic::exact);

}  // namespace abut::oracle
