#pragma once

// The closest point of a triangle. The search evaluates eight triangles at once by the same operations in the same
// order, so both give identical bits. For .cpp files.
//
// An edge is represented by the sum and the difference of its ends relative to the point. Reversing the edge gives the
// same square, so two triangles are equally far if the closest point is on a shared edge or corner. The perpendicular
// projection is inside the triangle if its three weights are positive (Heidrich, "Computing the barycentric coordinates
// of a projected point", 2005). The result is always measured to a point of the triangle: for slivers, whose plane is
// ill-conditioned, the error can only make it too far.

#include <abut/math/dvec.hpp>
#include <abut/shape/triangle.hpp>

#include <algorithm>

namespace abut::detail {

struct NearestOnTriangle {
    double square = 0;             ///< squared double distance
    double second = 0, third = 0;  ///< weights of corners b and c
};

/// Four times the squared distance from an edge with ends relative to the point. `along` is the parameter of the
/// closest point: 1 at the start, -1 at the end.
inline double square_to_edge(const DVec<3>& start, const DVec<3>& end, const DVec<3>& edge, double& along) {
    const DVec<3> both = start + end;
    along = std::min(std::max(dot(both, edge) / dot(edge, edge), -1.0), 1.0);
    const DVec<3> twice = both - edge * along;
    return dot(twice, twice);
}

/// `triangle` has an area. All coordinates are floats, or need few more bits.
inline NearestOnTriangle nearest_on(const Triangle3& triangle, const DVec<3>& point) {
    const DVec<3> a(triangle.a), b(triangle.b), c(triangle.c);
    const DVec<3> from_a = a - point, from_b = b - point, from_c = c - point;
    const DVec<3> ab = b - a, ac = c - a, bc = c - b;
    double along = 0;
    NearestOnTriangle result;
    result.square = square_to_edge(from_a, from_b, ab, along);
    result.second = 0.5 * (1 - along);
    const double to_bc = square_to_edge(from_b, from_c, bc, along);
    if (to_bc < result.square) result = {to_bc, 0.5 * (1 + along), 0.5 * (1 - along)};
    const double to_ac = square_to_edge(from_a, from_c, ac, along);
    if (to_ac < result.square) result = {to_ac, 0, 0.5 * (1 - along)};

    const DVec<3> normal = cross(ab, ac), turned = cross(from_a, normal);
    const double whole = dot(normal, normal), second = dot(ac, turned), third = -dot(ab, turned);
    if (second > 0 && third > 0 && whole - second - third > 0) {
        const double inverse = 1 / whole;
        const DVec<3> there = from_a + ab * (second * inverse) + ac * (third * inverse);
        const double square = 4 * dot(there, there);
        if (square < result.square) result = {square, second * inverse, third * inverse};
    }
    return result;
}

}  // namespace abut::detail
