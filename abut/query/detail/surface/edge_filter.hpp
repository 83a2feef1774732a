#pragma once

// The filter of internal edges (ghost collisions): the contacts of a shape with the parts of a surface. For .cpp files.
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

#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/surface/closest_points.hpp>

#include <optional>

namespace abut::detail {

/// s, as a fraction of the size of the smaller shape; the other one counts as the level.
inline constexpr double surface_probe_scale = 1e-3;

/// A contact point counts as one of the deepest if it is shallower by at most this fraction of s.
inline constexpr double deepest_tolerance = 1e-2;

/// A place on the surface of a part: the point, the part's outward unit normal, and the centre of the other shape.
template <int D>
struct SurfacePlace {
    DVec<D> point, normal, center;
};

/// A tangent plane of the union.
template <int D>
struct SurfacePlane {
    DVec<D> normal, point;
};

/// The point of a surface nearest to the centre of the shape that touches it. It is the same for all places, and found
/// on the first call.
template <int D>
struct NearestToCenter {
    ClosestPoint<D> closest;
    double within = -1;  ///< without a point, none is this near
};

/// The filter of a shape that touches a surface.
template <int D>
class EdgeFilter {
public:
    /// `surface` visits the closest points of all parts of the surface, and must outlive this. It may leave out the
    /// part that a test is about. The size is that of the smaller one of the shape and what it touches.
    EdgeFilter(EachClosestPoint<D> surface, double size) : surface_(surface), scale_(surface_probe_scale * size) {}

    /// s
    double scale() const { return scale_; }

    /// Whether the normal is one of the union's. A one-sided part covers nothing behind it. In a corner, where other
    /// parts are as near or contain the point, the test repeats farther along the part while the normal stays the same,
    /// up to the centre of the other shape. An edge that stands out by no more than rounding, 1e-5 of the size, is no
    /// edge, unless the surface has one there. `other` is a closest point on another part that is known to be near, if
    /// one is.
    bool is_surface_normal(const Part<D>& part, const SurfacePlace<D>& place, const ClosestPoint<D>& other = {}) const;
    /// A closest point on any part of the surface but those left out that is as near to p + s n as the part at p is, up
    /// to more than rounding; at an infinite distance if there is none. Then a normal of that part is a surface normal.
    ClosestPoint<D> other_near(const SurfacePlace<D>& place) const;
    /// The same without the tests farther along the part, for a point near its surface.
    bool is_surface_normal_at(const Part<D>& part, const SurfacePlace<D>& place) const;
    /// Whether the part itself has this normal at a point near its surface.
    bool has_normal(const Part<D>& part, const SurfacePlace<D>& place) const;

    /// A plane of the surface near a place whose normal is no surface normal. The search starts at the place and goes
    /// towards the centre of the other shape, which came from there. Of surfaces equally near, the part's own wins.
    /// There is none if everything up to the centre is inside.
    std::optional<SurfacePlane<D>> plane_near(const Part<D>& part, const SurfacePlace<D>& place,
                                              NearestToCenter<D>& nearest) const;
    /// Whether a plane is that of a ridge and not of a face, because the surface is far from where the shape would be
    /// deepest behind it. What lies on a ridge is deep behind any plane that touches the ridge.
    bool is_of_ridge(const Part<D>& part, const SurfacePlane<D>& plane, const DVec<D>& deepest) const;
    /// The normal of the surface nearest to a point that is about s away from it, towards the point; none if the point
    /// is inside or farther.
    std::optional<DVec<D>> normal_towards(const DVec<D>& point) const;

private:
    enum class Nearest : std::uint8_t { own, other, uncertain };
    Nearest nearest_part(const Part<D>& part, const SurfacePlace<D>& place, const DVec<D>& probe,
                         const ClosestPoint<D>& own, const ClosestPoint<D>& other = {}) const;
    std::optional<SurfacePlane<D>> plane_at(const DVec<D>& point, const ClosestPoint<D>& own,
                                            const ClosestPoint<D>& nearest) const;
    std::optional<SurfacePlane<D>> plane_towards_center(const Part<D>& part, const SurfacePlace<D>& place) const;
    ClosestPoint<D> nearest_to(const DVec<D>& point, const ClosestPoint<D>& own, double within,
                               double sufficient) const;
    ClosestPoint<D> nearest_around(const DVec<D>& point, const ClosestPoint<D>& own) const;
    bool has_plane(const ClosestPoint<D>& closest) const;
    bool has_edge(const Part<D>& part, const SurfacePlane<D>& plane) const;
    bool is_near(const Part<D>& part, const DVec<D>& point, double reach) const;

    EachClosestPoint<D> surface_;
    double scale_;
};

/// Whether a contact of this normal and depth makes another one superfluous: the normals are about equal, and for an
/// object of this size the other one is hardly deeper. A contact with a substitute normal is left out where another
/// contact covers it.
///
/// Any contact makes one of infinite size superfluous: one on a ridge of the surface that another part covers.
template <int D>
bool covers_contact(const DVec<D>& normal, double depth, const DVec<D>& other, double other_depth, double size) {
    if (!std::isfinite(size)) return true;
    const double cosine = dot(normal, other);
    if (cosine < 0.99) return false;
    return depth > other_depth - size * (surface_probe_scale + square_root(std::max(0.0, 2 * (1 - cosine))));
}

extern template class EdgeFilter<2>;
extern template class EdgeFilter<3>;

}  // namespace abut::detail
