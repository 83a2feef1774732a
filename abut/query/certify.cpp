#include <abut/convex/gjk/gjk.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>

namespace abut {

using namespace detail;

namespace {

/// Calls visit(part) for a shape itself, or for the part of a composite shape with this number.
template <int D, class Visit>
void with_part(const View<D>& shape, std::uint32_t number, Visit&& visit) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape))
        visit(*convex);
    else if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&shape))
        visit(*half_space);
    else if (const auto* function = std::get_if<DistanceFunction<D>>(&shape))
        visit(*function);
    else
        each_part<D>(std::get<Composite<D>>(shape), bounds(shape), [&](const Convex<D>& part, std::uint32_t index) {
            if (index == number) visit(part);
            return index != number;
        });
}

/// The largest dot(direction, p - origin) over the part.
template <int D>
double extent(const Convex<D>& part, const DVec<D>& direction, const DVec<D>& origin) {
    return dot(direction, core_support(part, direction).position - origin) + part.radius;
}
template <int D>
double extent(const HalfSpaceView<D>& part, const DVec<D>& direction, const DVec<D>& origin) {
    const bool along = length_squared(direction - part.normal) <= 1e-12;
    return along ? part.offset - dot(part.normal, origin) : std::numeric_limits<double>::infinity();
}

template <int D>
double outside(const Convex<D>& part, const DVec<D>& point) {
    Convex<D> as_shape;
    as_shape.place.offset = point;
    return std::max(0.0, part_distance(part, as_shape, {}).distance);
}
template <int D>
double outside(const HalfSpaceView<D>& part, const DVec<D>& point) {
    return std::max(0.0, dot(part.normal, point) - part.offset);
}

/// A point of both overlapping shapes. The nearest points of the cores are weighted sums of corners; the radii bridge
/// the gap between the cores.
template <int D>
DVec<D> common_point(const Convex<D>& a, const Convex<D>& b) {
    const CoreDifference<D> difference(a, b);
    const GjkResult<D> walk = gjk_common_point(difference);
    const DVec<D> on_a = walk.simplex.combine(&DifferencePoint<D>::on_a);
    const DVec<D> between = walk.simplex.combine(&DifferencePoint<D>::on_b) - on_a;
    const double gap = length(between);
    const double along = 0.5 * (std::max(0.0, gap - b.radius) + std::min(gap, a.radius));
    return difference.origin() + on_a + normalized(between) * along;
}
template <int D>
DVec<D> common_point(const Convex<D>& a, const HalfSpaceView<D>& b) {
    return support(a, -b.normal);
}
template <int D>
DVec<D> common_point(const HalfSpaceView<D>& a, const Convex<D>& b) {
    return common_point(b, a);
}

/// The largest coordinate relative to `origin`.
template <int D>
double reach(const Convex<D>& part, const DVec<D>& origin) {
    double farthest = 0;
    for (int i = 0; i < D; ++i)
        for (const double sign : {1.0, -1.0}) farthest = std::max(farthest, extent(part, axis<D>(i, sign), origin));
    return farthest;
}

double unit_in_the_last_place(double x) {
    const float f = static_cast<float>(std::abs(x));
    return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

template <int D>
double tolerance_of(const Convex<D>& a, const Convex<D>& b) {
    const DVec<D> origin = reference_point(a);
    return 1e-5 * std::min(size(a), size(b)) +
           16 * unit_in_the_last_place(std::max(reach(a, origin), reach(b, origin)));
}
template <int D>
double tolerance_of(const Convex<D>& a, const HalfSpaceView<D>& b) {
    const double beyond = std::abs(extent(a, -b.normal, DVec<D>(0.0)) + b.offset);
    return 1e-5 * size(a) + 16 * unit_in_the_last_place(std::max(2 * size(a), beyond));
}
template <int D>
double tolerance_of(const HalfSpaceView<D>& a, const Convex<D>& b) {
    return tolerance_of(b, a);
}
/// The most by which rounding the coordinates to floats moves a point.
template <int D>
double rounding_of(const Vec<D>& point) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += 0.5 * unit_in_the_last_place(static_cast<double>(point[i]));
    return result;
}

