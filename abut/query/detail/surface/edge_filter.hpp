#pragma once

// The filter of internal edges (ghost collisions): contacts of parts with the normals of the whole surfaces. For .cpp
// files.

#include <abut/query/detail/surface/part_cache.hpp>
#include <abut/query/detail/surface/surface_normal_flags.hpp>

namespace abut::detail {

/// The surfaces that continue each of two shapes; null: none. The functions must outlive this.
template <int D>
struct NeighbourSurfaces {
    const EachClosestPoint<D>* of_a = nullptr;  ///< what A touches beside B
    const EachClosestPoint<D>* of_b = nullptr;  ///< what B touches beside A
};

/// Filters contacts on internal edges between two shapes, to which it refers. The surface of a part is that of its
/// whole composite shape, with the neighbours.
template <int D>
class EdgeFilter {
public:
    EdgeFilter(const View<D>& a, const View<D>& b, const NeighbourSurfaces<D>& neighbours = {})
        : a_(a),
          b_(b),
          neighbours_(neighbours),
          scale_(surface_probe_distance(a, b)),
          larger_is_level_(is_composite(a) && is_composite(b)),
          size_excess_of_a_(larger_is_level_ ? detail::size(a) - detail::size(b) : 0),
          center_of_a_(a),
          center_of_b_(b) {}

    /// From now on queries try this cache of the composite shape's parts first.
    void use_cache(const PartCache<D>& cache) { cache_ = &cache; }
    /// Most surface queries stay this near to the contact.
    double reach() const { return 5 * scale_; }

    /// The size of the smaller shape.
    double size() const { return scale_ / surface_probe_scale; }

    /// Tests the normal between two parts in the centre of their contact area and at the deepest point. manifold_of()
    /// returns that area.
    template <class PartA, class PartB, class Manifolds>
    detail::SurfaceNormalFlags surface_normal_flags(const PartA& part_a, const PartB& part_b,
                                                    const SignedDistance<D>& distance,
                                                    const Manifolds& manifold_of) const {
        detail::SurfaceNormalFlags result;
        if (is_composite(b_) || neighbours_.of_a != nullptr)
            result.a = is_surface_normal_of(part_b, point_on_b(distance), -0.5, manifold_of, b_, neighbours_.of_a,
                                            [&] { return place_on_b(part_a, distance); });
        if (is_composite(a_) || neighbours_.of_b != nullptr)
            result.b = is_surface_normal_of(part_a, point_on_a(distance), 0.5, manifold_of, a_, neighbours_.of_b,
                                            [&] { return place_on_a(part_b, distance); });
        return result;
    }

    /// Replaces a normal that is no surface normal by a plane of the surface and its closest point. Of two composite
    /// shapes the larger counts as the level. Of two such planes it takes the one that separates sooner, so that
    /// swapping A and B changes nothing. Returns false, and changes nothing, if there is no plane.
    template <class PartA, class PartB>
    bool replace(const PartA& part_a, const PartB& part_b, const detail::SurfaceNormalFlags& flags,
                 PartContact<D>& contact) {
        std::optional<PartContact<D>> for_a, for_b;
        if (larger_is_level_ ? size_excess_of_a_ <= 0 : !flags.a) {
            NearestToCenter<D> nearest;
            const SurfacePlace<D> place = place_on_b(part_a, contact.distance);
            const auto plane = surface_plane<D>(part_b, place, closest_points_on(b_, neighbours_.of_a),
                                                has_own_center(part_a, a_) ? nearest : nearest_to_a_);
            if (plane && !contact_with_plane(part_a, *plane, for_a.emplace(contact))) for_a.reset();
        }
        if (larger_is_level_ ? size_excess_of_a_ >= 0 : !flags.b) {
            NearestToCenter<D> nearest;
            const SurfacePlace<D> place = place_on_a(part_b, contact.distance);
            const auto plane = surface_plane<D>(part_a, place, closest_points_on(a_, neighbours_.of_b),
                                                has_own_center(part_b, b_) ? nearest : nearest_to_b_);
            if (plane) {
                swap_roles(for_b.emplace(contact).distance);
                const bool found = contact_with_plane(part_b, *plane, *for_b);
                swap_roles(for_b->distance);
                if (!found) for_b.reset();
            }
        }
        if (!for_a && !for_b) return false;
        contact = for_a && (!for_b || for_a->distance.distance >= for_b->distance.distance) ? *for_a : *for_b;
        return true;
    }

private:
    /// The centre of the bounding box of a shape, computed on the first call; the origin for a half-space.
    class Center {
    public:
        explicit Center(const View<D>& view) : view_(view) {}
        const DVec<D>& get() const {
            if (!found_)
                found_ =
                    std::holds_alternative<HalfSpaceView<D>>(view_) ? DVec<D>(0.0) : DVec<D>(center(bounds(view_)));
            return *found_;
        }

    private:
        const View<D>& view_;
        mutable std::optional<DVec<D>> found_;
    };

    static bool is_composite(const View<D>& view) { return std::holds_alternative<Composite<D>>(view); }

    /// The closest points on a shape and its neighbours.
    auto closest_points_on(const View<D>& view, const EachClosestPoint<D>* neighbours) const {
        const PartCache<D>* const cache = is_composite(view) ? cache_ : nullptr;
        return [&view, neighbours, cache](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            double reach_left = within;
            const auto visit_own = [&](const ClosestPoint<D>& closest) { return reach_left = visit(closest); };
            if (cache == nullptr || !cache->each_closest_point(point, within, visit_own))
                each_closest_point_on<D>(view, point, within, visit_own);
            if (neighbours != nullptr && reach_left > stop_visiting) (*neighbours)(point, reach_left, visit);
        };
    }

