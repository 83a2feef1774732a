#pragma once

// The normals of a surface made of parts: the filter of internal edges (ghost collisions). For .cpp files.
//
// A floor of tiles has internal edges, where tile meets tile. A shape that slides over the floor may touch such an
// edge. The normal of the edge is right for the tile alone, but on the floor as a whole the shape would catch there.
// The surface of a union has at a point p exactly the normals n for which
//
//    p is the point of the union nearest to p + s n,    s small,
//
// so a normal of one part is a surface normal iff no other part is nearer to p + s n. This takes no adjacency: the
// parts may be separate shapes of a world, with gaps, T-junctions and small differences in height. An edge lower than
// about s is no edge.
//
// Other engines know the edges of one mesh, or its triangles near: the ghost vertices of Box2D's chains, Bullet's
// btInternalEdgeUtility and Jolt's InternalEdgeRemovingCollector.

#include <abut/query/detail/part_pairs.hpp>

#include <optional>

namespace abut::detail {

/// s, as a fraction of the size of the smaller shape; the other one counts as the level.
inline constexpr double surface_probe_scale = 1e-3;

/// A contact point counts as one of the deepest if it is shallower by at most this fraction of s.
inline constexpr double deepest_tolerance = 1e-2;

/// The point of a part nearest to a query point.
template <int D>
struct ClosestPoint {
    double distance = std::numeric_limits<double>::infinity();  ///< negative inside a part
    DVec<D> point{0.0};
    double behind = 0;  ///< how far the query point is behind a one-sided part; otherwise at most 0
};

/// Receives the closest points of the parts one by one. Returns the distance up to which it needs others, which never
/// grows; farther ones may still be visited.
template <int D>
using ClosestPointVisitor = FunctionRef<double(const ClosestPoint<D>& closest)>;
inline constexpr double stop_visiting = -std::numeric_limits<double>::infinity();

/// Visits the closest points of all parts that are at most `within` from the point.
template <int D>
using EachClosestPoint = FunctionRef<void(const DVec<D>& point, double within, ClosestPointVisitor<D> visit)>;

/// The nearest of all closest points, whatever the order of the visits; the query point must not be behind its part.
/// The distance is infinite if all parts are farther than `within`. `scale` is s. A point no farther than `sufficient`
/// may be returned although another is nearer.
template <int D>
ClosestPoint<D> nearest_surface_point(EachClosestPoint<D> each_closest_point, const DVec<D>& point, double within,
                                      double scale, double sufficient);

/// Of a distance function: follows the gradient by the distance.
template <int D>
ClosestPoint<D> closest_point_on(const AnyPart<D>& part, const DVec<D>& point);

/// Returns false, and leaves `closest` unspecified, if the part is farther than `within`. This is mostly cheaper than
/// the closest point.
template <int D>
bool find_closest_point(const Convex<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest);
template <int D>
bool find_closest_point(const Part<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    if (part.is_convex()) return find_closest_point(part.convex(), point, within, closest);
    closest = closest_point_on(part, point);
    return closest.distance <= within;
}

/// A box around all points within a distance, expanded by more than rounding.
template <int D>
Aabb<D> box_around(const DVec<D>& point, double within) {
    constexpr double wider = 0x1p-22;
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        const double reach = within * (1 + wider) + std::abs(point[i]) * wider;
        result.min[i] = static_cast<float>(point[i] - reach);
        result.max[i] = static_cast<float>(point[i] + reach);
    }
    return result;
}

/// Like `overlaps`, for boxes that aren't empty, without a branch for each side.
template <int D>
bool overlaps_branchless(const Aabb<D>& a, const Aabb<D>& b) {
    unsigned result = 1;
    for (int i = 0; i < D; ++i)
        result &= static_cast<unsigned>(a.min[i] <= b.max[i]) & static_cast<unsigned>(b.min[i] <= a.max[i]);
    return result != 0;
}

/// Visits the closest points of the parts of a shape.
template <int D>
void each_closest_point_on(const View<D>& shape, const DVec<D>& point, double within, ClosestPointVisitor<D> visit);

/// A place on the surface of a part: the point, the part's outward unit normal, and the centre of the other shape.
template <int D>
struct SurfacePlace {
    DVec<D> point, normal, center;
    double scale = 0;  ///< s
};

/// Whether the normal is one of the union's. A one-sided part covers nothing behind it. In a corner, where other parts
/// are as near or contain the point, the test repeats farther along the part while the normal stays the same, up to the
/// centre of the other shape. An edge that stands out by no more than rounding, 1e-5 of the size, is no edge.
template <int D>
bool is_surface_normal(const Part<D>& part, const SurfacePlace<D>& place, EachClosestPoint<D> each_closest_point);

/// Whether the part has this normal at a point near its surface.
template <int D>
bool has_normal(const Part<D>& part, const SurfacePlace<D>& place);

/// Whether the part has this normal and no other part is nearer: is_surface_normal without the tests farther along the
/// part.
template <int D>
bool is_surface_normal_at(const Part<D>& part, const SurfacePlace<D>& place, EachClosestPoint<D> each_closest_point);

/// A tangent plane of the union.
template <int D>
struct SurfacePlane {
    DVec<D> normal, point;
};

/// The point of a surface nearest to the centre of the other shape. It is the same for all places, and found on the
/// first call.
template <int D>
struct NearestToCenter {
    ClosestPoint<D> closest;
    double within = -1;  ///< without a point, none is this near
};

/// A plane of the surface near a place whose normal is no surface normal. The search starts at the place and goes
/// towards the centre of the other shape, which came from there. Of surfaces equally near, the part's own wins. There
/// is none if everything up to the centre is inside.
template <int D>
std::optional<SurfacePlane<D>> surface_plane(const Part<D>& part, const SurfacePlace<D>& place,
                                             EachClosestPoint<D> each_closest_point, NearestToCenter<D>& nearest);

/// Whether a contact of this normal and depth makes another one superfluous: the normals are about equal, and for an
/// object of this size the other one is hardly deeper.
template <int D>
bool covers_contact(const DVec<D>& normal, double depth, const DVec<D>& other, double other_depth, double size) {
    const double cosine = dot(normal, other);
    if (cosine < 0.99) return false;
    return depth > other_depth - size * (surface_probe_scale + std::sqrt(std::max(0.0, 2 * (1 - cosine))));
}

/// The centre of the box around a part; for a half-space, the nearby point itself.
template <int D>
DVec<D> middle_of(const AnyPart<D>& part, const DVec<D>& nearby) {
    return part.is_half_space() ? nearby : DVec<D>(center(bounds(part)));
}

}  // namespace abut::detail
