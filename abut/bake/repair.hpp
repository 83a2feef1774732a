#pragma once

// Repairs meshes: welds, orients, fills holes, removes degenerate and duplicate triangles.

#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct RepairOptions {
    double weld_distance = 0;       ///< points at most this far apart are welded; 0: only points with equal coordinates
    std::uint32_t hole_edges = 64;  ///< holes with more edges stay open; 0 leaves all open, the maximum is 1000
    /// Holes whose filling exceeds this share of the area of the connected component around them stay open, such as the
    /// opening of a cup or the border of a sheet. 0 closes only cracks, whatever their length.
    double hole_area = 0.1;
    /// Orients closed surfaces outwards and cavities inwards. Otherwise most of a surface's area keeps its orientation,
    /// such as that of an empty room that faces inwards.
    bool face_outwards = true;
};

/// Counts of the repairs, and of the remaining faults.
struct Repairs {
    /// welded with another at the same coordinates; most files have such points, at every edge
    std::size_t points_joined = 0;
    std::size_t points_welded = 0;     ///< welded with another at most `weld_distance` away
    std::size_t points_unused = 0;     ///< corners of no triangle
    std::size_t triangles_lost = 0;    ///< removed: without area, originally or after welding
    std::size_t triangles_double = 0;  ///< removed: duplicates, or walls that separate nothing
    std::size_t triangles_turned = 0;  ///< orientation flipped
    std::size_t holes_filled = 0;
    std::size_t triangles_added = 0;     ///< in holes
    std::size_t cavities = 0;            ///< closed surfaces inside a solid that bound a cavity
    std::size_t rooms = 0;               ///< closed surfaces around solids that still face inwards
    std::size_t open_edges = 0;          ///< remaining edges of one triangle
    std::size_t non_manifold_edges = 0;  ///< remaining edges of more than two triangles
    /// remaining edges of two triangles that cannot be oriented consistently, as on a Moebius strip
    std::size_t disagreeing_edges = 0;
};

/// True if the surface itself was changed. Welding points with equal coordinates and removing unused ones doesn't
/// count.
bool changed(const Repairs& repairs);

/// A one-line summary, such as "12 triangles turned, 1 hole filled; 4 open edges left", or "nothing to repair".
std::string described(const Repairs& repairs);

struct Repaired {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    /// Every edge is traversed equally often in both directions: the surface bounds a volume.
    bool closed = false;
    Repairs repairs;
};

/// Repairs a triangle soup, in this order:
/// 1. Points are welded (see `weld`) and keep their coordinates; unused ones are removed.
/// 2. Duplicate triangles are removed. A triangle that exists in both orientations is a wall seen from both sides. It
///    is removed entirely if the surface is closed without it, as between two boxes that touch.
/// 3. Neighbours are oriented consistently; most of the area of a connected component keeps its orientation. Components
///    are connected by edges of exactly two triangles. At a non-manifold edge each component is oriented by itself.
/// 4. Small holes are filled (see the options), flat if their border is flat.
/// 5. Closed surfaces are oriented outwards and cavities inwards (if `face_outwards`). A surface inside another is a
///    cavity if the two had opposite orientations, or if either was inconsistent; otherwise they are two solids, one in
///    the other. Surfaces with a boundary are unchanged.
/// 6. Triangles without area are removed; their neighbours are split so that no hole opens.
///
/// Triangles without faults keep their order; those of holes come last. A repaired closed surface with two triangles at
/// every edge is a fixed point. The result is the same on every machine. O(n log n). A Problem if there is no triangle
/// (`empty_input`), a point isn't finite or an index is out of range (with the point or triangle), no triangle has an
/// area (`degenerate`), or an option is outside its limits.
Result<Repaired> repair(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                        const RepairOptions& options = {});

}  // namespace abut
