#pragma once

// Navigation on a surface: the player is confined to the walkable mesh instead of colliding with walls.

#include <abut/math/aabb.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/walk/point.hpp>

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

namespace abut::detail {

struct WalkMeshData;

}  // namespace abut::detail

namespace abut {

/// Faults of the input triangles of a walk mesh, and how they were treated.
struct WalkMeshReport {
    /// Triangles with the corners of another one, in either orientation; all but the first are left out.
    std::size_t duplicates = 0;
    /// Triangles without area. A neighbour was split in two, and the second half took the number.
    std::size_t flat = 0;
    /// Triangles without area whose neighbours could not be split. They are left out.
    std::size_t left_out = 0;
    /// Triangles with flipped orientation, to be consistent with their neighbours.
    std::size_t turned = 0;
    /// Edges of more than two triangles. The flattest pairs are connected; the others have a border there.
    std::size_t non_manifold_edges = 0;
    /// Edges whose triangles cannot be oriented consistently, as on a Moebius strip. They are crossed like any other.
    std::size_t mirrored = 0;
    /// Sides of triangles without a neighbour.
    std::size_t border = 0;
    /// Vertices at which triangles touch that no edge connects. Walks don't pass through them.
    std::size_t non_manifold_vertices = 0;
    /// Connected components of the surface.
    std::size_t components = 0;

    friend bool operator==(const WalkMeshReport&, const WalkMeshReport&) = default;
};

/// True if the surface was changed or cut.
bool changed(const WalkMeshReport& report);
/// A one-line summary, such as "2 components, 12 triangles turned, 40 border edges".
std::string described(const WalkMeshReport& report);

/// Options of path searches.
struct WalkPathOptions {
    /// The cost per unit of length for each area (see WalkMesh::build), such as 3 for mud and 0.5 for a road. Further
    /// areas cost 1. Costs are finite and above 0; infinity closes an area.
    std::span<const float> area_costs = {};
    std::optional<WalkAllow> allow = std::nullopt;  ///< see WalkOptions
    /// If the end is unreachable, the path leads to the reachable place nearest to it (in space).
    bool nearest_reachable = false;
};

/// A path over the surface that no small change makes cheaper.
struct WalkPath {
    /// The start, each point where the path bends in space (at an edge that isn't flat, or around a corner) or touches
    /// a border in line with it, and the end. Both ends are present even if they are equal.
    std::vector<Vec3> points;
    /// The same points as places on the mesh, each in the triangle in which the path continues.
    std::vector<WalkPoint> places;
    double length = 0;    ///< along the surface
    double cost = 0;      ///< the sum of each segment's length times the cost of its area
    bool reached = true;  ///< false: the path ends at the nearest reachable place
};

/// A triangle mesh to walk on, of any shape: floors, ceilings, loops, Moebius strips; no direction is up. A flat level
/// is a mesh with one coordinate 0. Immutable: copies share the data. All queries are const and may run on many
/// threads; only `path` and `find_path` allocate. About 128 bytes per triangle, and 40 for `nearest`.
///
/// Each triangle has its own planar frame: corner 0 is the origin, corner 1 lies on the first axis, corner 2 above it.
/// Vectors in it are `Vec2` in units of length; `to_plane` and `to_space` convert.
class WalkMesh {
public:
    /// Builds a walk mesh. Triangle i is triangle i of the input, with the same corners, except for the changes that
    /// the report counts: triangles are connected where their corners have equal coordinates, they are oriented
    /// consistently (corners 1 and 2 are exchanged), and duplicates and triangles without area are left out. `normals`
    /// is empty or has one per point, for `smooth_normal`; without them the triangles' normals are averaged. `areas` is
    /// empty or has one per triangle, for the costs of paths.
    ///
    /// A Problem if there is no triangle (empty_input), none has an area (degenerate), a coordinate is not finite or
    /// above 1e15 (not_finite, too_large), an index is out of range, there are 2^28 triangles or more (too_large), or
    /// the number of normals or areas is wrong (bad_argument). O(n log n).
    static Result<WalkMesh> build(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                                  const PointSpan<3>& normals = {}, std::span<const std::uint8_t> areas = {});

    const WalkMeshReport& report() const;
    std::span<const Vec3> points() const;             ///< as in the input
    std::span<const glm::uvec3> triangles() const;    ///< as walked on; if left out, as in the input
    bool is_walkable(std::uint32_t triangle) const;   ///< not left out
    std::uint8_t area(std::uint32_t triangle) const;  ///< 0 if no areas were given
    /// 0 to components - 1, in the order of their first triangles
    std::uint32_t component(std::uint32_t triangle) const;
    /// The neighbour across a side, and its side that is shared; nothing at a border.
    std::optional<WalkSide> beyond(const WalkSide& side) const;

