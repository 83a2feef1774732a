#pragma once

// Approximate convex decomposition of meshes.

#include <abut/math/function_ref.hpp>
#include <abut/math/point_span.hpp>
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

/// Properties of the result. They are the same on every machine.
struct DecomposeReport {
    bool closed = false;       ///< every connected component of the surface encloses a solid
    double mesh_volume = 0;    ///< sum of the volumes enclosed by closed components, even if they overlap
    double parts_volume = 0;   ///< sum of the parts' volumes, even if they overlap
    double farthest = 0;       ///< upper bound of the distance of a surface point from the nearest part; only rounding
    std::size_t vertices = 0;  ///< total number of the parts' vertices
    std::vector<double> concavity;  ///< one per part, in units of the option; an upper bound for merged parts
};

struct DecomposeOptions {
    /// Maximum number of parts, at least 1. Fewer are returned if they suffice.
    std::uint32_t max_parts = 32;

    /// Threshold of concavity, at least 0, as a share of half the longest side of the mesh's bounding box. Parts within
    /// it are not cut further, and parts are merged if the result stays within it. It is CoACD's threshold with its
    /// scale.
    ///
    /// The concavity is the larger of two lengths: the Hausdorff distance from the hull's surface to the piece, and 0.3
    /// times the radius of a ball with the volume that the hull adds. Components that are convex already are not merged
    /// with others. The Hausdorff distance has a precision of a tenth of the threshold, but at least 0.003; for merged
    /// parts it is an upper bound with half the threshold as precision. The effect of `max_vertices` is not included.
    /// With a threshold below 0.003, convex pieces may be cut once more.
    double concavity = 0.05;

    /// Maximum number of vertices of a part, above 3; 0: no limit. A part with more is replaced by a larger one, which
    /// may exceed `concavity`.
    std::uint32_t max_vertices = 64;

    /// Receives the share of the work that is done, in [0, 1], never decreasing; returning false cancels.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    DecomposeReport* report = nullptr;  ///< optional output
};

/// Decomposes a mesh into convex parts that cover it: every point of the surface and everything that closed surfaces
/// enclose, to within `DecomposeReport::farthest`. A mesh of convex bodies, connected or not, is decomposed into
/// exactly these.
///
/// Points with equal coordinates are welded, and each connected component of the surface is decomposed by itself. A
/// component is solid if it is closed (every edge is traversed equally often in both directions) and oriented outwards;
/// one inside it that is oriented inwards is a cavity. Any other component is a thin shell, and its parts may be flat.
/// Triangles with two equal corners are ignored.
///
/// A Problem if no triangle is left (`empty_input`), an index names no point (`index_out_of_range`, with the triangle's
/// number), a point is NaN or infinite (`not_finite`), an option is outside its limits (`bad_argument`), or `progress`
/// returned false (`cancelled`).
///
/// The piece whose hull adds the most volume is cut by the plane that leaves the least to cut, with a lookahead of one
/// cut. At last, parts that were cut needlessly are merged. After Wei, Liu, Ling, Su: "Approximate convex decomposition
/// for 3D meshes with collision-aware concavity and tree search" (2022), with other measures: docs/decompose.md.
Result<std::vector<Polyhedron>> decompose(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                                          const DecomposeOptions& options = {});
Result<std::vector<Polyhedron>> decompose(const Mesh& mesh, const DecomposeOptions& options = {});

}  // namespace abut
