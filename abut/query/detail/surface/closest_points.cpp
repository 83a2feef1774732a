#include <abut/convex/pairs/round3.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/query/detail/surface/closest_points.hpp>

namespace abut::detail {
namespace {

template <int D>
Convex<D> convex_of_point(const DVec<D>& point) {
    Convex<D> result = round_points<D>({Vec<D>(0.0f)}, 0);
    result.place.offset = point;
    return result;
}

/// For a point or a segment, with a ball around it.
template <int D>
bool find_closest_point_on_segment(const Convex<D>& part, const DVec<D>& point, double within,
                                   ClosestPoint<D>& closest) {
    const DVec<D> from = part.place.point(DVec<D>(part.vertices()[0]));
    DVec<D> along(0.0), on_core = from;
    if (part.count == 2) {
        along = part.place.point(DVec<D>(part.vertices()[1])) - from;
        const double projection = dot(point - from, along), squared = dot(along, along);
        if (projection > 0) on_core += along * (projection < squared ? projection / squared : 1.0);
    }
    const DVec<D> offset = point - on_core;
    const double distance = length(offset);
    closest.distance = distance - part.radius;
    if (!(closest.distance <= within)) return false;
    closest.point = on_core;
    if (part.radius > 0) {
        const DVec<D> out = distance > 0                               ? offset / distance
                            : part.count == 2 && along != DVec<D>(0.0) ? normalized(perpendicular(along))
                                                                       : detail::axis<D>(0, 1);
        closest.point += out * part.radius;
    }
    closest.behind = part.one_sided ? dot(normalized(front(part)), closest.point - point) : 0;
    return true;
}

/// For a box, with a ball around it.
template <int D>
bool find_closest_point_on_box(const Convex<D>& box, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    const double scale = box.scale, reach = within + box.radius;
    const DVec<D> scaled = box.place.transposed(point - box.place.offset), half(box.own[0]);
    bool is_far = false;
    for (int i = 0; i < D; ++i) is_far |= std::abs(scaled[i]) > (half[i] * scale + reach) * scale;
    if (is_far) return false;
    const DVec<D> local = scale == 1 ? scaled : scaled / (scale * scale);
    DVec<D> on_box, gap;
    double inner_gap = -std::numeric_limits<double>::infinity();
    // Without a branch: most are as likely as not.
    for (int i = 0; i < D; ++i) {
        on_box[i] = std::min(std::max(local[i], -half[i]), half[i]);
        gap[i] = std::abs(local[i]) - half[i];
        inner_gap = std::max(inner_gap, gap[i]);
    }
    int axis = 0;
    if (inner_gap <= 0) {
        while (gap[axis] < inner_gap) ++axis;
        on_box[axis] = std::copysign(half[axis], local[axis]);
    }
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

}  // namespace

template <int D>
bool find_closest_point(const Convex<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    if (is_plain_box(part)) return find_closest_point_on_box(part, point, within, closest);
    if (is_round_points(part, 1) || is_round_points(part, 2))
        return find_closest_point_on_segment(part, point, within, closest);
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
    const SignedDistance<D> distance = part_distance<D>(convex_of_point(point), part, {});
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
void each_closest_point_on_parts(const View<D>& shape, const DVec<D>& point, double within,
                                 ClosestPointVisitor<D> visit) {
    for_each_part(shape, box_around(point, within), [&](const Part<D>& part, std::uint32_t) {
        ClosestPoint<D> closest;
        if (find_closest_point(part, point, within, closest)) within = visit(closest);
        return within > stop_visiting;
    });
}

#define ABUT_INSTANTIATE(D)                                                                       \
    template bool find_closest_point(const Convex<D>&, const DVec<D>&, double, ClosestPoint<D>&); \
    template ClosestPoint<D> closest_point_on(const AnyPart<D>&, const DVec<D>&);                 \
    template void each_closest_point_on_parts(const View<D>&, const DVec<D>&, double, ClosestPointVisitor<D>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
