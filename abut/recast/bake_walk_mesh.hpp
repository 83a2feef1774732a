#pragma once

// Walk meshes from levels: where a walker of a given size can stand and go, by Recast.

#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// What became of a level.
struct WalkMeshBakeReport {
    float cell = 0, cell_height = 0;  ///< of the grid of columns that the level was measured in
    std::size_t columns = 0;          ///< of that grid
    std::size_t polygons = 0;         ///< convex, that Recast made of the floor
    std::size_t warnings = 0;         ///< of Recast's, such as of a contour that it could not cut into polygons
    std::size_t left_out = 0;         ///< islands that no start is on
};

/// Lengths are of the level, angles in radians, as for a Mover.
struct WalkMeshBakeOptions {
    Vec3 up{0, 1, 0};         ///< of any length but 0
    float radius = 0.4f;      ///< of the walker: walls and ledges are kept away from by so much; 0 and above
    float height = 1.8f;      ///< of the walker: what is lower is no way; above `max_step`
    float max_slope = 0.87f;  ///< slopes that rise by at most this angle are floor; from 0 to 1.5
    float max_step = 0.3f;    ///< steps up to so high are climbed; 0 and above

    /// The side of the columns that the level is measured in, which are half as high: borders of the floor are right to
    /// about one and a half of it, heights of steps and passages to half of it. 0: a third of the radius, or down to a
    /// sixth for steps that are low.
    float cell = 0;

    /// Parts of the surface that are smaller than this, seen from above, are left out.
    float least_area = 0;

    /// Where there are some, islands of the mesh to which none of these is nearest are left out: roofs, the inside of
    /// walls and crates.
    std::span<const Vec3> starts = {};

    /// Triangles are floor whichever way they are wound; else those that go round counter-clockwise seen from above.
    bool both_sides = false;

    /// Is told now and then which share of the work is done, in [0, 1], never less than before; false cancels.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    WalkMeshBakeReport* report = nullptr;  ///< where wanted
};

/// The floor of a level as a surface to walk on, each triangle of which faces up. The level may be any triangles, in
/// any order, crossing or with gaps: it is measured in columns of cells, by Mononen's Recast ("Navigation mesh
/// generation via voxelization and watershed partitioning", 2009), whose polygons are cut at points every few cells and
/// joined without cracks. Corners of the mesh are on the level itself; between them it is off by less than half a cell
/// on average.
///
/// Steps are told from slopes by their heights over a cell: what rises from one cell to the next no more than the
/// steepest slope does is passed, even above `max_step`. With a step between floors the mesh is a ramp over a cell.
///
/// The same on machines where Recast, which calculates in floats, was compiled alike.
///
/// A Problem where there is no triangle or nothing to walk on (empty_input, which says what left nothing), a coordinate
/// is not finite (not_finite), an index is out of range, an option is outside of its limits (bad_argument), there are
/// more cells than 2^26 or 65,000 along a side, more than 8,000 cells of height, 250 floors above one another or 65,000
/// corners of polygons (too_large), or progress said so (cancelled).
Result<WalkMesh> bake_walk_mesh(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                const WalkMeshBakeOptions& options = {});
Result<WalkMesh> bake_walk_mesh(const Mesh& level, const WalkMeshBakeOptions& options = {});

}  // namespace abut
