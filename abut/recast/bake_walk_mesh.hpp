#pragma once

// Walk meshes (navigation meshes) from levels: where a walker of a given size can stand and go, by Recast.

#include <abut/math/function_ref.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// Properties of the baked mesh.
struct WalkMeshBakeReport {
    float cell = 0, cell_height = 0;  ///< of the voxel grid
    std::size_t columns = 0;          ///< columns of the voxel grid
    std::size_t polygons = 0;         ///< convex polygons that Recast made of the floor
    std::size_t warnings = 0;         ///< Recast's warnings, such as of a contour that it could not cut into polygons
    std::size_t left_out = 0;         ///< connected components without a start
};

/// Lengths are in units of the level, angles in radians, as for a Mover.
struct WalkMeshBakeOptions {
    Vec3 up{0, 1, 0};         ///< any length but 0
    float radius = 0.4f;      ///< of the walker: distance from walls and ledges; at least 0
    float height = 1.8f;      ///< of the walker: lower passages are closed; above `max_step`
    float max_slope = 0.87f;  ///< maximum slope of the floor; from 0 to 1.5
    float max_step = 0.3f;    ///< maximum height of a step; at least 0

    /// The width of a voxel; its height is half of it. Borders of the floor have an error of about one and a half
    /// cells, heights of steps and passages of half a cell. 0: a third of the radius, down to a sixth for low steps.
    float cell = 0;

    /// Regions smaller than this, seen from above, are removed.
    float min_area = 0;

    /// If given, connected components that are not nearest to any of these points are removed: roofs, the inside of
    /// walls and crates.
    std::span<const Vec3> starts = {};

    /// Both sides of a triangle are floor; otherwise only the side from which it is counter-clockwise, seen from above.
    bool both_sides = false;

    /// Receives the share of the work that is done, in [0, 1], never decreasing; returning false cancels.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    WalkMeshBakeReport* report = nullptr;  ///< optional output
};

/// Bakes the floor of a level into a walk mesh whose triangles face up. The level may be any triangle soup,
/// self-intersecting or with gaps: it is voxelized by Mononen's Recast ("Navigation mesh generation via voxelization
/// and watershed partitioning", 2009). Recast's polygons are split at points every few cells and stitched without
/// cracks. Vertices of the mesh lie on the level; between them the mean error is less than half a cell.
///
/// Steps are distinguished from slopes by their height over a cell. A rise from one cell to the next of at most the
/// maximum slope is walkable, even above `max_step`. At a step between floors the mesh is a ramp over one cell.
///
/// Recast calculates in float, so the result is the same only on machines where it was compiled identically.
///
/// A Problem if there is no triangle or nothing to walk on (empty_input; the message says why), a coordinate is not
/// finite (not_finite), an index is out of range, an option is outside its limits (bad_argument), there are more than
/// 2^26 cells, 65,000 along a side, 8,000 cells of height, 250 floors above one another or 65,000 corners of polygons
/// (too_large), or `progress` returned false (cancelled).
Result<WalkMesh> bake_walk_mesh(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                                const WalkMeshBakeOptions& options = {});
Result<WalkMesh> bake_walk_mesh(const Mesh& level, const WalkMeshBakeOptions& options = {});

}  // namespace abut
