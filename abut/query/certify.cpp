#include <abut/convex/gjk/gjk.hpp>
#include <abut/math/detail/round_outwards.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/solid/solid_surface.hpp>
#include <abut/query/overlaps.hpp>

#include <optional>

namespace abut {

using namespace detail;

namespace {

/// Calls visit(part) for a shape that is one part, or for the part of a composite shape with this number.
template <int D, class Visit>
void with_part_of_number(const View<D>& shape, std::uint32_t number, Visit&& visit) {
    const bool is_composite = std::holds_alternative<Composite<D>>(shape);
    detail::for_each_part(shape, shape, 0, [&](const Part<D>& part, std::uint32_t index) {
        const bool found = !is_composite || index == number;
        if (found) visit(part);
        return !found;
    });
}

/// The largest dot(direction, p - origin) over a part that is no distance function.
template <int D>
double extent(const AnyPart<D>& part, const DVec<D>& direction, const DVec<D>& origin) {
    if (part.is_convex())
        return dot(direction, core_support(part.convex(), direction).position - origin) + part.convex().radius;
    const HalfSpaceView<D>& half_space = part.half_space();
    const bool along = length_squared(direction - half_space.normal) <= 1e-12;
    return along ? half_space.offset - dot(half_space.normal, origin) : std::numeric_limits<double>::infinity();
}

/// How far a point is outside of a part.
template <int D>
double outside(const AnyPart<D>& part, const DVec<D>& point) {
    if (part.is_function()) return std::max(0.0, PlacedFunction<D>(part.function()).at(point));
    Convex<D> as_shape;
    as_shape.place.offset = point;
    return std::max(0.0, part_distance<D>(part, as_shape).distance);
}

/// A point of two overlapping parts that are no distance functions. The nearest points of the cores are weighted sums
/// of corners; the radii bridge the gap between the cores.
template <int D>
DVec<D> common_point(const Part<D>& part_a, const Part<D>& part_b) {
    if (part_a.is_half_space()) return common_point(part_b, part_a);
    const Convex<D>& a = part_a.convex();
    if (part_b.is_half_space()) return support(a, -part_b.half_space().normal);
    const Convex<D>& b = part_b.convex();
    const CoreDifference<D> difference(a, b);
    const GjkResult<D> walk = gjk_common_point(difference);
    const DVec<D> on_a = walk.simplex.combine(&DifferencePoint<D>::on_a);
    const DVec<D> between = walk.simplex.combine(&DifferencePoint<D>::on_b) - on_a;
    const double gap = length(between);
    const double along = 0.5 * (std::max(0.0, gap - b.radius) + std::min(gap, a.radius));
    return difference.origin() + on_a + normalized(between) * along;
}

/// The largest coordinate relative to `origin`.
template <int D>
double reach(const Convex<D>& part, const DVec<D>& origin) {
    double farthest = 0;
    for (int i = 0; i < D; ++i)
        for (const double sign : {1.0, -1.0}) farthest = std::max(farthest, extent(part, axis<D>(i, sign), origin));
    return farthest;
}

/// The tolerance of a pair without a distance function.
template <int D>
double tolerance_of(const Part<D>& a, const Part<D>& b) {
    if (a.is_half_space()) return tolerance_of(b, a);
    const Convex<D>& set = a.convex();
    if (b.is_half_space()) {
        const HalfSpaceView<D>& half_space = b.half_space();
        const double beyond = std::abs(extent(set, -half_space.normal, DVec<D>(0.0)) + half_space.offset);
        return 1e-5 * size(set) + 16 * float_spacing(std::max(2 * size(set), beyond));
    }
    const DVec<D> origin = reference_point(set);
    return 1e-5 * std::min(size(set), size(b.convex())) +
           16 * float_spacing(std::max(reach(set, origin), reach(b.convex(), origin)));
}

/// The most by which rounding the coordinates to floats moves a point.
template <int D>
double rounding_of(const Vec<D>& point) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += 0.5 * float_spacing(static_cast<double>(point[i]));
    return result;
}

/// Sets how far the two points are off the normal, and whether all errors are small enough.
template <int D>
void judge(const Closest<D>& answer, Certificate<D>& result) {
    const DVec<D> on_a(answer.on_a), on_b(answer.on_b), normal(answer.normal);
    result.across = length(on_b - on_a - normalized(normal) * static_cast<double>(answer.distance));
    const double rounding = rounding_of(answer.on_a) + rounding_of(answer.on_b) + rounding_of(result.common);
    const double worst = std::max({result.plane, result.off_a, result.off_b, result.across, result.off_common});
    result.holds = std::abs(length(normal) - 1) <= 1e-6 && worst <= result.margin + 2 * rounding;
}

/// Sets the remaining errors, about a common point if the parts overlap.
template <int D>
void finish(const Part<D>& a, const Part<D>& b, const Closest<D>& answer, const DVec<D>& common,
            Certificate<D>& result) {
    if (answer.distance <= 0) {
        result.common = to_float(common);
        const DVec<D> rounded_common(result.common);
        result.off_common = std::max(outside(a, rounded_common), outside(b, rounded_common));
    }
    judge(answer, result);
}

/// By the planes across the normal, for two parts that are no distance functions.
template <int D>
Certificate<D> certificate_by_planes(const Part<D>& a, const Part<D>& b, const Closest<D>& answer) {
    const DVec<D> on_a(answer.on_a), on_b(answer.on_b), normal = normalized(DVec<D>(answer.normal));
    const double distance = static_cast<double>(answer.distance);

    Certificate<D> result;
    result.margin = tolerance_of(a, b);
    const double past_a = extent(a, normal, on_a), past_b = extent(b, -normal, on_a);
    result.plane = std::abs(-past_b - past_a - distance);
    result.off_a = std::max(std::abs(past_a), outside(a, on_a));
    result.off_b = std::max(std::abs(extent(b, -normal, on_b)), outside(b, on_b));
    finish(a, b, answer, distance <= 0 ? common_point(a, b) : DVec<D>(0.0), result);
    return result;
}

// For a distance function the answer names a place and the value of the function there. A second search checks that the
// value is nowhere lower.

/// The distance measured at the place that the answer names, and how far that place is from where it must be.
template <int D>
struct Measured {
    double distance, off;
    DVec<D> common;
};
template <int D>
Measured<D> measured(const Convex<D>& a, const DistanceFunction<D>& b, const DVec<D>& on_a, const DVec<D>& normal) {
    Convex<D> core = a;
    core.radius = 0;
    const DVec<D> deepest = on_a - normal * a.radius;
    const PlacedFunction<D> function(b);
    const double value = function.at(deepest);
    // Follow the gradient down, as far as the radius reaches.
    DVec<D> common = deepest;
    double rest = value;
    for (int i = 0; i < 8 && rest > 0; ++i) {
        common -= function.normal(common, function.step(common, 1e-2 * rest)) * rest;
        rest = function.at(common);
    }
    return {value - a.radius, outside(core, deepest), common};
}
template <int D>
Measured<D> measured(const Part<D>& a, const Part<D>& b, const DVec<D>& on_a, const DVec<D>& normal, double distance) {
    if (a.kind() > b.kind()) return measured(b, a, on_a + normal * distance, -normal, distance);
    if (a.is_convex()) return measured(a.convex(), b.function(), on_a, normal);
    if (b.is_half_space()) return {dot(b.half_space().normal, on_a) - b.half_space().offset, outside(a, on_a), on_a};
    const DVec<D> middle = on_a + normal * (0.5 * distance);
    return {2 * std::max(PlacedFunction<D>(a.function()).at(middle), PlacedFunction<D>(b.function()).at(middle)), 0,
            middle};
}

template <int D>
Certificate<D> certificate_by_search(const Part<D>& a, const Part<D>& b, const Closest<D>& answer) {
    const DVec<D> on_a(answer.on_a), normal = normalized(DVec<D>(answer.normal));
    const double distance = static_cast<double>(answer.distance);
    Certificate<D> result;
    result.margin = function_search_tolerance(a, b);
    if (!std::isfinite(distance)) return result;
    const Measured<D> found = measured(a, b, on_a, normal, distance);
    const double none = -std::numeric_limits<double>::infinity();
    const double minimum = function_distance(a, b, {none, distance - result.margin}).distance;
    result.plane = std::max(std::abs(found.distance - distance), distance - std::min(minimum, distance));
    (a.is_function() ? result.off_b : result.off_a) = found.off;
    finish(a, b, answer, found.common, result);
    return result;
}

// For a solid the whole shapes are tested, not the parts that the answer names.

/// How far a point is from a shape's surface if it `is_surface`, or outside of the shape.
double off_shape(const View<3>& shape, const Vec3& point, bool is_surface) {
    const View<3> as_shape(view(Ball<3>{point, 0}));
    const double distance = static_cast<double>(closest(is_surface ? surface_view(shape) : shape, as_shape).distance);
    return is_surface ? std::abs(distance) : std::max(0.0, distance);
}

/// A point in which the surfaces meet, or one of the surface of the shape that is inside the other.
std::optional<DVec<3>> common_point_of_solids(const View<3>& a, const View<3>& b) {
    std::optional<DVec<3>> common;
    for_each_part_pair(surface_view(a), surface_view(b), 0,
                       [&](const Part<3>& part_a, std::uint32_t, const Part<3>& part_b, std::uint32_t) {
                           if (part_overlaps<3>(part_a, part_b, SearchOptions<3>{}))
                               common = common_point(part_a, part_b);
                           return !common;
                       });
    for (const bool of_a : {true, false}) {
        const View<3>&inner = of_a ? a : b, &outer = of_a ? b : a;
        for_each_part(surface_view(inner), bounds(outer), [&](const Part<3>& part, std::uint32_t) {
            const DVec<3> point = core_support(part.convex(), axis<3>(0)).position;
            if (!common && off_shape(outer, to_float(point), false) == 0) common = point;
            return !common;
        });
    }
    return common;
}

/// The distance after B has moved out, which should be 0.
double distance_after_move(const View<3>& a, const View<3>& b, const Closest<3>& answer) {
    Affine<3> move;
    move.offset = DVec<3>(answer.normal) * -static_cast<double>(answer.distance);
    return static_cast<double>(closest(a, moved(b, move)).distance);
}

Certificate<3> certificate_of_overlap(const View<3>& a, const View<3>& b, const Closest<3>& answer) {
    Certificate<3> result;
    result.margin = solid_tolerance(a, b);
    const double distance = static_cast<double>(answer.distance);
    result.plane = std::abs(distance_after_move(a, b, answer));
    if (distance < -result.margin && !(closest(a, b).distance < 0)) result.plane = -distance;
    result.off_a = off_shape(a, answer.on_a, true);
    result.off_b = off_shape(b, answer.on_b, true);
    const std::optional<DVec<3>> common = common_point_of_solids(a, b);
    result.common = to_float(common.value_or(DVec<3>(answer.on_a)));
    result.off_common = std::max(off_shape(a, result.common, false), off_shape(b, result.common, false));
    judge(answer, result);
    return result;
}

}  // namespace