    /// Whether the normal of a part of `shape` is a surface normal at a point. The points of the manifold lie midway
    /// between two surfaces; a step along the normal by `to_surface` times their depth moves them to this one. Mostly
    /// no other part is near, and a cheap test finds that out first; `place_of()`, which adds the other shape's centre,
    /// costs more.
    template <class Part, class Manifolds, class PlaceOf>
    bool is_surface_normal_of(const Part& part, const SurfacePlace<D>& point, double to_surface,
                              const Manifolds& manifold_of, const View<D>& shape, const EachClosestPoint<D>* neighbours,
                              const PlaceOf& place_of) const {
        const bool is_one_part = !is_composite(shape);
        if (is_one_part && is_alone(point, *neighbours)) return true;
        const SurfacePlace<D> place = place_of();
        const auto each_closest_point = closest_points_on(shape, neighbours);
        const Manifold<D>& manifold = manifold_of();
        if (manifold.count > 1) {
            const DVec<D> normal = to_surface < 0 ? -place.normal : place.normal;
            DVec<D> sum(0.0);
            for (std::size_t i = 0; i < manifold.count; ++i)
                sum += manifold.points[i].position + normal * (to_surface * manifold.points[i].depth);
            SurfacePlace<D> center = place;
            center.point = sum / static_cast<double>(manifold.count);
            if (is_one_part && is_alone(center, *neighbours)
                    ? has_normal<D>(part, center)
                    : is_surface_normal_at<D>(part, center, each_closest_point))
                return true;
        }
        return detail::is_surface_normal<D>(part, place, each_closest_point);
    }

    /// Whether every neighbour is farther from p + s n than a part that contains p, by far more than rounding.
    static bool is_alone(const SurfacePlace<D>& place, const EachClosestPoint<D>& neighbours) {
        bool alone = true;
        neighbours(place.point + place.normal * place.scale, 1.1 * place.scale, [&](const ClosestPoint<D>&) {
            alone = false;
            return stop_visiting;
        });
        return alone;
    }

    /// False for a part that is the whole shape. A flat part uses the centre of its whole shape.
    static bool has_own_center(const Convex<D>& part, const View<D>& shape) {
        const bool flat = part.core == Core::points && part.count <= D && part.radius == 0;
        return !flat && is_composite(shape);
    }
    static bool has_own_center(const HalfSpaceView<D>&, const View<D>&) { return true; }
    static bool has_own_center(const DistanceFunction<D>&, const View<D>&) { return false; }

    static DVec<D> center_beside(const Convex<D>& part, const View<D>& shape, const DVec<D>& of_shape, const DVec<D>&) {
        return has_own_center(part, shape) ? middle_of(part, {}) : of_shape;
    }
    static DVec<D> center_beside(const HalfSpaceView<D>& part, const View<D>&, const DVec<D>&, const DVec<D>& beside) {
        return middle_of(part, beside);
    }

    static DVec<D> center_beside(const DistanceFunction<D>&, const View<D>&, const DVec<D>& of_shape, const DVec<D>&) {
        return of_shape;
    }

    /// These two leave out the centre.
    SurfacePlace<D> point_on_b(const SignedDistance<D>& distance) const {
        return {distance.on_b(), -distance.normal, DVec<D>(0.0), scale_};
    }
    SurfacePlace<D> point_on_a(const SignedDistance<D>& distance) const {
        return {distance.on_a, distance.normal, DVec<D>(0.0), scale_};
    }
    template <class PartA>
    SurfacePlace<D> place_on_b(const PartA& part_a, const SignedDistance<D>& distance) const {
        SurfacePlace<D> place = point_on_b(distance);
        place.center = center_beside(part_a, a_, center_of_a_.get(), place.point);
        return place;
    }
    template <class PartB>
    SurfacePlace<D> place_on_a(const PartB& part_b, const SignedDistance<D>& distance) const {
        SurfacePlace<D> place = point_on_a(distance);
        place.center = center_beside(part_b, b_, center_of_b_.get(), place.point);
        return place;
    }

    /// The contact of a part with the half-space behind a plane. The normal points out of the part.
    static bool contact_with_plane(const Convex<D>& part, const SurfacePlane<D>& plane, PartContact<D>& contact) {
        SignedDistance<D>& distance = contact.distance;
        distance.normal = -plane.normal;
        const CorePoint<D> deepest = core_support(part, distance.normal);
        distance.on_a = deepest.position + distance.normal * part.radius;
        distance.distance = dot(plane.normal, distance.on_a - plane.point);
        distance.corners.count = 1;
        distance.corners.a[0] = deepest.index;
        contact.manifold.count = 1;
        contact.manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                                      0};
        return true;
    }
    /// A half-space keeps its own contact.
    static bool contact_with_plane(const HalfSpaceView<D>&, const SurfacePlane<D>&, PartContact<D>&) { return false; }
    /// A distance function would need a search.
    static bool contact_with_plane(const DistanceFunction<D>&, const SurfacePlane<D>&, PartContact<D>&) {
        return false;
    }

    const View<D>&a_, &b_;
    NeighbourSurfaces<D> neighbours_;
    double scale_;
    bool larger_is_level_;     ///< both shapes are composite: the larger one is the level
    double size_excess_of_a_;  ///< size of A - size of B
    Center center_of_a_, center_of_b_;
    const PartCache<D>* cache_ = nullptr;
    NearestToCenter<D> nearest_to_a_, nearest_to_b_;
};

}  // namespace abut::detail
