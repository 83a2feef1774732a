#include <abut/convex/tolerance.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/detail/sdf/minimum.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {
namespace {

/// The tolerance of a search as a fraction of the whole tolerance, which leaves enough for rounding elsewhere.
constexpr double search_tolerance = 0.25;

/// This fraction for a function that bounds itself, beside a convex set: the search misses nothing.
constexpr double bounded_tolerance = 0.5;

/// A plane tilted by this much touches a shape at a corner beside the lowest one.
constexpr double tilt = 0.02;

/// The tolerance of those lowest points, as a fraction of the size.
constexpr double tilted_tolerance = 1e-3;

/// The limits on boxes above a half-space, and above a tilted one.
constexpr int max_boxes_above_half_space = 1024, max_boxes_tilted = 128;

template <int D>
bool is_bounded(const Aabb<D>& box) {
    return is_finite(box.min) && is_finite(box.max);
}
template <int D>
bool has_no_extent(const Aabb<D>& box) {
    return !(box.min[0] <= box.max[0]);
}

/// The largest coordinate at which a function is evaluated beside a convex set, in its local frame.
template <int D>
double largest_query_coordinate(const DistanceFunction<D>& function, const Convex<D>& set) {
    const Affine<D> back = inverse(function.place, determinant(function.place));
    return largest(back.point(reference_point(set))) * min_scale_factor<D>(function);
}
/// Beside another part it is that of the function's box.
template <int D>
double largest_query_coordinate(const DistanceFunction<D>& function) {
    double largest_bound = 0;
    for (int i = 0; i < D; ++i)
        for (const float bound : {function.bounds.min[i], function.bounds.max[i]})
            if (std::isfinite(bound)) largest_bound = std::max(largest_bound, std::abs(static_cast<double>(bound)));
    return largest_bound * min_scale_factor<D>(function);
}

template <int D>
SignedDistance<D> no_distance() {
    SignedDistance<D> result;
    result.distance = std::numeric_limits<double>::infinity();
    result.normal = axis<D>(0);
    result.on_a = DVec<D>(0.0);
    return result;
}

/// The corners of a convex set that are as deep as its deepest point, if it has few corners.
template <int D>
ClosestCorners<D> corners_at(const Convex<D>& set, const DVec<D>& place, const DVec<D>& out, double rounding) {
    ClosestCorners<D> result;
    constexpr std::uint32_t few = 8;
    const bool has_few =
        set.inner_radius == 0 && (set.core == Core::box || (set.core == Core::points && set.count <= few));
    result.a[0] = core_support(set, -out).index;
    if (!has_few) return result;
    std::size_t count = 0;
    const std::uint32_t corners = set.core == Core::box ? 1u << D : set.count;
    for (std::uint32_t i = 0; i < corners && count < result.a.size(); ++i)
        if (dot(out, set.place.point(local_corner(set, i)) - place) <= rounding) result.a[count++] = i;
    result.count = std::max<std::size_t>(count, 1);
    return result;
}

/// The distance of a ball from a function: one evaluation.
template <int D>
SignedDistance<D> from_ball(const Convex<D>& ball, const DistanceFunction<D>& function,
                            const DistanceRequest& request) {
    if (has_no_extent(function.bounds)) return no_distance<D>();
    const PlacedFunction<D> placed(function);
    const DVec<D> middle = ball.place.point(DVec<D>(ball.vertices()[0]));
    const double value = placed.at(middle);
    if (!(value - ball.radius <= request.reach && value < std::numeric_limits<double>::infinity()))
        return no_distance<D>();
    SignedDistance<D> result;
    result.distance = value - ball.radius;
    const double around = std::max({1e-2 * ball.radius, 1e-4 * std::abs(value), 1e-30});
    result.normal = -placed.normal(middle, placed.step(middle, around));
    result.on_a = middle + result.normal * ball.radius;
    return result;
}

/// The distance of a convex set from a function, in the frame of the function. For a box beside a function without
/// bounds, in the frame of the box, as the search splits boxes along its axes.
template <int D>
SignedDistance<D> from_convex(const Convex<D>& set, const DistanceFunction<D>& function, double margin,
                              const DistanceRequest& request) {
    if (has_no_extent(function.bounds)) return no_distance<D>();
    const bool by_function = function.bound != nullptr || !is_plain_box(set);
    const Affine<D> frame = by_function ? own_frame<D>(function) : own_frame<D>(set), back = back_from(frame);
    const DistanceFunction<D> own = moved(function, back);
    const Convex<D> local_set = moved(set, back);
    const PlacedFunction<D> placed(own);
    MinimumOptions<D> options;
    options.tolerance =
        std::max((function.bound != nullptr ? bounded_tolerance : search_tolerance) * margin, request.tolerance);
    options.sufficient = request.sufficient + set.radius;
    options.reach = request.reach + set.radius;
    const Minimum<D> minimum = minimum_in_convex(placed, local_set, options);
    if (!(minimum.distance < std::numeric_limits<double>::infinity())) return no_distance<D>();
    SignedDistance<D> result = distance_at_point(local_set, placed, minimum.point, minimum.distance - set.radius);
    result.normal = frame.vector(result.normal);
    result.on_a = frame.point(result.on_a);
    return result;
}

/// The distance of a function from a half-space.
template <int D>
SignedDistance<D> above_half_space(const DistanceFunction<D>& function, const HalfSpaceView<D>& half_space,
                                   const DVec<D>& normal, double tolerance, double surface_tolerance,
                                   const DistanceRequest& request, int max_boxes) {
    if (has_no_extent(function.bounds)) return no_distance<D>();
    const bool has_bounds = is_bounded(function.bounds);
    ABUT_ASSERT(has_bounds);
    if (!has_bounds) return no_distance<D>();
    const Affine<D> frame = own_frame<D>(function), back = back_from(frame);
    const DistanceFunction<D> own = moved(function, back);
    const PlacedFunction<D> placed(own);
    // The plane through the origin of the frame has this height.
    const double height = dot(half_space.normal, frame.offset) - half_space.offset;
    MinimumOptions<D> options;
    options.tolerance = std::max(tolerance, request.tolerance);
    options.max_boxes = max_boxes;
    options.sufficient = request.sufficient - height;
    options.reach = request.reach - height;
    const Minimum<D> minimum = lowest_inside(placed, bounds(own), back.vector(normal), surface_tolerance, options);
    if (!(minimum.distance < std::numeric_limits<double>::infinity())) return no_distance<D>();
    SignedDistance<D> result;
    result.normal = -half_space.normal;
    result.on_a = frame.point(minimum.point);
    result.distance = dot(half_space.normal, frame.vector(minimum.point)) + height;
    return result;
}

template <int D>
SignedDistance<D> between(const DistanceFunction<D>& a, const DistanceFunction<D>& b, double margin,
                          const DistanceRequest& request) {
    if (has_no_extent(a.bounds) || has_no_extent(b.bounds)) return no_distance<D>();
    const bool bounded_a = is_bounded(a.bounds), bounded_b = is_bounded(b.bounds);
    const bool has_bounds = bounded_a || bounded_b;
    ABUT_ASSERT(has_bounds);
    if (!has_bounds) return no_distance<D>();
    // In the frame of the one with bounds, or of the smaller of two.
    const bool by_a = bounded_a && (!bounded_b || size(a) <= size(b));
    const DistanceFunction<D>& smaller = by_a ? a : b;
    const Affine<D> frame = own_frame<D>(smaller), back = back_from(frame);
    const DistanceFunction<D> own_a = moved(a, back), own_b = moved(b, back);
    const PlacedFunction<D> placed_a(own_a), placed_b(own_b);
    const Aabb<D> own_box = bounds(by_a ? own_a : own_b);
    const double around = std::max(0.5 * length(DVec<D>(own_box.max) - DVec<D>(own_box.min)), 1e-30);
    MinimumOptions<D> options;
    options.tolerance = 0.5 * std::max(search_tolerance * margin, request.tolerance);
    options.sufficient = 0.5 * request.sufficient;
    options.reach = 0.5 * request.reach;
    // The minimum lies between the two, no farther from the smaller shape than its centre is from the other.
    const DVec<D> middle = (DVec<D>(own_box.min) + DVec<D>(own_box.max)) * 0.5;
    const double beyond = std::max({placed_a.at(middle), placed_b.at(middle), 0.0});
    const double reach = std::isfinite(beyond) ? beyond : 0;
    const Minimum<D> minimum =
        minimum_of_larger(placed_a, placed_b, grown(own_box, static_cast<float>(reach)), around, options);
    if (!(minimum.distance < std::numeric_limits<double>::infinity())) return no_distance<D>();
    SignedDistance<D> result;
    const DVec<D> out_a = placed_a.normal(minimum.point, placed_a.step(minimum.point, around)),
                  out_b = placed_b.normal(minimum.point, placed_b.step(minimum.point, around));
    const DVec<D> direction = normalized(out_a - out_b, out_a);
    result.distance = 2 * minimum.distance;
    result.normal = frame.vector(direction);
    result.on_a = frame.point(minimum.point - direction * minimum.distance);
    return result;
}

template <int D>
ManifoldPoint<D> contact_point(const DVec<D>& on_convex, const DVec<D>& out, double gap, bool near_misses,
                               std::uint32_t name) {
    return {on_convex - out * (0.5 * gap), near_misses ? -gap : std::max(-gap, 0.0), name};
}

/// The contact points of a convex set and a function: the points of its face near the function. `out` is the normal out
/// of the function's shape, and `distance` that of the set.
template <int D>
Manifold<D> points_of_face(const Convex<D>& set, const DistanceFunction<D>& function, const SignedDistance<D>& distance,
                           double margin) {
    const DVec<D> out = -distance.normal;
    if (is_ball(set)) {
        Manifold<D> result;
        result.points[result.count++] = contact_point(distance.on_a, out, distance.distance, true, 0);
        return result;
    }
    const PlacedFunction<D> placed(function);
    const double rounding = 1e-6 * size(set);
    ManifoldCandidates<D> candidates;
    bool has_deepest = false;
    const Face<D> face = face_along(set, -out);
    for (std::size_t i = 0; i < face.count; ++i) {
        const double gap = std::max(placed.at(face.points[i]) - set.radius, distance.distance);
        if (gap > margin + rounding) continue;
        candidates.push_back(contact_point(face.points[i] - out * set.radius, out, gap, margin > 0, face.indices[i]));
        has_deepest = has_deepest || gap <= distance.distance + rounding;
    }
    if (!has_deepest)
        candidates.push_back(contact_point(distance.on_a, out, distance.distance, true, distance.corners.a[0]));
    return reduced_manifold(candidates, distance.normal, rounding);
}

/// Evenly distributed directions perpendicular to a normal.
template <int D>
std::array<DVec<D>, D == 2 ? 2 : 4> around(const DVec<D>& normal) {
    const DVec<D> first = perpendicular(normal);
    if constexpr (D == 2) {
        return {first, -first};
    } else {
        const DVec<3> second = cross(normal, first);
        return {first, second, -first, -second};
    }
}

/// The contact points of a function's shape on a plane: the lowest point, and the lowest ones for tilted planes.
template <int D>
Manifold<D> points_on_plane(const DistanceFunction<D>& function, const HalfSpaceView<D>& half_space,
                            const SignedDistance<D>& distance, double margin, double tolerance) {
    ManifoldCandidates<D> candidates;
    const double rounding = 2 * tolerance;
    const auto add = [&](const DVec<D>& on_function, double gap, std::uint32_t name) {
        const DVec<D> middle = on_function - half_space.normal * (0.5 * gap);
        for (std::size_t i = 0; i < candidates.count; ++i)
            if (length(candidates.points[i].position - middle) <= 1e3 * tolerance) return;
        candidates.push_back({middle, margin > 0 ? -gap : std::max(-gap, 0.0), name});
    };
    add(distance.on_a, distance.distance, 0);
    candidates.points[0].depth = -distance.distance;
    std::uint32_t name = 1;
    for (const DVec<D>& aside : around<D>(half_space.normal)) {
        const SignedDistance<D> tilted =
            above_half_space(function, half_space, normalized(half_space.normal + aside * tilt),
                             tilted_tolerance * size(function), search_tolerance * tolerance, {}, max_boxes_tilted);
        if (tilted.distance <= margin + rounding) add(tilted.on_a, tilted.distance, name);
        ++name;
    }
    return reduced_manifold(candidates, distance.normal, rounding);
}

}  // namespace

