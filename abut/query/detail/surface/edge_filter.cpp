#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/detail/surface/surface_manifold.hpp>

namespace abut::detail {
namespace {

template <int D>
bool is_composite(const View<D>& view) {
    return std::holds_alternative<Composite<D>>(view);
}

/// Whether every neighbour is farther from p + s n than a part that contains p, by far more than rounding.
template <int D>
bool is_alone(const SurfacePlace<D>& place, const EachClosestPoint<D>& neighbours) {
    bool alone = true;
    neighbours(place.point + place.normal * place.scale, 1.1 * place.scale, [&](const ClosestPoint<D>&) {
        alone = false;
        return stop_visiting;
    });
    return alone;
}

/// False for a part that is the whole shape. A flat part uses the centre of its whole shape.
template <int D>
bool has_own_center(const Part<D>& part, const View<D>& shape) {
    if (!part.is_convex()) return part.is_half_space();
    const Convex<D>& set = part.convex();
    const bool flat = set.core == Core::points && set.count <= D && set.radius == 0;
    return !flat && is_composite(shape);
}

/// A place without the centre.
template <int D>
SurfacePlace<D> point_on(bool on_b, const SignedDistance<D>& distance, double scale) {
    if (on_b) return {distance.on_b(), -distance.normal, DVec<D>(0.0), scale};
    return {distance.on_a, distance.normal, DVec<D>(0.0), scale};
}

/// Writes the distance of a part from the half-space behind a plane; the normal points out of the part. Returns false
/// for a half-space, which keeps its own contact, and for a distance function, which would need a search.
template <int D>
bool find_distance_to_plane(const Part<D>& part, const SurfacePlane<D>& plane, SignedDistance<D>& distance) {
    if (!part.is_convex()) return false;
    distance.normal = -plane.normal;
    const CorePoint<D> deepest = core_support(part.convex(), distance.normal);
    distance.on_a = deepest.position + distance.normal * part.convex().radius;
    distance.distance = dot(plane.normal, distance.on_a - plane.point);
    distance.corners.count = 1;
    distance.corners.a[0] = deepest.index;
    return true;
}

}  // namespace

/// The centre of the bounding box of a shape, computed on the first call; the origin for a half-space.
template <int D>
const DVec<D>& EdgeFilter<D>::Center::get() const {
    if (!found_)
        found_ = std::holds_alternative<HalfSpaceView<D>>(view_) ? DVec<D>(0.0) : DVec<D>(center(bounds(view_)));
    return *found_;
}

template <int D>
EdgeFilter<D>::EdgeFilter(const View<D>& a, const View<D>& b, const NeighbourSurfaces<D>& neighbours)
    : a_(a),
      b_(b),
      neighbours_(neighbours),
      size_a_(detail::size(a)),
      size_b_(detail::size(b)),
      scale_(surface_probe_scale * size()),
      are_composite_(is_composite(a) && is_composite(b)),
      center_of_a_(a),
      center_of_b_(b) {}

/// The point, and the centre of the other shape or part.
template <int D>
SurfacePlace<D> EdgeFilter<D>::place_on(Side side, const Part<D>& other_part, const SignedDistance<D>& distance) const {
    const bool on_b = side == Side::b;
    SurfacePlace<D> place = point_on(on_b, distance, scale_);
    place.center = has_own_center(other_part, on_b ? a_ : b_) ? middle_of(other_part, place.point)
                                                              : (on_b ? center_of_a_ : center_of_b_).get();
    return place;
}

/// The closest points on a shape and its neighbours.
template <int D>
auto EdgeFilter<D>::closest_points_on(Side side) const {
    const View<D>& view = side == Side::b ? b_ : a_;
    const EachClosestPoint<D>* const neighbours = side == Side::b ? neighbours_.of_a : neighbours_.of_b;
    const PartCache<D>* const cache = is_composite(view) ? cache_ : nullptr;
    return [&view, neighbours, cache](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
        double reach_left = within;
        const auto visit_own = [&](const ClosestPoint<D>& closest) { return reach_left = visit(closest); };
        if (cache == nullptr || !cache->each_closest_point(point, within, visit_own))
            each_closest_point_on<D>(view, point, within, visit_own);
        if (neighbours != nullptr && reach_left > stop_visiting) (*neighbours)(point, reach_left, visit);
    };
}

/// Whether the normal of a part on this side is a surface normal. The points of the manifold lie midway between two
/// surfaces; half their depth along the normal moves them to this one. Mostly no other part is near one of the deepest
/// points, and a cheap test finds that out first; the other shape's centre costs more.
template <int D>
bool EdgeFilter<D>::is_surface_normal_of(Side side, const Part<D>& part, const Part<D>& other_part,
                                         const SignedDistance<D>& distance,
                                         FunctionRef<const Manifold<D>&()> manifold_of) const {
    const bool on_b = side == Side::b, is_one_part = !is_composite(on_b ? b_ : a_);
    const EachClosestPoint<D>* const neighbours = on_b ? neighbours_.of_a : neighbours_.of_b;
    SurfacePlace<D> place = point_on(on_b, distance, scale_);
    if (is_one_part && is_alone(place, *neighbours)) return true;
    // Without a face along the normal the area is one point.
    const bool may_have_area =
        FaceNormals<D>(part).may_face(distance.normal) || FaceNormals<D>(other_part).may_face(distance.normal);
    Manifold<D> no_area;
    const Manifold<D>& manifold = may_have_area ? manifold_of() : no_area;
    DVec<D> sum(0.0);
    for (std::size_t i = 0; i < manifold.count; ++i) {
        const ManifoldPoint<D>& point = manifold.points[i];
        const DVec<D> on_surface = point.position + place.normal * (0.5 * point.depth);
        sum += on_surface;
        if (!is_one_part || manifold.count == 1 || point.depth < -distance.distance - deepest_tolerance * scale_)
            continue;
        place.point = on_surface;
        if (is_alone(place, *neighbours)) return true;
    }
    place = place_on(side, other_part, distance);
    const auto each_closest_point = closest_points_on(side);
    if (manifold.count > 1) {
        SurfacePlace<D> center = place;
        center.point = sum / static_cast<double>(manifold.count);
        if (is_one_part && is_alone(center, *neighbours) ? has_normal(part, center)
                                                         : is_surface_normal_at<D>(part, center, each_closest_point))
            return true;
    }
    return is_surface_normal<D>(part, place, each_closest_point);
}

template <int D>
detail::SurfaceNormalFlags EdgeFilter<D>::surface_normal_flags(const Part<D>& part_a, const Part<D>& part_b,
                                                               const SignedDistance<D>& distance,
                                                               FunctionRef<const Manifold<D>&()> manifold_of) const {
    detail::SurfaceNormalFlags result;
    if (is_composite(b_) || neighbours_.of_a != nullptr)
        result.a = is_surface_normal_of(Side::b, part_b, part_a, distance, manifold_of);
    if (is_composite(a_) || neighbours_.of_b != nullptr)
        result.b = is_surface_normal_of(Side::a, part_a, part_b, distance, manifold_of);
    return result;
}

/// A plane of the surface on this side near the place of the contact.
template <int D>
std::optional<SurfacePlane<D>> EdgeFilter<D>::plane_of(Side side, const Part<D>& part, const Part<D>& other_part,
                                                       const SignedDistance<D>& distance) {
    const bool on_b = side == Side::b, has_own = has_own_center(other_part, on_b ? a_ : b_);
    NearestToCenter<D> nearest;
    NearestToCenter<D>* const shared = on_b ? neighbours_.nearest_to_a : neighbours_.nearest_to_b;
    NearestToCenter<D>& of_shape = shared != nullptr ? *shared : on_b ? nearest_to_a_ : nearest_to_b_;
    return surface_plane<D>(part, place_on(side, other_part, distance), closest_points_on(side),
                            has_own ? nearest : of_shape);
}

template <int D>
bool EdgeFilter<D>::replace(const Part<D>& part_a, const Part<D>& part_b, const detail::SurfaceNormalFlags& flags,
                            SignedDistance<D>& distance) {
    SignedDistance<D> for_a = distance, for_b = flipped(distance);
    const auto find = [&](Side side, const Part<D>& part, const Part<D>& other, SignedDistance<D>& found) {
        const std::optional<SurfacePlane<D>> plane = plane_of(side, part, other, distance);
        return plane && find_distance_to_plane(other, *plane, found);
    };
    const bool has_a = (are_composite_ ? !a_is_larger() : !flags.a) && find(Side::b, part_b, part_a, for_a);
    const bool has_b = (are_composite_ ? size_a_ >= size_b_ : !flags.b) && find(Side::a, part_a, part_b, for_b);
    if (has_b) flip(for_b);
    if (has_a || has_b) distance = has_a && (!has_b || for_a.distance >= for_b.distance) ? for_a : for_b;
    return has_a || has_b;
}

template class EdgeFilter<2>;
template class EdgeFilter<3>;

}  // namespace abut::detail
