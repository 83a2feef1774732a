#pragma once

// The place on a convex core closest to a point, and the corner, edge or face that it lies on.
//
// Space falls into regions, one a feature: all that is closer to it than to any other (the Voronoi regions). A face
// owns the prism that stands on it, an edge the wedge between the prisms of its faces, a corner the cone that is left.
// To find the closest place is to find the region:
//
//          corner |    edge    | corner           inside, each point belongs to the nearest side
//            .....+------------+.....
//             edge|            |edge
//            .....+------------+.....
//
// After Ericson, Real-Time Collision Detection (2005), 5.1, and Mirtich, "V-Clip: fast and robust polyhedral collision
// detection" (1998). V-Clip walks from region to region; here all sides that the point is in front of are looked at,
// which is as right on slivers and flat shapes as it is elsewhere. Nothing here allocates.

#include <abut/convex/feature.hpp>
#include <abut/convex/support.hpp>

#include <span>

namespace abut {

/// All fields are always valid: point + distance * normal is the point that was asked about, to within a billionth of
/// the shape's size.
template <int D>
struct ClosestFeature {
    DVec<D> point{0.0};
    double distance = 0;            ///< below zero inside; never so for what has no inside, such as a segment
    DVec<D> normal = first_axis();  ///< of length 1, the way out; all of the shape lies behind it, seen from `point`
    FeatureKind kind = FeatureKind::vertex;
    std::uint32_t index = 0;

private:
    static constexpr DVec<D> first_axis() {
        DVec<D> result(0.0);
        result[0] = 1;
        return result;
    }
};

/// Of a segment, which may be a point; its points are 0 and 1. On the segment itself the normal is `otherwise`, or one
/// at right angles to it.
template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point);
template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point,
                                     const DVec<D>& otherwise);

/// Of a triangle, which may be a segment or a point: in 2D an area with three edges, either way round; in 3D a face of
/// no thickness.
ClosestFeature<2> closest_on_triangle(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c, const DVec<2>& point);
ClosestFeature<3> closest_on_triangle(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& point);

/// Of a box about the origin. Half extents may be zero. In 2D a side is an edge, in 3D a face.
template <int D>
ClosestFeature<D> closest_on_box(const DVec<D>& half, const DVec<D>& point);

/// Of place(polygon), the points counter-clockwise before they are placed: convex, of any number of points, which may
/// lie on a line or be the same. O(n).
ClosestFeature<2> closest_on_polygon(std::span<const Vec2> points, const DVec<2>& point, const Affine<2>& place = {});

/// Of place(polyhedron), as `Polyhedron` has its points and facets: at least one facet; flat ones, two faces back to
/// back, too. Right to the rounding of double; where faces of the hull were merged that are not quite in one plane, to
/// half of `hull_flatness` of its extent, and corners may lie before the face by all of it. O(n).
ClosestFeature<3> closest_on_polyhedron(std::span<const Vec3> points, const Facets& facets, const DVec<3>& point,
                                        const Affine<3>& place = {});

/// Whether `closest_feature` knows the core: boxes, segments, triangles, polygons and polyhedra do, and single points.
/// Discs, functions, and what is round before it is placed don't.
template <int D>
bool has_features(const Convex<D>& convex) {
    if (convex.inner_radius > 0) return false;
    return convex.core == Core::box ||
           (convex.core == Core::points && (D == 2 || convex.count <= 3 || convex.facets != nullptr));
}

/// Of the placed core, without the ball around it: take `radius` off the distance, and move the point along the normal.
/// Where the placement is similar (poses, uniform scales, mirrors) the point is seen from the shape's own frame; else
/// the corners are placed, and what is stretched flat is answered as the flat shape it is. Only where `has_features`.
template <int D>
ClosestFeature<D> closest_feature(const Convex<D>& core, const DVec<D>& point);

}  // namespace abut
