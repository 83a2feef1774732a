#pragma once

// The nearest point of one triangle. The search measures eight of them at once by the same operations in the same
// order, so that both tell the same bits. For .cpp files.
//
// An edge is known by the sum and the difference of its ends, as they are seen from the point: the other way round they
// give the same square, so that two triangles are equally far from where an edge or a corner that they share is
// nearest. The foot of the perpendicular is inside of the triangle where all three of its weights are above 0
// (Heidrich, "Computing the barycentric coordinates of a projected point", 2005). What is nearest is measured as a
// point of the triangle in any case: of a sliver, whose plane is hardly known, it is a little too far at most.

#include <abut/math/dvec.hpp>
#include <abut/shape/triangle.hpp>

#include <algorithm>

namespace abut {

struct NearestOnTriangle {
    double square = 0;             ///< of twice the distance
    double second = 0, third = 0;  ///< the weights of corners b and c there
};

/// The square of twice the distance of an edge, whose ends are seen from the point. `along` tells where it is nearest:
/// 1 at the start, -1 at the end.
inline double square_to_edge(const DVec<3>& start, const DVec<3>& end, const DVec<3>& edge, double& along) {
    const DVec<3> both = start + end;
    along = std::min(std::max(dot(both, edge) / dot(edge, edge), -1.0), 1.0);
    const DVec<3> twice = both - edge * along;
    return dot(twice, twice);
}

/// `triangle` has an area; its numbers, and the point's, are floats or not much longer.
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

}  // namespace abut