template <int D>
Certificate<D> certify(const View<D>& a, const View<D>& b, const Closest<D>& answer) {
    Certificate<D> result;
    // The engines below take finite points alone.
    const bool are_numbers = is_finite(answer.on_a) && is_finite(answer.on_b) && is_finite(answer.normal);
    if (!are_numbers || !std::isfinite(answer.distance)) return result;
    if constexpr (D == 3)
        if (has_solid(a, b)) {
            if (answer.distance <= 0) return certificate_of_overlap(a, b, answer);
            if (overlaps(a, b)) {
                result.plane = static_cast<double>(answer.distance);
                return result;
            }
        }
    with_part_of_number(a, answer.feature_a.part, [&](const Part<D>& part_a) {
        with_part_of_number(b, answer.feature_b.part, [&](const Part<D>& part_b) {
            if (part_a.is_half_space() && part_b.is_half_space()) return;
            result = part_a.is_function() || part_b.is_function() ? certificate_by_search(part_a, part_b, answer)
                                                                  : certificate_by_planes(part_a, part_b, answer);
        });
    });
    return result;
}

template Certificate<2> certify(const View<2>&, const View<2>&, const Closest<2>&);
template Certificate<3> certify(const View<3>&, const View<3>&, const Closest<3>&);

}  // namespace abut