    /// The closest point of the mesh, computed in double; of several, the one in the triangle with the lowest number.
    /// The cost hardly depends on the distance, up to some 10,000 times the width of the mesh. Over a hollow, where
    /// many triangles are nearly equally near, it is a few times higher.
    WalkPoint nearest(const Vec3& point) const;
    /// The same result, found faster if `last` is near it: for walkers that something else moves.
    WalkPoint nearest(const Vec3& point, const WalkPoint& last) const;
    /// Nothing if the mesh is farther away than `reach`, computed in double.
    std::optional<WalkPoint> nearest(const Vec3& point, float reach) const;
    /// The first point of the mesh along a ray, from either side, such as the floor below a point. `direction` has any
    /// length but 0; `reach` is in units of length. Edges and corners belong to the mesh, also those of the border. A
    /// ray that starts on the mesh ends there; one in the plane of a triangle ends at its side.
    std::optional<WalkPoint> nearest_along(const Vec3& point, const Vec3& direction,
                                           float reach = std::numeric_limits<float>::infinity()) const;

    Vec3 to_world(const WalkPoint& place) const;
    /// The unit normal of the triangle, on the side from which its corners are counter-clockwise.
    Vec3 normal(const WalkPoint& place) const;
    /// The interpolated unit normal of the corners; that of the triangle if they cancel out.
    Vec3 smooth_normal(const WalkPoint& place) const;

    /// Converts a vector of space to the frame of a triangle; its normal component is ignored.
    Vec2 to_plane(std::uint32_t triangle, const Vec3& vector) const;
    Vec3 to_space(std::uint32_t triangle, const Vec2& vector) const;

    /// Walks straight over the surface along a geodesic: at each edge the step is rotated by the dihedral angle. At a
    /// border it slides along, and it stops in corners; past the corner where a border turns away it continues in its
    /// original direction. The component of a step along the triangle's normal is ignored. A walk is cut short only by
    /// `max_crossings` and by corners. From a corner of triangles it walks like the limit of places in its triangle
    /// that approach the corner.
    Walked walk(const WalkPoint& place, const Vec3& step, const WalkOptions& options = {}) const;
    Walked walk(const WalkPoint& place, const Vec2& step, const WalkOptions& options = {}) const;

    /// The first elementary operation: a step up to the border of the triangle.
    WalkedInTriangle walk_in_triangle(const WalkPoint& place, const Vec3& step) const;
    WalkedInTriangle walk_in_triangle(const WalkPoint& place, const Vec2& step) const;
    /// The second elementary operation: crosses the edge that the place is on, opposite a corner of weight 0. Of two
    /// such edges, the one with a neighbour; of two with neighbours, the side with the lower number. Nothing at a
    /// border, or within a triangle.
    std::optional<EdgeCrossing> cross_edge(const WalkPoint& place) const;
    /// Crosses this side, for places at a corner. The opposite weight is 0.
    std::optional<EdgeCrossing> cross_edge(const WalkPoint& place, std::uint32_t side) const;

    /// The points of `find_path`; nothing if there is no path.
    std::optional<std::vector<Vec3>> path(const WalkPoint& from, const WalkPoint& to,
                                          const WalkPathOptions& options = {}) const;
    /// Finds a path by A* over triangles, pulled straight in the unfolded strip (a funnel) and flipped around corners
    /// wherever that is shorter.
    ///
    /// With equal costs the path is a locally shortest one (a geodesic), and mostly the global optimum: as measured,
    /// less than 0.1 % too long on hills, and up to 2 % among many holes or where every vertex is a peak or a pit. With
    /// different costs it crosses between areas where that is cheapest in its strip; mostly it is within 1 % of the
    /// optimum, at worst a tenth. No triangle is entered twice, and the path is straight within each. It neither enters
    /// nor leaves a closed area.
    ///
    /// Nothing if there is no path; between connected components this is known at once. Allocates about 200 bytes per
    /// visited triangle.
    std::optional<WalkPath> find_path(const WalkPoint& from, const WalkPoint& to,
                                      const WalkPathOptions& options = {}) const;

    /// For other parts of the library.
    const detail::WalkMeshData& data() const { return *data_; }
    explicit WalkMesh(std::shared_ptr<const detail::WalkMeshData> data) : data_(std::move(data)) {}

private:
    std::shared_ptr<const detail::WalkMeshData> data_;
};

Aabb3 bounds(const WalkMesh& mesh);

}  // namespace abut
