#pragma once

// Meshes of the primitive shapes by which files say how things collide. Each is centred at the origin.

#include <abut/io/scene.hpp>

#include <span>
#include <vector>

#include <glm/ext/vector_double3.hpp>

namespace abut::detail {

/// The number of sides of round shapes: their corners are on the shape, and their faces within 0.5 % of the radius.
inline constexpr int sides_of_round_shapes = 32;

Geometry box_mesh(const glm::dvec3& size);
Geometry sphere_mesh(double radius);
/// Around the y axis, with `height` between the centres of its ends. Their radii may differ.
Geometry capsule_mesh(double radius_bottom, double radius_top, double height);
/// Around the y axis, a cone if one radius is 0.
Geometry cylinder_mesh(double radius_bottom, double radius_top, double height);
/// A rectangle across the y axis, seen from above.
Geometry plane_mesh(double size_x, double size_z);

/// The convex hull of points; empty if they are in a plane.
Geometry hull_mesh(const std::vector<Vec3>& points);
/// The convex hull of a mesh. The mesh itself, if all its points are in a plane.
Geometry hull_mesh(const Geometry& mesh);

/// A box, not turned, and a sphere around all points of some meshes.
Geometry box_around(std::span<const Geometry> meshes);
Geometry sphere_around(std::span<const Geometry> meshes);

}  // namespace abut::detail
