#pragma once

// Pairs of pieces of the kit, for the tests of solids.

#include "../../oracle/kit_pairs.hpp"
#include <abut/query/closest.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_mesh.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace abut::test {

inline Mesh mesh_of(const scenes::KitPiece& piece) {
    return *Mesh::build(piece.points, piece.triangles);
}

/// The kit, and its meshes.
struct Kit {
    std::vector<scenes::KitPiece> pieces = scenes::kit();
    std::vector<Mesh> meshes;

    Kit() {
        for (const scenes::KitPiece& piece : pieces) meshes.push_back(mesh_of(piece));
    }
    std::size_t random_piece(oracle::Random& random) const {
        return random.below(static_cast<std::uint32_t>(pieces.size()));
    }
};

/// Two pieces at two places, near each other.
struct KitPair {
    scenes::KitPlacement a, b;

    KitPair(const Kit& kit, oracle::Random& random)
        : a{kit.random_piece(random), scenes::kit_position(random, Vec3(0), 2)},
          b{kit.random_piece(random), scenes::kit_position(random, a.position, 2)} {}

    std::string text(const Kit& kit) const {
        const auto one = [&](const scenes::KitPlacement& placement) {
            const Vec3& p = placement.position;
            return kit.pieces[placement.piece].name + " " + std::to_string(placement.piece) + " at " +
                   std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
        };
        return one(a) + ", " + one(b);
    }
};

/// The deepest overlap of a shape with a convex part of a piece, or else the least gap.
template <class Shape>
float distance_of_parts(const scenes::KitPiece& piece, const Pose3& pose, const Shape& shape) {
    float least = std::numeric_limits<float>::infinity();
    for (const scenes::KitPart& part : piece.parts)
        least = std::min(least, closest(at(*Polyhedron::build(part.points), pose), shape).distance);
    return least;
}

/// A piece as a solid at its place, which refers to the mesh.
inline auto placed(const Kit& kit, const scenes::KitPlacement& placement) {
    return at(solid(kit.meshes[placement.piece]), Pose3{placement.position});
}

}  // namespace abut::test
