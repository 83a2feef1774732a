#pragma once

// Convex parts that stand for a mesh: approximate convex decomposition.

#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// What became of a mesh. The same on every machine.
struct DecomposeReport {
    bool closed = false;       ///< every connected surface of it encloses a solid
    double mesh_volume = 0;    ///< what the closed surfaces enclose; where bodies overlap each counts
    double parts_volume = 0;   ///< of all parts; where parts overlap each counts
    double farthest = 0;       ///< no point of the surface is farther than this from some part, which is rounding alone
    std::size_t vertices = 0;  ///< of all parts
    std::vector<double> concavity;  ///< one a part, as that of the options; of joined parts no less than it is
};

struct DecomposeOptions {
    /// There are never more parts; at least 1. Fewer where fewer are near enough.
    std::uint32_t max_parts = 32;

    /// A part is cut no further, and parts are joined, where the hull is as near as this to what it stands for, as a
    /// share of half the longest side of the mesh's box; from 0 on. That is the larger of two: the farthest way from
    /// the hull's surface to that of the piece, and 0.3 times the radius of a ball as large as what the hull adds.
    /// Bodies that are convex as they came are not joined with others. CoACD's threshold, with its scale. The first
    /// is found to a tenth of this or 0.003, whichever is more (of joined parts to half of this, of a sum that is more
    /// than it need be), both without what `max_vertices` adds: with less than 0.003, what is convex already may be cut
    /// once more.
    double concavity = 0.05;

    /// Of each part: above 3, or 0 for as many as its hull has. A part with more becomes a larger one, which may reach
    /// farther out than `concavity`.
    std::uint32_t max_vertices = 64;

    /// Is told now and then which share of the work is done, in [0, 1], never less than before; false cancels.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    DecomposeReport* report = nullptr;  ///< where wanted
};

/// Convex parts that together cover the mesh: every point of its surface, and all that closed surfaces enclose, to
/// `DecomposeReport::farthest`. What is made of convex bodies, connected or not, comes back as those.
///
/// Points in exactly the same place are one, whatever their numbers. Surfaces that are connected by these are
/// decomposed each by itself. Where one is closed (as many triangles run along each edge one way as the other) and
/// wound outwards, its parts are solid, and one inside of it wound inwards is a hollow. Any other is taken as a thin
/// shell: its parts may be flat. Triangles with two equal corners are left out. A Problem where no triangle is left
/// (`empty_input`), an index names no point (`index_out_of_range`, with the triangle's number), a point is NaN or
/// infinite (`not_finite`), an option is outside of its limits (`bad_argument`), or progress said so (`cancelled`).
///
/// Planes cut what is least convex in two, those that leave least to cut, with a look at the cuts that will follow; at
/// last what has been cut too often is joined again. After Wei, Liu, Ling, Su: "Approximate convex decomposition for 3D
/// meshes with collision-aware concavity and tree search" (2022), with other measures: docs/decompose.md.
Result<std::vector<Polyhedron>> decompose(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                          const DecomposeOptions& options = {});
Result<std::vector<Polyhedron>> decompose(const Mesh& mesh, const DecomposeOptions& options = {});

}  // namespace abut
