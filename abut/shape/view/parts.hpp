#pragma once

// Composite shapes and the traversal of their convex parts in world space: overlapping a box, front to back along a ray
// or a moving box, nearest first.

#include <abut/convex/support.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/ray.hpp>

#include <cstdint>

namespace abut {

// Adjacency of parts, for the internal-edge (ghost collision) filter.
// Sides are numbered by the part's kind. Segment: 0 at its first point, 1 at its second. Triangle: i is the edge from
// corner i to the next. Tile and voxel: 2 * axis, plus one at the low end, as the faces of a box.

/// A boundary edge: no part is adjacent.
inline constexpr std::uint32_t no_neighbour = 0xffffffffu;

/// A non-manifold edge: more than two parts share it.
inline constexpr std::uint32_t many_neighbours = 0xfffffffeu;

}  // namespace abut

namespace abut::detail {

/// Receives one convex part of a composite shape and its index; returns false to stop.
template <int D>
using PartVisitor = FunctionRef<bool(const Convex<D>& part, std::uint32_t index)>;

/// Receives one convex part and its index in an ordered traversal; returns the new, shorter reach.
template <int D>
using PartReachVisitor = FunctionRef<float(const Convex<D>& part, std::uint32_t index)>;

struct MeshTree;
struct MeshSurface;

/// The composite shapes of this library, whose type a file of a Compound needs.
enum class CompositeKind : std::uint8_t {
    other,
    mesh,
    height_field,
    tile_map,
    voxel_map,
    chain,
    compound,
    solid_bsp,
    removed_child,
};

/// Each shape specialises it.
template <class S>
inline constexpr CompositeKind composite_kind = CompositeKind::other;

/// A composite shape: the union of its parts. Refers to the shape and must not outlive it.
template <int D>
struct Composite : Placement<D> {
    Aabb<D> bounds;  ///< in the local frame, before the placement
    const void* object = nullptr;
    CompositeKind kind = CompositeKind::other;  ///< the type of the object
    /// Visits at least the parts whose boxes overlap `box`, both in the local frame.
    void (*each_part)(const void* object, const Aabb<D>& box, PartVisitor<D> visit) = nullptr;
    /// Visits at least the parts whose boxes the moving box overlaps within reach, roughly front to back. Null: a query
    /// with the box around the whole motion is used.
    void (*each_part_along)(const void* object, const MovingBox<D>& box, PartReachVisitor<D> visit) = nullptr;
    /// Visits at least the parts whose boxes are within reach of `box`, roughly nearest first. Null: queries with
    /// growing boxes are used.
    void (*each_part_near)(const void* object, const Aabb<D>& box, PartReachVisitor<D> visit) = nullptr;
    /// The triangle tree if all parts are the triangles of a mesh; else null.
    const MeshTree* triangles = nullptr;
    /// The surface of a closed mesh that is solid in every query; else null.
    const MeshSurface* solid = nullptr;
    /// True if a point of the local frame is inside. Null: the shape is only the union of its parts.
    bool (*contains)(const void* object, const Vec<D>& point) = nullptr;
    /// The part adjacent to a side of a part, numbered as above. Null: unknown.
    std::uint32_t (*neighbour)(const void* object, std::uint32_t part, std::uint32_t side) = nullptr;
};

/// Visits at least the parts whose boxes overlap `box`; the box and the visited parts are in world space.
template <int D>
void each_part(const Composite<D>& composite, const Aabb<D>& box, PartVisitor<D> visit);

/// Visits at least the parts that a ray in world space hits within reach, a distance along it; roughly front to back.
template <int D>
void each_part_along(const Composite<D>& composite, const DVec<D>& origin, const DVec<D>& direction, double length,
                     PartReachVisitor<D> visit);

/// Visits at least the parts that a moving box in world space overlaps within reach; roughly front to back. The reach
/// counts lengths of `box.direction`, which has length 1.
template <int D>
void each_part_along(const Composite<D>& composite, const MovingBox<D>& box, PartReachVisitor<D> visit);

/// Visits at least the parts whose boxes are within reach of `box`, roughly nearest first; the box and the visited
/// parts are in world space. A part may be visited more than once.
template <int D>
void each_part_near(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit);

/// True if a point in world space is inside a solid composite. Its surface parts and its rounding radius are ignored.
template <int D>
bool contains_inside(const Composite<D>& composite, const Vec<D>& point);

}  // namespace abut::detail
