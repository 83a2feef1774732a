#pragma once

// Meshes as they come, made good to work with.

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
    double weld_distance = 0;       ///< points this near to one another become one; 0: only those in the same place
    std::uint32_t hole_edges = 64;  ///< holes with more edges stay open; 0 leaves all, 1000 is the limit
    /// Holes that need more area than this share of the connected surface around them stay open: the mouth of a cup,
    /// the border of a sheet. 0 closes only cracks, whatever their length.
    double hole_area = 0.1;
    /// Closed surfaces are made to face outwards, cavities inwards. Without it they stay as most of their area is,
    /// also an empty room that is seen from inside.
    bool face_outwards = true;
};

/// What was found and changed, and what is left.
struct Repairs {
    std::size_t points_joined = 0;     ///< with another in the same place; most files have such, at every edge
    std::size_t points_welded = 0;     ///< with another at most `weld_distance` away
    std::size_t points_unused = 0;     ///< of no triangle
    std::size_t triangles_lost = 0;    ///< had no area, or had none any more once points were one
    std::size_t triangles_double = 0;  ///< there more than once, or walls that part nothing
    std::size_t triangles_turned = 0;  ///< are wound the other way now
    std::size_t holes_filled = 0;
    std::size_t triangles_added = 0;    ///< in holes
    std::size_t cavities = 0;           ///< closed surfaces inside of a solid that are no part of it
    std::size_t rooms = 0;              ///< closed surfaces around solids, left to face inwards
    std::size_t open_edges = 0;         ///< left: of one triangle
    std::size_t crowded_edges = 0;      ///< left: of more than two
    std::size_t disagreeing_edges = 0;  ///< left: of two that can't be made to agree, as on a Moebius strip
};

/// Whether the surface itself was changed; to join points in the same place and to leave out unused ones is none.
bool changed(const Repairs& repairs);

/// One line for a person, such as "12 triangles turned, 1 hole filled; 4 open edges left", or "nothing to repair".
std::string described(const Repairs& repairs);

struct Repaired {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    /// Every edge has as many triangles one way as the other: the surface bounds a volume.
    bool closed = false;
    Repairs repairs;
};

/// Makes a surface of a heap of triangles, in this order:
/// 1. Points become one (see `weld`) and keep their places; unused ones go.
/// 2. Triangles that are there more than once become one. One that is there both ways round is a wall seen from both
///    sides; where it only parts what is closed without it, as between two boxes that touch, it goes too.
/// 3. Neighbours are made to agree which way round they are; most of the area of a connected surface stays as it was.
///    Surfaces are connected by edges of exactly two triangles: at edges of more, each of those that meet there is
///    wound for itself.
/// 4. Small holes are filled (see the options), flat where their border is.
/// 5. Closed surfaces are made to face outwards, cavities inwards (if `face_outwards`). What is inside of another one
/// is
///    a cavity where the file has the two opposite ways round, or either all mixed up; else they are two solids, one in
///    the other. Surfaces with a border stay as they are.
/// 6. Triangles without area go, neighbours being cut so that nothing opens.
/// Triangles that nothing is wrong with keep their order; those of holes come last. What was repaired and is closed
/// now, with two triangles at every edge, comes back as it is. The same on every machine. O(n log n). A Problem where
/// there is no triangle (`empty_input`), where a point isn't finite or an index out of range (with the point or
/// triangle), where no triangle has an area (`degenerate`), and for options outside of their limits.
Result<Repaired> repair(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                        const RepairOptions& options = {});

}  // namespace abut
