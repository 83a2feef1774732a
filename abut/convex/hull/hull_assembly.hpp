#pragma once

// Assembles a hull from its faces.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_faces.hpp>

#include <cstddef>
#include <span>

namespace abut::detail {

/// The faces in the lexicographical order of their loops, each from its lowest point number.
HullFaces in_order(const HullFaces& faces, std::size_t point_count);

/// Moves the faces to `result` with the points of their loops, renumbered.
void take_faces(Hull3& result, std::span<const Vec3> points, HullFaces faces);

/// An upper bound of dot(normal, p) over all points, evaluated exactly or in double; along an axis it is the maximum.
double offset_above(const Vec3& normal, std::span<const Vec3> points);

}  // namespace abut::detail
