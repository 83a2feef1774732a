#pragma once

// From faces to the hull that has them.

#include <abut/convex/hull.hpp>
#include <abut/convex/hull_faces.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// The faces in the lexicographical order of their loops, each from its lowest point number.
HullFaces in_order(const HullFaces& faces, std::size_t point_count);

/// Gives `result` the faces, and the points that occur in their loops, with new numbers.
void take_faces(Hull3& result, std::span<const Vec3> points, HullFaces faces);

/// No less than dot(normal, p) of any point, whether that is worked out exactly or in doubles; across an axis no more.
double offset_above(const Vec3& normal, std::span<const Vec3> points);

}  // namespace abut
