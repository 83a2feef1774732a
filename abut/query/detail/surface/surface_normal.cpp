#include <abut/convex/pairs/round3.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/query/detail/surface/surface_normal.hpp>

namespace abut::detail {
namespace {

/// A part counts as nearer only by more than this fraction of s.
constexpr double nearer_margin = 1e-8;

/// A point nearer to the surface than this fraction of s gives no reliable normal.
constexpr double min_clearance = 0.1;

template <int D>
Convex<D> point_part(const DVec<D>& point) {
    Convex<D> result = round_points<D>({Vec<D>(0.0f)}, 0);
    result.place.offset = point;
    return result;
}

/// Float coordinates that should be equal differ by up to this fraction of s, which rotates a normal by up to this
/// angle.
constexpr double rounding = 1e-2, rounding_angle = 1e-3;

/// The rotation of a face that a point just beside the face may show.
constexpr double face_angle = 1e-5;

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
bool is_face(const Part<D>& part, const SurfacePlace<D>& place, const DVec<D>& probe, double own) {
    const auto is_as_far = [&](const DVec<D>& point) {
        return std::abs(closest_point_on(part, point).distance - own) <= 3 * face_angle * place.scale;
    };
    const auto has_width = [&](const DVec<D>& point, const DVec<D>& direction) {
        const DVec<D> step = normalized(direction) * (0.3 * place.scale);
        return is_as_far(point + step) || is_as_far(point - step);
    };
    const DVec<D> to_center = inner_point(part, probe) - probe;
    DVec<D> along = to_center - place.normal * dot(to_center, place.normal);
    DVec<D> farther = probe;
    const double distance = length(along);
    if (distance > nearer_margin * place.scale) {
        farther += along * (std::min(first_reach * place.scale, distance) / distance);
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

/// Whether the part, at distance `own` from p + s n, is the nearest one. Where rounding leaves that open, a face is and
/// an edge is not.
template <int D>
bool is_nearest_part(const Part<D>& part, const SurfacePlace<D>& place, const DVec<D>& probe, double own,
                     EachClosestPoint<D> each_closest_point) {
    const double nearer = own - nearer_margin * place.scale - 1e-14 * largest(probe);
    const double certainly_nearer = own - rounding * place.scale;
    bool covered = false, is_uncertain = false;
    each_closest_point(probe, own + rounding * place.scale, [&](const ClosestPoint<D>& closest) {
        const double still_relevant = own + rounding * place.scale;
        if (is_behind(closest, place.scale)) return still_relevant;
        covered = covered || closest.distance < certainly_nearer;
        if (covered) return stop_visiting;
        // This part has another normal and is about as near.
        const DVec<D> offset = probe - closest.point;
        const DVec<D> aside = offset - place.normal * dot(offset, place.normal);
        is_uncertain = is_uncertain || closest.distance < nearer || length(aside) > rounding_angle * place.scale;
        return still_relevant;
    });
    return !covered && (!is_uncertain || is_face(part, place, probe, own));
}

/// For a box, with a ball around it.
template <int D>
bool find_closest_point_on_box(const Convex<D>& box, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    const double scale = box.scale, reach = within + box.radius;
    const DVec<D> local = box.place.transposed(point - box.place.offset) / (scale * scale), half(box.own[0]);
    DVec<D> on_box = local;
    double inner_gap = -std::numeric_limits<double>::infinity();
    int axis = 0;
    for (int i = 0; i < D; ++i) {
        const double gap = std::abs(local[i]) - half[i];
        if (gap * scale > reach) return false;
        if (gap > 0) on_box[i] = std::copysign(half[i], local[i]);
        if (gap > inner_gap) {
            inner_gap = gap;
            axis = i;
        }
    }
    if (inner_gap <= 0) on_box[axis] = std::copysign(half[axis], local[axis]);
    const DVec<D> on_core = box.place.point(on_box);
    closest.distance = inner_gap > 0 ? length(point - on_core) : inner_gap * scale;
    closest.distance -= box.radius;
    closest.point = on_core;
    closest.behind = 0;
    if (!(closest.distance <= within)) return false;
    if (box.radius > 0) {
        const DVec<D> local_out =
            inner_gap > 0 ? local - on_box : detail::axis<D>(axis, std::copysign(1.0, local[axis]));
        closest.point += normalized(box.place.vector(local_out)) * box.radius;
    }
    return true;
}

/// Orders equally near points, so that the order of the visits has no influence.
template <int D>
bool is_before(const DVec<D>& a, const DVec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

}  // namespace

template <int D>
bool find_closest_point(const Convex<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    if (is_plain_box(part)) return find_closest_point_on_box(part, point, within, closest);
    if constexpr (D == 3) {
        if (is_plain_hull(part) && is_beyond_a_face(part, point, within)) return false;
        if (is_round_points(part, 3)) {
            const TriangleClosest answer =
                closest_point_on_triangle(part, point, within, closest.distance, closest.point);
            if (answer == TriangleClosest::beyond) return false;
            if (answer == TriangleClosest::found) {
                closest.behind = part.one_sided ? dot(normalized(front(part)), closest.point - point) : 0;
                return closest.distance <= within;
            }
        }
    }
    const SignedDistance<D> distance = part_distance<D>(point_part(point), part, {});
    closest = {distance.distance, distance.on_b()};
    if (part.one_sided) closest.behind = dot(normalized(front(part)), closest.point - point);
    return closest.distance <= within;
}

template <int D>
ClosestPoint<D> closest_point_on(const AnyPart<D>& part, const DVec<D>& point) {
    if (part.is_convex()) {
        ClosestPoint<D> result;
        find_closest_point(part.convex(), point, std::numeric_limits<double>::infinity(), result);
        return result;
    }
    if (part.is_half_space()) {
        const HalfSpaceView<D>& half_space = part.half_space();
        const double distance = dot(half_space.normal, point) - half_space.offset;
        return {distance, point - half_space.normal * distance};
    }
    const PlacedFunction<D> nearest(part.function());
    const double distance = nearest.at(point);
    if (!std::isfinite(distance)) return {};
    return {distance, point - nearest.normal(point, nearest.step(point, 1e-2 * std::abs(distance))) * distance};
}

template <int D>
ClosestPoint<D> nearest_surface_point(EachClosestPoint<D> each_closest_point, const DVec<D>& point, double within,
                                      double scale, double sufficient) {
    ClosestPoint<D> result;
    each_closest_point(point, within, [&](const ClosestPoint<D>& closest) {
        const bool is_farther = is_behind(closest, scale) || closest.distance > result.distance;
        if (!is_farther && (closest.distance < result.distance || is_before(closest.point, result.point)))
            result = closest;
        return result.distance <= sufficient ? stop_visiting : std::min(within, result.distance);
    });
    return result;
}

template <int D>
void each_closest_point_on(const View<D>& shape, const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
    detail::for_each_part(shape, point_part(point), static_cast<float>(within),
                          [&](const Part<D>& part, std::uint32_t) {
                              ClosestPoint<D> closest;
                              if (find_closest_point(part, point, within, closest)) within = visit(closest);
                              return within > stop_visiting;
                          });
}

template <int D>
bool is_surface_normal(const Part<D>& part, const SurfacePlace<D>& place, EachClosestPoint<D> each_closest_point) {
    const DVec<D> probe = place.point + place.normal * place.scale;
    const double own = closest_point_on(part, probe).distance;
    if (is_nearest_part(part, place, probe, own, each_closest_point)) return true;
    const DVec<D> to_center = place.center - place.point;
    const DVec<D> along = to_center - place.normal * dot(to_center, place.normal);
    const double distance = length(along);
    if (!(distance > place.scale)) return false;
    double reach = first_reach * place.scale;
    for (int i = 0; i < max_reaches; ++i, reach *= reach_growth) {
        const DVec<D> farther = probe + along * (std::min(reach, distance) / distance);
        const double own_farther = closest_point_on(part, farther).distance;
        // The surface bends: the normal changes here.
        if (!(std::abs(own_farther - own) <= nearer_margin * place.scale)) return false;
        if (is_nearest_part(part, place, farther, own_farther, each_closest_point)) return true;
        if (!(reach < distance)) return false;
    }
    return false;
}

template <int D>
bool has_normal(const Part<D>& part, const SurfacePlace<D>& place) {
    return closest_point_on(part, place.point + place.normal * place.scale).distance > (1 - rounding) * place.scale;
}

template <int D>
bool is_surface_normal_at(const Part<D>& part, const SurfacePlace<D>& place, EachClosestPoint<D> each_closest_point) {
    const DVec<D> probe = place.point + place.normal * place.scale;
    const double own = closest_point_on(part, probe).distance;
    return own > (1 - rounding) * place.scale && is_nearest_part(part, place, probe, own, each_closest_point);
}

template <int D>
std::optional<SurfacePlane<D>> surface_plane(const Part<D>& part, const SurfacePlace<D>& place,
                                             EachClosestPoint<D> each_closest_point, NearestToCenter<D>& nearest) {
    const double clear = min_clearance * place.scale;
    const auto plane_at = [&](const DVec<D>& point, ClosestPoint<D> closest) -> std::optional<SurfacePlane<D>> {
        if (!(closest.distance > clear) || !std::isfinite(closest.distance)) return std::nullopt;
        const ClosestPoint<D> own = closest_point_on(part, point);
        const bool is_nearest = own.distance <= closest.distance + nearer_margin * place.scale;
        if (is_nearest && !is_behind(own, place.scale)) closest = own;
        return SurfacePlane<D>{normalized(point - closest.point), closest.point};
    };
    const DVec<D> to_center = place.center - place.point;
    const double distance = length(to_center);
    if (!(distance > place.scale)) return std::nullopt;
    const DVec<D> probe = place.point + to_center * (place.scale / distance);
    if (const auto plane =
            plane_at(probe, nearest_surface_point(each_closest_point, probe, 2 * place.scale, place.scale, clear)))
        return plane;
    const double within = 1.001 * distance;
    if (!std::isfinite(nearest.closest.distance) && within > nearest.within) {
        nearest.closest = nearest_surface_point(each_closest_point, place.center, within, place.scale, 0);
        nearest.within = within;
    }
    return plane_at(place.center, nearest.closest.distance <= within ? nearest.closest : ClosestPoint<D>());
}

#define ABUT_INSTANTIATE(D)                                                                                            \
    template bool find_closest_point(const Convex<D>&, const DVec<D>&, double, ClosestPoint<D>&);                      \
    template ClosestPoint<D> closest_point_on(const AnyPart<D>&, const DVec<D>&);                                      \
    template ClosestPoint<D> nearest_surface_point(EachClosestPoint<D>, const DVec<D>&, double, double, double);       \
    template void each_closest_point_on(const View<D>&, const DVec<D>&, double, ClosestPointVisitor<D>);               \
    template bool has_normal(const Part<D>&, const SurfacePlace<D>&);                                                  \
    template bool is_surface_normal_at(const Part<D>&, const SurfacePlace<D>&, EachClosestPoint<D>);                   \
    template bool is_surface_normal(const Part<D>&, const SurfacePlace<D>&, EachClosestPoint<D>);                      \
    template std::optional<SurfacePlane<D>> surface_plane(const Part<D>&, const SurfacePlace<D>&, EachClosestPoint<D>, \
                                                          NearestToCenter<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
