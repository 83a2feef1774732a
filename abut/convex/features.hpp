#pragma once

// The point on a convex core closest to a given point, and the vertex, edge or face that it lies on.
//
// Each feature has a Voronoi region: the points that are closer to it than to any other feature. The region of a face
// is the prism on it, the region of an edge the wedge between the prisms of its faces, and the region of a vertex the
// remaining cone. The closest point is found by its region:
//
//          vertex |    edge    | vertex           inside, each point belongs to the nearest side
//            .....+------------+.....
//             edge|            |edge
//            .....+------------+.....
//
// After Ericson, Real-Time Collision Detection (2005), 5.1, and Mirtich, "V-Clip: fast and robust polyhedral collision
// detection" (1998). V-Clip walks from region to region. These functions test every side that the point is in front of,
// which stays right on slivers and flat shapes. They don't allocate.

#include <abut/convex/feature.hpp>
#include <abut/convex/support.hpp>

#include <span>

namespace abut::detail {

/// All fields are always valid: point + distance * normal is the query point, to within a billionth of the shape's
/// size.
template <int D>
struct ClosestFeature {
    DVec<D> point{0.0};
    double distance = 0;  ///< below zero inside; never below zero for shapes without an inside, such as a segment
    DVec<D> normal = first_axis();  ///< of length 1, outwards; all of the shape lies behind the plane through `point`
                                    ///< with this normal
    FeatureKind kind = FeatureKind::vertex;
    std::uint32_t index = 0;

private:
    static constexpr DVec<D> first_axis() {
        DVec<D> result(0.0);
        result[0] = 1;
        return result;
    }
};

/// On a segment, which may be a point; its points are 0 and 1. For a query point on the segment the normal is
/// `otherwise`, or one orthogonal to the segment.
template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point);
template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point,
                                     const DVec<D>& otherwise);

/// On a triangle, which may be a segment or a point. In 2D it is an area with three edges, in either winding; in 3D a
/// face of no thickness.
ClosestFeature<2> closest_on_triangle(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c, const DVec<2>& point);
ClosestFeature<3> closest_on_triangle(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& point);

/// On a box about the origin. Half extents may be zero. In 2D a side is an edge, in 3D a face.
template <int D>
ClosestFeature<D> closest_on_box(const DVec<D>& half, const DVec<D>& point);

/// On place(polygon): convex, with points counter-clockwise before they are placed, any number of them, possibly
/// collinear or equal. O(n).
ClosestFeature<2> closest_on_polygon(std::span<const Vec2> points, const DVec<2>& point, const Affine<2>& place = {});

/// On place(polyhedron), with at least one facet; flat ones have two faces back to back. The result is right to the
/// rounding of double. If nearly coplanar faces of the hull were merged, it is right to half of `hull_flatness` of the
/// extent, and vertices may lie in front of the face by all of it. O(n).
ClosestFeature<3> closest_on_polyhedron(std::span<const Vec3> points, const Facets& facets, const DVec<3>& point,
                                        const Affine<3>& place = {});

/// Whether `closest_feature` handles the core: boxes, segments, triangles, polygons, polyhedra and single points.
/// Discs, functions, and cores with an inner ball have no features.
template <int D>
bool has_features(const Convex<D>& convex) {
    if (convex.inner_radius > 0) return false;
    return convex.core == Core::box ||
           (convex.core == Core::points && (D == 2 || convex.count <= 3 || convex.facets != nullptr));
}

/// On the placed core, without the ball around it: subtract `radius` from the distance, and move the point along the
/// normal. For a similarity placement (poses, uniform scales, mirrors) the query runs in the shape's own frame.
/// Otherwise the vertices are placed first, and a shape that is stretched flat is treated as flat. Requires
/// `has_features`.
template <int D>
ClosestFeature<D> closest_feature(const Convex<D>& core, const DVec<D>& point);

}  // namespace abut::detail