template <int D>
double function_tolerance(const Part<D>& a, const Part<D>& b) {
    if (!a.is_function()) return function_tolerance(b, a);
    const double smaller = std::min(size(a), size(b));
    double coordinate =
        b.is_convex() ? largest_query_coordinate(a.function(), b.convex()) : largest_query_coordinate(a.function());
    if (b.is_function()) coordinate = std::max(coordinate, largest_query_coordinate(b.function()));
    return tolerance_for(std::isfinite(smaller) ? smaller : 0, coordinate + (std::isfinite(smaller) ? smaller : 0));
}

template <int D>
double function_search_tolerance(const Part<D>& a, const Part<D>& b) {
    const double margin = function_tolerance(a, b), smaller = std::min(size(a), size(b));
    // Functions that need no search, functions with bounds for boxes, and all others.
    double of_size = 0;
    for (const Part<D>* part : {&a, &b}) {
        if (part->is_convex() && is_ball(part->convex())) return margin;
        if (part->is_function()) of_size = std::max(of_size, part->function().bound != nullptr ? 1e-4 : 1e-3);
    }
    return std::isfinite(smaller) ? std::max(margin, of_size * smaller) : margin;
}

template <int D>
SignedDistance<D> function_distance(const Part<D>& a, const Part<D>& b, const DistanceRequest& request) {
    if (a.kind() > b.kind()) {
        SignedDistance<D> result = function_distance(b, a, request);
        if (std::isfinite(result.distance)) flip(result);
        return result;
    }
    if (a.is_convex() && is_ball(a.convex())) return from_ball(a.convex(), b.function(), request);
    const double margin = function_tolerance(a, b);
    if (a.is_convex()) return from_convex(a.convex(), b.function(), margin, request);
    if (b.is_function()) return between(a.function(), b.function(), margin, request);
    return above_half_space(a.function(), b.half_space(), b.half_space().normal, search_tolerance * margin,
                            search_tolerance * margin, request, max_boxes_above_half_space);
}

