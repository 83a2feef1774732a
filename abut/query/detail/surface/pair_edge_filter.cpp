#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/detail/surface/surface_manifold.hpp>

namespace abut::detail {
namespace {

/// False for a part that is the whole shape. A flat part uses the centre of its whole shape.
template <int D>
bool has_own_center(const Part<D>& part, const View<D>& shape) {
    if (!part.is_convex()) return part.is_half_space();
    const Convex<D>& set = part.convex();
    const bool flat = set.core == Core::points && set.count <= D && set.radius == 0;
    return !flat && std::holds_alternative<Composite<D>>(shape);
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

/// Whether a flat side of the part faces this way, up to 0.0014 rad, so that the part is equally deep all over it.
template <int D>
bool has_face_along(const Part<D>& part, const DVec<D>& direction) {
    if (!part.is_convex() || !FaceNormals<D>(part).may_face(direction)) return false;
    const Face<D> face = face_along(part.convex(), direction);
    return face.flat() && dot(face.normal, direction) >= 1 - 1e-6;
}

template <int D>
bool is_none(const ClosestPoint<D>& closest) {
    return !std::isfinite(closest.distance);
}

}  // namespace

/// The centre of the bounding box of the shape, computed on the first call; the origin for a half-space.
template <int D>
const DVec<D>& PairEdgeFilter<D>::ForShape::center() const {
    if (!center_)
        center_ =
            std::holds_alternative<HalfSpaceView<D>>(shape_) ? DVec<D>(0.0) : DVec<D>(abut::center(bounds(shape_)));
    return *center_;
}

/// A place without the centre.
template <int D>
SurfacePlace<D> PairEdgeFilter<D>::ForShape::point_on_level(const SignedDistance<D>& distance) const {
    if (level_is_b_) return {distance.on_b(), -distance.normal, DVec<D>(0.0)};
    return {distance.on_a, distance.normal, DVec<D>(0.0)};
}
template <int D>
SurfacePlace<D> PairEdgeFilter<D>::ForShape::place_on_level(const Part<D>& part,
                                                            const SignedDistance<D>& distance) const {
    SurfacePlace<D> place = point_on_level(distance);
    place.center = has_own_center(part, shape_) ? middle_of(part, place.point) : center();
    return place;
}

/// Whether the normal of a part of the level is a surface normal. The points of the manifold lie midway between two
/// surfaces; half their depth along the normal moves them to the level. Mostly no other part is near one of the deepest
/// points, and a cheap test finds that out first; the shape's centre costs more.
template <int D>
bool PairEdgeFilter<D>::ForShape::is_surface_normal(const Part<D>& part, const Part<D>& level_part,
                                                    const SignedDistance<D>& distance,
                                                    FunctionRef<const Manifold<D>&()> manifold_of) const {
    const bool is_one_part = !surface.is_composite();
    SurfacePlace<D> place = point_on_level(distance);
    const ClosestPoint<D> other = is_one_part ? filter.other_near(place) : ClosestPoint<D>();
    if (is_one_part && is_none(other)) return true;
    // Without a face along the normal the area is one point.
    const bool may_have_area =
        FaceNormals<D>(level_part).may_face(distance.normal) || FaceNormals<D>(part).may_face(distance.normal);
    Manifold<D> no_area;
    const Manifold<D>& manifold = may_have_area ? manifold_of() : no_area;
    const double min_depth = -distance.distance - deepest_tolerance * filter.scale();
    DVec<D> sum(0.0);
    for (std::size_t i = 0; i < manifold.count; ++i) {
        const ManifoldPoint<D>& point = manifold.points[i];
        const DVec<D> on_surface = point.position + place.normal * (0.5 * point.depth);
        sum += on_surface;
        if (!is_one_part || manifold.count == 1 || point.depth < min_depth) continue;
        place.point = on_surface;
        if (is_none(filter.other_near(place))) return true;
    }
    place = place_on_level(part, distance);
    if (manifold.count > 1) {
        SurfacePlace<D> center = place;
        center.point = sum / static_cast<double>(manifold.count);
        if (is_one_part && is_none(filter.other_near(center)) ? filter.has_normal(level_part, center)
                                                              : filter.is_surface_normal_at(level_part, center))
            return true;
    }
    return filter.is_surface_normal(level_part, place, other);
}

/// A plane of the surface near the place of the contact.
template <int D>
std::optional<SurfacePlane<D>> PairEdgeFilter<D>::ForShape::plane(const Part<D>& part, const Part<D>& level_part,
                                                                  const SignedDistance<D>& distance) {
    NearestToCenter<D> of_part;
    return filter.plane_near(level_part, place_on_level(part, distance),
                             has_own_center(part, shape_) ? of_part : *nearest_);
}

template <int D>
PairEdgeFilter<D>::PairEdgeFilter(const View<D>& a, const View<D>& b, const NeighbourSurfaces<D>& neighbours)
    : size_a_(detail::size(a)),
      size_b_(detail::size(b)),
      for_a_(a, b, true, size(), neighbours.of_a, neighbours.nearest_to_a),
      for_b_(b, a, false, size(), neighbours.of_b, neighbours.nearest_to_b) {}

template <int D>
SurfaceNormalFlags PairEdgeFilter<D>::surface_normal_flags(const Part<D>& part_a, const Part<D>& part_b,
                                                           const SignedDistance<D>& distance,
                                                           FunctionRef<const Manifold<D>&()> manifold_of) const {
    return {.a = !for_a_.has_surface() || for_a_.is_surface_normal(part_a, part_b, distance, manifold_of),
            .b = !for_b_.has_surface() || for_b_.is_surface_normal(part_b, part_a, distance, manifold_of)};
}

template <int D>
typename PairEdgeFilter<D>::Substitute PairEdgeFilter<D>::replace(const Part<D>& part_a, const Part<D>& part_b,
                                                                  const SurfaceNormalFlags& flags,
                                                                  SignedDistance<D>& distance) {
    SignedDistance<D> from_a = distance, from_b = flipped(distance);
    bool is_on_ridge = false;
    const auto find = [&](ForShape& shape, const Part<D>& part, const Part<D>& level_part, SignedDistance<D>& found) {
        const std::optional<SurfacePlane<D>> plane = shape.plane(part, level_part, distance);
        if (!plane || !find_distance_to_plane(part, *plane, found)) return false;
        if (found.distance >= distance.distance || has_face_along(part, found.normal)) return true;
        if (!shape.filter.is_of_ridge(level_part, *plane, found.on_b())) return true;
        is_on_ridge = true;
        return false;
    };
    const bool are_composite = for_a_.surface.is_composite() && for_b_.surface.is_composite();
    const bool has_a = (are_composite ? size_a_ <= size_b_ : !flags.a) && find(for_a_, part_a, part_b, from_a);
    const bool has_b = (are_composite ? size_b_ <= size_a_ : !flags.b) && find(for_b_, part_b, part_a, from_b);
    if (!has_a && !has_b) return is_on_ridge ? Substitute::ridge : Substitute::none;
    if (has_b) flip(from_b);
    distance = has_a && (!has_b || from_a.distance >= from_b.distance) ? from_a : from_b;
    return Substitute::plane;
}

template class PairEdgeFilter<2>;
template class PairEdgeFilter<3>;

}  // namespace abut::detail
