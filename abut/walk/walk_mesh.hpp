#pragma once

// Walk mesh: the player is kept inside of the level, instead of out of its walls.

#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/walk/walk_point.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct WalkMeshData;

/// What was found in the triangles of a walk mesh, and what was done about it.
struct WalkMeshReport {
    std::size_t doubled = 0;  ///< triangles there more than once, whichever way round: all but the first left out
    std::size_t flat = 0;  ///< triangles without area: a neighbour was cut in two and the second half took the number
    std::size_t left_out = 0;  ///< triangles without area where no neighbour could be cut: left out
    std::size_t turned = 0;    ///< triangles wound the other way now, so as to agree with their neighbours
    std::size_t crowded = 0;   ///< edges of more than two triangles: those that bend least go on in one another, others
                               ///< have a border there
    std::size_t mirrored =
        0;                   ///< edges at which triangles can't be made to agree, as on a Moebius strip; crossed as any
    std::size_t border = 0;  ///< sides of triangles with nothing beyond
    std::size_t pinched = 0;  ///< points where parts of the surface meet that no edge joins; not crossed there
    std::size_t islands = 0;  ///< parts of the surface between which there is no way

    friend bool operator==(const WalkMeshReport&, const WalkMeshReport&) = default;
};

/// Whether anything of the surface was changed or cut.
bool changed(const WalkMeshReport& report);
/// One line for a person, such as "2 islands, 12 triangles turned; 40 border edges".
std::string described(const WalkMeshReport& report);

/// What a path may be asked for beside its ends.
struct WalkPathOptions {
    /// What a unit of length costs by the area of the triangle (see WalkMesh::build): mud 3, road 0.5. Areas beyond its
    /// end cost 1. Finite and above 0; infinity closes an area.
    std::span<const float> area_costs = {};
    std::optional<WalkAllow> allow = std::nullopt;  ///< as WalkOptions has it
    /// Where the end can't be reached, to the nearest place (in space) that can be.
    bool nearest_reachable = false;
};

/// A way over the surface that no small change makes cheaper.
struct WalkPath {
    /// In space: the start, each place where the way bends (at an edge that isn't flat, or round a corner) or comes to
    /// a border that lies in line with it, the end. Both ends are there where they are the same.
    std::vector<Vec3> points;
    /// The same points as places on the mesh, each in the triangle that the way goes on in.
    std::vector<WalkPoint> places;
    double length = 0;    ///< along the surface
    double cost = 0;      ///< the same, each piece times the cost of its area
    bool reached = true;  ///< false: it ends at the nearest reachable place
};

/// Triangles as a surface to walk on, of any shape: floors, ceilings, loops, Moebius strips; nothing assumes that any
/// way is up. A flat level is a mesh with one coordinate 0. Immutable: copies share the data. All questions are const
/// and may be asked by many threads; all but `path` and `find_path` allocate nothing. About 128 bytes a triangle, and
/// 40 for `nearest`.
///
/// Each triangle has a plane frame of its own: its corner 0 is the origin, its corner 1 lies on the first axis, its
/// corner 2 above it. Vectors in it, in units of length, are `Vec2`; `to_plane` and `to_space` lead there and back.
class WalkMesh {
public:
    /// Triangle i of the mesh is triangle i of the input, and its weights are those of its corners as given, but
    /// for those that the report tells of: triangles are joined where their corners are at the same positions, turned
    /// to agree with their neighbours (corners 1 and 2 exchanged), and those that are double or have no area are left
    /// out. `normals`: none, or one a point, for `smooth_normal`; without them those of the triangles are averaged.
    /// `areas`: none, or one a triangle, for the costs of paths.
    /// A Problem where there is no triangle (empty_input), none has an area (degenerate), a coordinate is not finite
    /// or over 1e15 (not_finite, too_large), an index is out of range, there are 2^28 triangles or more (too_large), or
    /// the normals or areas are not as many as there should be (bad_argument). O(n log n).
    static Result<WalkMesh> build(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                  std::span<const Vec3> normals = {}, std::span<const std::uint8_t> areas = {});

    const WalkMeshReport& report() const;
    std::span<const Vec3> points() const;                ///< as given
    std::span<const glm::uvec3> triangles() const;       ///< as walked on; where left out, as given
    bool is_walkable(std::uint32_t triangle) const;      ///< not left out
    std::uint8_t area(std::uint32_t triangle) const;     ///< 0 where none were given
    std::uint32_t island(std::uint32_t triangle) const;  ///< 0 to islands - 1, in the order of their first triangles
    /// The triangle beyond a side, and the side of it that is shared; nothing at a border.
    std::optional<WalkSide> beyond(const WalkSide& side) const;

