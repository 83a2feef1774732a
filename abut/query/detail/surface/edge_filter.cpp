#include <abut/query/detail/surface/edge_filter.hpp>

namespace abut::detail {
namespace {

/// A part counts as nearer only by more than this fraction of s.
constexpr double nearer_margin = 1e-8;

/// A point nearer to the surface than this fraction of s gives no reliable normal.
constexpr double min_clearance = 0.1;

/// Float coordinates that should be equal differ by up to this fraction of s, which rotates a normal by up to this
/// angle.
constexpr double rounding = 1e-2, rounding_angle = 1e-3;

/// The rotation of a face that a point just beside the face may show.
constexpr double face_angle = 1e-5;

/// The angle by which the plane of a floor of pieces may lean where coordinates are rounded. It is mostly less.
constexpr double max_lean = 0.15, usual_lean = 0.02;

/// The cosine between normals that may be those of one face, 0.2 rad apart: where an edge is uncertain, its normal
/// leans by up to 0.15 rad.
constexpr double same_face = 0.98;

/// If other parts cover the normal, it is tested farther along the part: first at this multiple of s, then at this
/// factor more each time, up to the centre of the other shape.
constexpr double first_reach = 3, reach_growth = 8;

/// The limit on these tests. It reaches far beyond the centre of any object for which the shape is a level.
constexpr int max_reaches = 12;

/// A point inside the part and off all its edges, if the part has an interior.
template <int D>
DVec<D> inner_point(const Part<D>& part, const DVec<D>& probe) {
    if (!part.is_convex()) return probe;
    const Convex<D>& set = part.convex();
    if (set.core != Core::points) return middle_of(part, probe);
    DVec<D> sum(0.0);
    for (std::uint32_t i = 0; i < set.count; ++i) sum += DVec<D>(set.vertices()[i]);
    return set.place.point(sum / static_cast<double>(set.count));
}

/// Whether the part is solid with flat faces, which may be narrow.
template <int D>
bool has_flat_sides(const Part<D>& part) {
    if (!part.is_convex() || part.convex().radius > 0 || part.convex().inner_radius > 0) return false;
    const Convex<D>& set = part.convex();
    return set.core == Core::box || (set.core == Core::points && set.count > static_cast<std::uint32_t>(D));
}

/// Whether the part has a face here and not an edge: a step along the part doesn't change the distance. On a solid part
/// a step sideways, to one side or the other, must not change it either. So the point lies on no edge, and on no face
/// as narrow as the gap between two pieces that should touch.
template <int D>
bool is_face(const Part<D>& part, const SurfacePlace<D>& place, const DVec<D>& probe, double own, double scale) {
    const auto is_as_far = [&](const DVec<D>& point) {
        return std::abs(closest_point_on(part, point).distance - own) <= 3 * face_angle * scale;
    };
    const auto has_width = [&](const DVec<D>& point, const DVec<D>& direction) {
        const DVec<D> step = normalized(direction) * (0.3 * scale);
        return is_as_far(point + step) || is_as_far(point - step);
    };
    const DVec<D> to_center = inner_point(part, probe) - probe;
    DVec<D> along = to_center - place.normal * dot(to_center, place.normal);
    DVec<D> farther = probe;
    const double distance = length(along);
    if (distance > nearer_margin * scale) {
        farther += along * (std::min(first_reach * scale, distance) / distance);
        if (!is_as_far(farther)) return false;
    } else {
        along = perpendicular(place.normal);
    }
    if (!has_flat_sides(part)) return true;
    if constexpr (D == 3)
        if (!has_width(farther, cross(place.normal, along))) return false;
    return has_width(farther, along);
}

/// Whether the point is behind a one-sided part. A point within rounding of the part counts as in front.
template <int D>
bool is_behind(const ClosestPoint<D>& closest, double scale) {
    return closest.behind > rounding * scale;
}

/// Orders equally near points, so that the order of the visits has no influence.
template <int D>
bool is_before(const DVec<D>& a, const DVec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

}  // namespace

/// Whether the part, whose point nearest to p + s n is `own`, is the nearest one. Where rounding leaves that open, a
/// face is and an edge is not: that of an edge is uncertain.
template <int D>
typename EdgeFilter<D>::Nearest EdgeFilter<D>::nearest_part(const Part<D>& part, const SurfacePlace<D>& place,
                                                            const DVec<D>& probe, const ClosestPoint<D>& own,
                                                            const ClosestPoint<D>& other) const {
    const double nearer = own.distance - nearer_margin * scale_ - 1e-14 * largest(probe);
    const double certainly_nearer = own.distance - rounding * scale_, still_relevant = own.distance + rounding * scale_;
    bool covered = false, is_uncertain = false;
    const auto visit = [&](const ClosestPoint<D>& closest) {
        if (is_behind(closest, scale_)) return still_relevant;
        covered = covered || closest.distance < certainly_nearer;
        if (covered) return stop_visiting;
        // This part has another normal and is about as near.
        const DVec<D> offset = probe - closest.point;
        const DVec<D> aside = offset - place.normal * dot(offset, place.normal);
        is_uncertain = is_uncertain || closest.distance < nearer || length(aside) > rounding_angle * scale_;
        return still_relevant;
    };
    visit(own);
    if (other.distance > still_relevant || visit(other) > stop_visiting) surface_(probe, still_relevant, visit);
    if (covered) return Nearest::other;
    return !is_uncertain || is_face(part, place, probe, own.distance, scale_) ? Nearest::own : Nearest::uncertain;
}

template <int D>
bool EdgeFilter<D>::is_surface_normal(const Part<D>& part, const SurfacePlace<D>& place,
                                      const ClosestPoint<D>& other) const {
    const DVec<D> probe = place.point + place.normal * scale_;
    const ClosestPoint<D> own = closest_point_on(part, probe);
    const Nearest first = nearest_part(part, place, probe, own, other);
    if (first == Nearest::own) return true;
    const DVec<D> to_center = place.center - place.point;
    const DVec<D> along = to_center - place.normal * dot(to_center, place.normal);
    const double distance = length(along);
    double reach = first_reach * scale_;
    for (int i = 0; i < max_reaches && distance > scale_; ++i, reach *= reach_growth) {
        const DVec<D> farther = probe + along * (std::min(reach, distance) / distance);
        const ClosestPoint<D> own_farther = closest_point_on(part, farther);
        // The surface bends: the normal changes here.
        if (!(std::abs(own_farther.distance - own.distance) <= nearer_margin * scale_)) break;
        if (nearest_part(part, place, farther, own_farther) == Nearest::own) return true;
        if (!(reach < distance)) break;
    }
    if (first != Nearest::uncertain) return false;
    const std::optional<SurfacePlane<D>> plane = plane_towards_center(part, place);
    return plane && has_edge(part, *plane);
}

template <int D>
ClosestPoint<D> EdgeFilter<D>::other_near(const SurfacePlace<D>& place) const {
    ClosestPoint<D> result;
    surface_(place.point + place.normal * scale_, 1.1 * scale_, [&](const ClosestPoint<D>& closest) {
        result = closest;
        return stop_visiting;
    });
    return result;
}

template <int D>
bool EdgeFilter<D>::is_of_ridge(const Part<D>& part, const SurfacePlane<D>& plane, const DVec<D>& deepest) const {
    const double span = length(deepest - plane.point);
    if (is_near(part, deepest, scale_ + usual_lean * span)) return false;
    return !is_near(part, deepest, scale_ + max_lean * span) || has_edge(part, plane);
}

/// Whether the part or the rest of the surface is no farther than this from a point.
template <int D>
bool EdgeFilter<D>::is_near(const Part<D>& part, const DVec<D>& point, double reach) const {
    bool result = closest_point_on(part, point).distance <= reach;
    if (!result)
        surface_(point, reach, [&](const ClosestPoint<D>&) {
            result = true;
            return stop_visiting;
        });
    return result;
}

/// Whether the surface has an edge where a plane touches it: it has another normal beside that point than on its other
/// side.
template <int D>
bool EdgeFilter<D>::has_edge(const Part<D>& part, const SurfacePlane<D>& plane) const {
    const auto plane_seen_from = [&](const DVec<D>& point) {
        const ClosestPoint<D> own = closest_point_on(part, point);
        return plane_at(point, own, nearest_around(point, own));
    };
    const auto bends = [&](const DVec<D>& aside) {
        const DVec<D> above = plane.point + plane.normal * scale_, step = normalized(aside) * (0.3 * scale_);
        const auto one = plane_seen_from(above + step), other = plane_seen_from(above - step);
        return one && other && dot(one->normal, other->normal) < same_face;
    };
    const DVec<D> aside = perpendicular(plane.normal);
    if constexpr (D == 3)
        if (bends(cross(plane.normal, aside))) return true;
    return bends(aside);
}

template <int D>
bool EdgeFilter<D>::has_normal(const Part<D>& part, const SurfacePlace<D>& place) const {
    return closest_point_on(part, place.point + place.normal * scale_).distance > (1 - rounding) * scale_;
}

template <int D>
bool EdgeFilter<D>::is_surface_normal_at(const Part<D>& part, const SurfacePlace<D>& place) const {
    const DVec<D> probe = place.point + place.normal * scale_;
    const ClosestPoint<D> own = closest_point_on(part, probe);
    return own.distance > (1 - rounding) * scale_ && nearest_part(part, place, probe, own) == Nearest::own;
}

/// The nearest of all closest points, among them `own`, whatever the order of the visits; the query point must not be
/// behind its part. The distance is infinite if all parts are farther than `within`. A point no farther than
/// `sufficient` may be returned although another is nearer.
template <int D>
ClosestPoint<D> EdgeFilter<D>::nearest_to(const DVec<D>& point, const ClosestPoint<D>& own, double within,
                                          double sufficient) const {
    ClosestPoint<D> result;
    const auto visit = [&](const ClosestPoint<D>& closest) {
        const bool is_farther = is_behind(closest, scale_) || closest.distance > result.distance;
        if (!is_farther && (closest.distance < result.distance || is_before(closest.point, result.point)))
            result = closest;
        return result.distance <= sufficient ? stop_visiting : std::min(within, result.distance);
    };
    const double still_relevant = own.distance <= within ? visit(own) : within;
    if (still_relevant > stop_visiting) surface_(point, still_relevant, visit);
    return result;
}

template <int D>
ClosestPoint<D> EdgeFilter<D>::nearest_around(const DVec<D>& point, const ClosestPoint<D>& own) const {
    return nearest_to(point, own, 2 * scale_, min_clearance * scale_);
}

template <int D>
bool EdgeFilter<D>::has_plane(const ClosestPoint<D>& closest) const {
    return closest.distance > min_clearance * scale_ && std::isfinite(closest.distance);
}

template <int D>
std::optional<DVec<D>> EdgeFilter<D>::normal_towards(const DVec<D>& point) const {
    const ClosestPoint<D> closest = nearest_around(point, {});
    if (!has_plane(closest)) return std::nullopt;
    return normalized(point - closest.point);
}

/// The plane at the nearest point, of which `own` is the one on the part.
template <int D>
std::optional<SurfacePlane<D>> EdgeFilter<D>::plane_at(const DVec<D>& point, const ClosestPoint<D>& own,
                                                       const ClosestPoint<D>& nearest) const {
    if (!has_plane(nearest)) return std::nullopt;
    const bool is_own = own.distance <= nearest.distance + nearer_margin * scale_ && !is_behind(own, scale_);
    const DVec<D>& on_surface = is_own ? own.point : nearest.point;
    return SurfacePlane<D>{normalized(point - on_surface), on_surface};
}

/// The plane seen from s towards the centre.
template <int D>
std::optional<SurfacePlane<D>> EdgeFilter<D>::plane_towards_center(const Part<D>& part,
                                                                   const SurfacePlace<D>& place) const {
    const DVec<D> to_center = place.center - place.point;
    const double distance = length(to_center);
    if (!(distance > scale_)) return std::nullopt;
    const DVec<D> probe = place.point + to_center * (scale_ / distance);
    const ClosestPoint<D> own = closest_point_on(part, probe);
    return plane_at(probe, own, nearest_around(probe, own));
}

template <int D>
std::optional<SurfacePlane<D>> EdgeFilter<D>::plane_near(const Part<D>& part, const SurfacePlace<D>& place,
                                                         NearestToCenter<D>& nearest) const {
    if (const auto plane = plane_towards_center(part, place)) return plane;
    const double distance = length(place.center - place.point);
    if (!(distance > scale_)) return std::nullopt;
    const ClosestPoint<D> own = closest_point_on(part, place.center);
    const double within = 1.001 * distance;
    if (!std::isfinite(nearest.closest.distance) && within > nearest.within) {
        nearest.closest = nearest_to(place.center, own, within, 0);
        nearest.within = within;
    }
    if (nearest.closest.distance > within) return std::nullopt;
    return plane_at(place.center, own, nearest.closest);
}

template class EdgeFilter<2>;
template class EdgeFilter<3>;

}  // namespace abut::detail
