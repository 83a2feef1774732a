#pragma once

// Rays at a mesh's tree: what a line meets is told by the triangles themselves. Not for users.

#include <abut/convex/ray_entry.hpp>
#include <abut/math/linear.hpp>
#include <abut/shape/mesh_tree.hpp>

namespace abut {

/// A beam on its way to a mesh.
struct MeshBeam {
    const Beam<3>& beam;  ///< in the world
    const Beam<3>& own;   ///< in the mesh's own frame, where its direction is of length 1
    double unit = 1;      ///< what a length in the world is on it
    double astray = 0;    ///< how far its origin may have been rounded along each axis on the way there
    /// The mesh as it is seen from the beam's origin; null where it is in the world as it was made.
    const Affine<3>* seen = nullptr;
    /// Of a triangle that counts, det(corners) times direction times this is below zero; 0: each counts.
    double wanted_side = 0;
};

/// The first hit, in the world; of several at one place the lowest triangle.
struct MeshHit {
    RayEntry<3> entry;
    const std::uint32_t* triangle = nullptr;  ///< its number; null: nothing is hit
};

/// Where no closed form decides: whether the beam meets the triangle before `most`, and where.
using UndecidedTriangle = FunctionRef<bool(const Triangle3& triangle, double most, RayEntry<3>& entry)>;

/// False, and nothing is told, where floats can't hold the numbers.
bool find_first_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided, MeshHit& hit);

/// Is told of a hit; returns how far on they are still wanted: the new, shorter reach.
using MeshHitCall = FunctionRef<double(const RayEntry<3>& entry, std::uint32_t triangle)>;

/// All hits within reach, roughly the first first. False, and none was told, where floats can't hold the numbers.
bool find_each_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided,
                   const MeshHitCall& visit);

}  // namespace abut