    /// The nearest point of the mesh, told in double; of several, one in the triangle with the lowest number. From up
    /// to some 10,000 times as far away as the mesh is wide it costs about the same, but above a hollow, where much is
    /// nearly as near, a few times as much.
    WalkPoint nearest(const Vec3& point) const;
    /// The same answer, found sooner where `last` is near it: for walkers that are moved by something else.
    WalkPoint nearest(const Vec3& point, const WalkPoint& last) const;
    /// Nothing where the mesh is farther away than `reach`, told in double.
    std::optional<WalkPoint> nearest(const Vec3& point, float reach) const;
    /// The first point of the mesh along a ray, from either side: what am I above? `direction` is of any length but 0,
    /// `reach` in units of length. Edges and corners, the border's too, belong to the mesh; a ray that starts on it
    /// ends there, one in the plane of a triangle where it comes to its side.
    std::optional<WalkPoint> nearest_along(const Vec3& point, const Vec3& direction,
                                           float reach = std::numeric_limits<float>::infinity()) const;

    Vec3 to_world(const WalkPoint& place) const;
    /// Of the triangle, of length 1: the side from which its corners go round counter-clockwise.
    Vec3 normal(const WalkPoint& place) const;
    /// The normals of the corners, weighted, at length 1; that of the triangle where they cancel out.
    Vec3 smooth_normal(const WalkPoint& place) const;

    /// A vector of space in the frame of a triangle, what is at right angles to it left out.
    Vec2 to_plane(std::uint32_t triangle, const Vec3& vector) const;
    Vec3 to_space(std::uint32_t triangle, const Vec2& vector) const;

    /// Walks straight on over the surface: at each edge the step is turned by its bend. At a border it slides along it
    /// as long as that leads on, and stops in corners; past a border's corner that turns away it goes on as it began.
    /// What of a step of space is at right angles to the triangle is left out before. Never cut short, but for
    /// `max_crossings`, and for what a corner tells. From a corner of triangles it goes as from places in its triangle
    /// ever nearer to that corner.
    Walked walk(const WalkPoint& place, const Vec3& step, const WalkOptions& options = {}) const;
    Walked walk(const WalkPoint& place, const Vec2& step, const WalkOptions& options = {}) const;

    /// The two lower steps by themselves. First as far as the triangle goes.
    WalkedInTriangle walk_in_triangle(const WalkPoint& place, const Vec3& step) const;
    WalkedInTriangle walk_in_triangle(const WalkPoint& place, const Vec2& step) const;
    /// Then over the edge that the place is on: that which is opposite of a corner with weight 0, of two such the one
    /// with a triangle beyond it, of two of these the side with the lower number. Nothing at a border, and within a
    /// triangle.
    std::optional<EdgeCrossing> cross_edge(const WalkPoint& place) const;
    /// Over this side, for places at a corner. The place's weight opposite of it is 0.
    std::optional<EdgeCrossing> cross_edge(const WalkPoint& place, std::uint32_t side) const;

    /// The points in space of `find_path`, which see; nothing where there is no way.
    std::optional<std::vector<Vec3>> path(const WalkPoint& from, const WalkPoint& to,
                                          const WalkPathOptions& options = {}) const;
    /// Searched from triangle to triangle (A*), then pulled straight in the unfolded strip, and round corners wherever
    /// that is shorter. Where areas cost the same this is a shortest way among those near to it; mostly, not always,
    /// the shortest of all: as measured less than 0.1 % too long on hills, and up to 2 % among many holes or where
    /// every corner is a peak or a pit. Where they don't, it crosses from one to the next where that is cheapest in its
    /// strip of triangles; mostly within 1 % of the cheapest of all, by up to a tenth off. No triangle is entered
    /// twice, and within one the way is straight, whatever is cheaper beside it. No way leads into a closed area, nor
    /// out of it. Nothing where there is no way: told at once between islands. Allocates about 200 bytes for each
    /// triangle that is looked at.
    std::optional<WalkPath> find_path(const WalkPoint& from, const WalkPoint& to,
                                      const WalkPathOptions& options = {}) const;

    /// For the parts of the library, not for users.
    const WalkMeshData& data() const { return *data_; }
    explicit WalkMesh(std::shared_ptr<const WalkMeshData> data) : data_(std::move(data)) {}

private:
    std::shared_ptr<const WalkMeshData> data_;
};

Aabb3 bounds(const WalkMesh& mesh);

}  // namespace abut