template <int D, class A, class B>
Certificate<D> certificate(const A& a, const B& b, const Closest<D>& answer) {
    const DVec<D> on_a(answer.on_a), on_b(answer.on_b), normal = normalized(DVec<D>(answer.normal));
    const double distance = static_cast<double>(answer.distance);

    Certificate<D> result;
    result.margin = tolerance_of(a, b);
    const double past_a = extent(a, normal, on_a), past_b = extent(b, -normal, on_a);
    result.plane = std::abs(-past_b - past_a - distance);
    result.off_a = std::max(std::abs(past_a), outside(a, on_a));
    result.off_b = std::max(std::abs(extent(b, -normal, on_b)), outside(b, on_b));
    result.across = length(on_b - on_a - normal * distance);
    if (distance <= 0) {
        result.common = to_float(common_point(a, b));
        const DVec<D> common(result.common);
        result.off_common = std::max(outside(a, common), outside(b, common));
    }
    const double rounding = rounding_of(answer.on_a) + rounding_of(answer.on_b) + rounding_of(result.common);
    const double worst = std::max({result.plane, result.off_a, result.off_b, result.across, result.off_common});
    result.holds = std::abs(length(DVec<D>(answer.normal)) - 1) <= 1e-6 && worst <= result.margin + 2 * rounding;
    return result;
}

// For a distance function the answer names a place and the value of the function there. A second search checks that the
// value is nowhere lower.

/// How far the deepest point of a set is outside of the set, or a point is outside of a function's shape.
template <int D>
double outside(const DistanceFunction<D>& part, const DVec<D>& point) {
    return std::max(0.0, PlacedFunction<D>(part).at(point));
}

/// The distance measured at the place that the answer names, and how far that place is from where it must be.
template <int D>
struct Measured {
    double distance, off;
    DVec<D> common;
};
template <int D>
Measured<D> measured(const Convex<D>& a, const DistanceFunction<D>& b, const DVec<D>& on_a, const DVec<D>& normal,
                     double) {
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
Measured<D> measured(const DistanceFunction<D>& a, const HalfSpaceView<D>& b, const DVec<D>& on_a, const DVec<D>&,
                     double) {
    return {dot(b.normal, on_a) - b.offset, outside(a, on_a), on_a};
}
template <int D>
Measured<D> measured(const DistanceFunction<D>& a, const DistanceFunction<D>& b, const DVec<D>& on_a,
                     const DVec<D>& normal, double distance) {
    const DVec<D> middle = on_a + normal * (0.5 * distance);
    return {2 * std::max(PlacedFunction<D>(a).at(middle), PlacedFunction<D>(b).at(middle)), 0, middle};
}
template <class A, class B, int D>
Measured<D> measured(const A& a, const B& b, const DVec<D>& on_a, const DVec<D>& normal, double distance) {
    return measured(b, a, on_a + normal * distance, -normal, distance);
}

template <int D, class A, class B>
requires FunctionPair<A, B> Certificate<D> certificate(const A& a, const B& b, const Closest<D>& answer) {
    const DVec<D> on_a(answer.on_a), on_b(answer.on_b), normal = normalized(DVec<D>(answer.normal));
    const double distance = static_cast<double>(answer.distance);
    Certificate<D> result;
    result.margin = function_search_tolerance(a, b);
    if (!std::isfinite(distance)) return result;
    const Measured<D> found = measured(a, b, on_a, normal, distance);
    const double none = -std::numeric_limits<double>::infinity();
    const double minimum = function_distance(a, b, {none, distance - result.margin}).distance;
    result.plane = std::max(std::abs(found.distance - distance), distance - std::min(minimum, distance));
    (is_function<A> ? result.off_b : result.off_a) = found.off;
    result.across = length(on_b - on_a - normal * distance);
    if (distance <= 0) {
        result.common = to_float(found.common);
        const DVec<D> common(result.common);
        result.off_common = std::max(outside(a, common), outside(b, common));
    }
    const double rounding = rounding_of(answer.on_a) + rounding_of(answer.on_b) + rounding_of(result.common);
    const double worst = std::max({result.plane, result.off_a, result.off_b, result.across, result.off_common});
    result.holds = std::abs(length(DVec<D>(answer.normal)) - 1) <= 1e-6 && worst <= result.margin + 2 * rounding;
    return result;
}

}  // namespace

template <int D>
Certificate<D> certify(const View<D>& a, const View<D>& b, const Closest<D>& answer) {
    Certificate<D> result;
    with_part(a, answer.feature_a.part, [&](const auto& part_a) {
        with_part(b, answer.feature_b.part, [&](const auto& part_b) {
            constexpr bool both_half_spaces = std::is_same_v<decltype(part_a), const HalfSpaceView<D>&> &&
                                              std::is_same_v<decltype(part_b), const HalfSpaceView<D>&>;
            if constexpr (!both_half_spaces) result = certificate<D>(part_a, part_b, answer);
        });
    });
    return result;
}

template Certificate<2> certify(const View<2>&, const View<2>&, const Closest<2>&);
template Certificate<3> certify(const View<3>&, const View<3>&, const Closest<3>&);

}  // namespace abut
