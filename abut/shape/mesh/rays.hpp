#pragma once

// Ray casts against a mesh's tree, decided on the triangles. Not for users.

#include <abut/convex/ray/ray_entry.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/mesh/tree.hpp>

namespace abut::detail {

/// A ray in the local frame of a mesh, in float.
struct LocalRay {
    const Ray3& ray;          ///< with a direction of length 1 to within 2e-5
    double origin_error = 0;  ///< rounding error of the origin along each axis
    /// A triangle is hit only if det(corners) times the direction times this is negative; 0: two-sided.
    double facing_sign = 0;
    bool similar = true;  ///< the map to world space is a similarity
};

/// A ray in world space and in the local frame of a mesh.
struct MeshRay {
    const DRay<3>& world;  ///< ray in world space
    LocalRay local;
    double unit = 1;  ///< local length of a world-space unit
    /// Map from the mesh to the frame of the ray's origin; null: the mesh is at its own position in world space.
    const Affine<3>* to_ray = nullptr;
};

/// The first hit, in world space; of equal hits the lowest triangle.
struct MeshHit {
    RayEntry<3> entry;
    const std::uint32_t* triangle = nullptr;  ///< triangle index; null: no hit
};

/// The robust fallback if the closed form is undecided: true if the ray hits the triangle before `max_length`.
using RobustTriangleTest = FunctionRef<bool(const Triangle3& triangle, double max_length, RayEntry<3>& entry)>;

/// Finds the first hit. Returns false, without an answer, if the numbers exceed the range of floats.
bool find_first_hit(const MeshTree& tree, const MeshRay& beam, const RobustTriangleTest& undecided, MeshHit& hit);

/// Finds whether there is a hit. Returns false, without an answer, if the numbers exceed the range of floats.
bool find_any_hit(const MeshTree& tree, const MeshRay& beam, const RobustTriangleTest& undecided, bool& found);

/// Receives a hit; returns the new, shorter reach.
using MeshHitCall = FunctionRef<double(const RayEntry<3>& entry, std::uint32_t triangle)>;

/// Visits all hits within reach, roughly front to back. Returns false, without a visit, if the numbers exceed the range
/// of floats.
bool find_each_hit(const MeshTree& tree, const MeshRay& beam, const RobustTriangleTest& undecided,
                   const MeshHitCall& visit);

}  // namespace abut::detail