template <int D>
SignedDistance<D> distance_at_point(const Convex<D>& set, const PlacedFunction<D>& function, const DVec<D>& point,
                                    double distance) {
    SignedDistance<D> result;
    const double around = std::max(size(set), 1e-30);
    const DVec<D> out = function.normal(point, function.step(point, around));
    result.distance = distance;
    result.normal = -out;
    result.on_a = point - out * set.radius;
    result.corners = corners_at(set, point, out, 1e-3 * around);
    return result;
}

template <int D>
bool function_overlap(const Part<D>& a, const Part<D>& b) {
    if (a.kind() > b.kind()) return function_overlap(b, a);
    if (a.is_convex() && is_ball(a.convex()) && !has_no_extent(b.function().bounds)) {
        const Convex<D>& ball = a.convex();
        return PlacedFunction<D>(b.function()).at(ball.place.point(DVec<D>(ball.vertices()[0]))) <= ball.radius;
    }
    return function_distance(a, b, {0, 0}).distance <= 0;
}

template <int D>
bool function_contact(const Part<D>& a, const Part<D>& b, double reach, double margin, PartContact<D>& contact) {
    const SignedDistance<D>& distance = contact.distance =
        function_distance(a, b, {-std::numeric_limits<double>::infinity(), reach});
    if (!(distance.distance <= reach)) return false;
    if (a.is_convex()) {
        contact.manifold = points_of_face(a.convex(), b.function(), distance, margin);
    } else if (b.is_half_space()) {
        contact.manifold = points_on_plane(a.function(), b.half_space(), distance, margin, function_tolerance(a, b));
    } else {
        contact.manifold.count = 1;
        contact.manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                                      0};
    }
    return true;
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template SignedDistance<D> distance_at_point(const Convex<D>&, const PlacedFunction<D>&, const DVec<D>&, double); \
    template double function_tolerance(const Part<D>&, const Part<D>&);                                               \
    template double function_search_tolerance(const Part<D>&, const Part<D>&);                                        \
    template bool function_overlap(const Part<D>&, const Part<D>&);                                                   \
    template SignedDistance<D> function_distance(const Part<D>&, const Part<D>&, const DistanceRequest&);             \
    template bool function_contact(const Part<D>&, const Part<D>&, double, double, PartContact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
