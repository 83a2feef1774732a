#include <abut/convex/tolerance.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/function_pairs.hpp>
#include <abut/query/least_distance.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {
namespace {

/// In parts of the margin of doubt, so that all that is rounded besides stays within it.
constexpr double search_tolerance = 0.25;

/// The same of a function that bounds itself, beside a convex set: the search leaves out nothing.
constexpr double bounded_tolerance = 0.5;

/// A plane that leans by this much touches a shape at a corner beside the lowest one.
constexpr double lean = 0.02;

/// What lies lowest for those needn't be found so exactly.
constexpr double leaning_tolerance = 1e-3;

/// The bounds on boxes above a half-space.
constexpr int most_boxes_over_solid = 1024, most_boxes_leaning = 128;

/// And of a search on a way, a shorter part of which may take fewer.
constexpr int most_boxes_of_way = 192;

template <int D>
bool is_bounded(const Aabb<D>& box) {
    return is_finite(box.min) && is_finite(box.max);
}
template <int D>
bool has_nothing(const Aabb<D>& box) {
    return !(box.min[0] <= box.max[0]);
}

template <int D>
double finite_size(const Convex<D>& part) {
    return size(part);
}
template <int D>
double finite_size(const HalfSpaceView<D>&) {
    return std::numeric_limits<double>::infinity();
}
template <int D>
double finite_size(const DistanceFunction<D>& part) {
    return is_bounded(part.bounds) ? size(part) : std::numeric_limits<double>::infinity();
}

/// The largest coordinate that a function is asked of in its own frame.
template <int D>
double largest_asked(const DistanceFunction<D>& function, const Convex<D>& other) {
    const Affine<D> back = inverse(function.place, determinant(function.place));
    return largest(back.point(reference_point(other))) * min_scale_factor<D>(function);
}
template <int D>
double largest_own(const DistanceFunction<D>& function) {
    double most = 0;
    for (int i = 0; i < D; ++i)
        for (const float bound : {function.bounds.min[i], function.bounds.max[i]})
            if (std::isfinite(bound)) most = std::max(most, std::abs(static_cast<double>(bound)));
    return most * min_scale_factor<D>(function);
}
template <int D>
double largest_asked(const DistanceFunction<D>& function, const HalfSpaceView<D>&) {
    return largest_own(function);
}
template <int D>
double largest_asked(const DistanceFunction<D>& function, const DistanceFunction<D>& other) {
    return std::max(largest_own(function), largest_own(other));
}

template <int D>
SignedDistance<D> nothing_near() {
    SignedDistance<D> result;
    result.distance = std::numeric_limits<double>::infinity();
    result.normal = axis<D>(0);
    result.on_a = DVec<D>(0.0);
    return result;
}

template <int D>
bool is_ball(const Convex<D>& part) {
    return part.core == Core::points && part.count == 1 && part.inner_radius == 0;
}

/// The corners that are as deep as the deepest place of a convex set, as far as they can be told.
template <int D>
ClosestCorners<D> corners_at(const Convex<D>& set, const DVec<D>& place, const DVec<D>& out, double slack) {
    ClosestCorners<D> result;
    constexpr std::uint32_t few = 8;
    const bool has_few =
        set.inner_radius == 0 && (set.core == Core::box || (set.core == Core::points && set.count <= few));
    result.a[0] = core_support(set, -out).index;
    if (!has_few) return result;
    std::size_t count = 0;
    const std::uint32_t corners = set.core == Core::box ? 1u << D : set.count;
    for (std::uint32_t i = 0; i < corners && count < result.a.size(); ++i)
        if (dot(out, set.place.point(local_corner(set, i)) - place) <= slack) result.a[count++] = i;
    result.count = std::max<std::size_t>(count, 1);
    return result;
}

/// Of a ball and a function: one look-up.
template <int D>
SignedDistance<D> from_ball(const Convex<D>& ball, const DistanceFunction<D>& function, const DistanceWanted& wanted) {
    if (has_nothing(function.bounds)) return nothing_near<D>();
    const FunctionThere<D> seen(function);
    const DVec<D> middle = ball.place.point(DVec<D>(ball.vertices()[0]));
    const double there = seen.at(middle);
    if (!(there - ball.radius <= wanted.reach && there < std::numeric_limits<double>::infinity()))
        return nothing_near<D>();
    SignedDistance<D> result;
    result.distance = there - ball.radius;
    const double around = std::max({1e-2 * ball.radius, 1e-4 * std::abs(there), 1e-30});
    result.normal = -seen.normal(middle, seen.step(middle, around));
    result.on_a = middle + result.normal * ball.radius;
    return result;
}

/// Of a convex set and a function, seen in the function's frame; in its own, a box beside a function that doesn't bound
/// itself, as that is searched box by box.
template <int D>
SignedDistance<D> from_convex(const Convex<D>& set, const DistanceFunction<D>& function, double margin,
                              const DistanceWanted& wanted) {
    if (has_nothing(function.bounds)) return nothing_near<D>();
    const bool by_function = function.bound != nullptr || !is_plain_box(set);
    const Affine<D> frame = by_function ? own_frame<D>(function) : own_frame<D>(set), back = back_from(frame);
    const DistanceFunction<D> own = moved(function, back);
    const Convex<D> there = moved(set, back);
    const FunctionThere<D> seen(own);
    LeastOptions<D> options;
    options.tolerance =
        std::max((function.bound != nullptr ? bounded_tolerance : search_tolerance) * margin, wanted.rough);
    options.enough = wanted.enough + set.radius;
    options.reach = wanted.reach + set.radius;
    options.most_boxes = wanted.most_boxes;
    const Least<D> least =
        function.bound != nullptr ? least_bounded(seen, there, options) : least_in(seen, there, options);
    if (!(least.distance < std::numeric_limits<double>::infinity())) return nothing_near<D>();
    SignedDistance<D> result;
    const double around = std::max(size(there), 1e-30);
    const DVec<D> out = seen.normal(least.point, seen.step(least.point, around));
    result.distance = least.distance - set.radius;
    result.normal = frame.vector(-out);
    result.on_a = frame.point(least.point - out * set.radius);
    result.corners = corners_at(there, least.point, out, 1e-3 * around);
    return result;
}

/// Of a function and a half-space.
template <int D>
SignedDistance<D> over_solid(const DistanceFunction<D>& function, const HalfSpaceView<D>& solid, const DVec<D>& normal,
                             double tolerance, double off, const DistanceWanted& wanted, int most_boxes) {
    if (has_nothing(function.bounds)) return nothing_near<D>();
    const bool has_bounds = is_bounded(function.bounds);
    ABUT_ASSERT(has_bounds);
    if (!has_bounds) return nothing_near<D>();
    const Affine<D> frame = own_frame<D>(function), back = back_from(frame);
    const DistanceFunction<D> own = moved(function, back);
    const FunctionThere<D> seen(own);
    // A plane of the frame, through its origin.
    const double height = dot(solid.normal, frame.offset) - solid.offset;
    LeastOptions<D> options;
    options.tolerance = std::max(tolerance, wanted.rough);
    options.off = off;
    options.most_boxes = most_boxes;
    options.enough = wanted.enough - height;
    options.reach = wanted.reach - height;
    const Least<D> least = lowest_inside(seen, bounds(own), back.vector(normal), options);
    if (!(least.distance < std::numeric_limits<double>::infinity())) return nothing_near<D>();
    SignedDistance<D> result;
    result.normal = -solid.normal;
    result.on_a = frame.point(least.point);
    result.distance = dot(solid.normal, frame.vector(least.point)) + height;
    return result;
}

template <int D>
SignedDistance<D> between(const DistanceFunction<D>& a, const DistanceFunction<D>& b, double margin,
                          const DistanceWanted& wanted) {
    if (has_nothing(a.bounds) || has_nothing(b.bounds)) return nothing_near<D>();
    const bool bounded_a = is_bounded(a.bounds), bounded_b = is_bounded(b.bounds);
    const bool has_bounds = bounded_a || bounded_b;
    ABUT_ASSERT(has_bounds);
    if (!has_bounds) return nothing_near<D>();
    // Seen by the one that has bounds, the smaller of two.
    const bool by_a = bounded_a && (!bounded_b || size(a) <= size(b));
    const DistanceFunction<D>& smaller = by_a ? a : b;
    const Affine<D> frame = own_frame<D>(smaller), back = back_from(frame);
    const DistanceFunction<D> own_a = moved(a, back), own_b = moved(b, back);
    const FunctionThere<D> seen_a(own_a), seen_b(own_b);
    const Aabb<D> own_box = bounds(by_a ? own_a : own_b);
    const double around = std::max(0.5 * length(DVec<D>(own_box.max) - DVec<D>(own_box.min)), 1e-30);
    LeastOptions<D> options;
    options.tolerance = 0.5 * std::max(search_tolerance * margin, wanted.rough);
    options.enough = 0.5 * wanted.enough;
    options.reach = 0.5 * wanted.reach;
    // Between the two a point is nearest to both; it is no farther from the smaller than its middle is from the other.
    const DVec<D> middle = (DVec<D>(own_box.min) + DVec<D>(own_box.max)) * 0.5;
    const double beyond = std::max({seen_a.at(middle), seen_b.at(middle), 0.0});
    const double reach = std::isfinite(beyond) ? beyond : 0;
    const Least<D> least = least_of_both(seen_a, seen_b, grown(own_box, static_cast<float>(reach)), around, options);
    if (!(least.distance < std::numeric_limits<double>::infinity())) return nothing_near<D>();
    SignedDistance<D> result;
    const DVec<D> out_a = seen_a.normal(least.point, seen_a.step(least.point, around)),
                  out_b = seen_b.normal(least.point, seen_b.step(least.point, around));
    const DVec<D> way = normalized(out_a - out_b, out_a);
    result.distance = 2 * least.distance;
    result.normal = frame.vector(way);
    result.on_a = frame.point(least.point - way * least.distance);
    return result;
}

template <int D>
ManifoldPoint<D> meeting_point(const DVec<D>& on_convex, const DVec<D>& out, double gap, bool near_misses,
                               std::uint32_t name) {
    return {on_convex - out * (0.5 * gap), near_misses ? -gap : std::max(-gap, 0.0), name};
}

/// The points of a convex set at a function: where its face comes near. `out` is the normal out of the function's
/// shape, and `distance` that of the set.
template <int D>
Manifold<D> points_of_face(const Convex<D>& set, const DistanceFunction<D>& function, const SignedDistance<D>& distance,
                           double margin) {
    const DVec<D> out = -distance.normal;
    if (is_ball(set)) {
        Manifold<D> result;
        result.points[result.count++] = meeting_point(distance.on_a, out, distance.distance, true, 0);
        return result;
    }
    const FunctionThere<D> seen(function);
    const double slack = 1e-6 * size(set);
    ManifoldCandidates<D> candidates;
    bool has_deepest = false;
    const Face<D> face = face_along(set, -out);
    for (std::size_t i = 0; i < face.count; ++i) {
        const double gap = std::max(seen.at(face.points[i]) - set.radius, distance.distance);
        if (gap > margin + slack) continue;
        candidates.push_back(meeting_point(face.points[i] - out * set.radius, out, gap, margin > 0, face.indices[i]));
        has_deepest = has_deepest || gap <= distance.distance + slack;
    }
    if (!has_deepest)
        candidates.push_back(meeting_point(distance.on_a, out, distance.distance, true, distance.corners.a[0]));
    return reduced_manifold(candidates, distance.normal, slack);
}

/// Directions across a normal, evenly around.
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

/// The points of a function's shape on a plane: the lowest, and those that are lowest for planes that lean.
template <int D>
Manifold<D> points_on_plane(const DistanceFunction<D>& function, const HalfSpaceView<D>& solid,
                            const SignedDistance<D>& distance, double margin, double doubt) {
    ManifoldCandidates<D> candidates;
    const double slack = 2 * doubt;
    const auto add = [&](const DVec<D>& on_function, double gap, std::uint32_t name) {
        const DVec<D> middle = on_function - solid.normal * (0.5 * gap);
        for (std::size_t i = 0; i < candidates.count; ++i)
            if (length(candidates.points[i].position - middle) <= 1e3 * doubt) return;
        candidates.push_back({middle, margin > 0 ? -gap : std::max(-gap, 0.0), name});
    };
    add(distance.on_a, distance.distance, 0);
    candidates.points[0].depth = -distance.distance;
    std::uint32_t name = 1;
    for (const DVec<D>& aside : around<D>(solid.normal)) {
        const SignedDistance<D> leaning =
            over_solid(function, solid, normalized(solid.normal + aside * lean), leaning_tolerance * size(function),
                       search_tolerance * doubt, {}, most_boxes_leaning);
        if (leaning.distance <= margin + slack) add(leaning.on_a, leaning.distance, name);
        ++name;
    }
    return reduced_manifold(candidates, distance.normal, slack);
}

}  // namespace

template <class A, class B>
requires FunctionPair<A, B>
double function_margin(const A& a, const B& b) {
    const double smaller = std::min(finite_size(a), finite_size(b));
    double asked = 0;
    if constexpr (is_function<A>)
        asked = largest_asked(a, b);
    else
        asked = largest_asked(b, a);
    return tolerance_for(std::isfinite(smaller) ? smaller : 0, asked + (std::isfinite(smaller) ? smaller : 0));
}

template <class A, class B>
requires FunctionPair<A, B>
double function_doubt(const A& a, const B& b) {
    constexpr int D = PartDimension<A>::value;
    const double margin = function_margin(a, b), smaller = std::min(finite_size(a), finite_size(b));
    // What needs no search, what tells of boxes, and the rest.
    double of_size = 0;
    const auto look_at = [&](const auto& part) {
        using Part = std::remove_cvref_t<decltype(part)>;
        if constexpr (is_function<Part>) of_size = std::max(of_size, part.bound != nullptr ? 1e-4 : 1e-3);
    };
    look_at(a);
    look_at(b);
    if constexpr (std::is_same_v<A, Convex<D>>)
        if (is_ball(a)) return margin;
    if constexpr (std::is_same_v<B, Convex<D>>)
        if (is_ball(b)) return margin;
    return std::isfinite(smaller) ? std::max(margin, of_size * smaller) : margin;
}

template <class A, class B>
requires FunctionPair<A, B> SignedDistance<PartDimension<A>::value> function_distance(const A& a, const B& b,
                                                                                      const DistanceWanted& wanted) {
    constexpr int D = PartDimension<A>::value;
    if constexpr (std::is_same_v<A, Convex<D>>)
        if (is_ball(a)) return from_ball(a, b, wanted);
    const double margin = function_margin(a, b);
    if constexpr (is_function<A> && is_function<B>) {
        return between(a, b, margin, wanted);
    } else if constexpr (is_function<B>) {
        if constexpr (std::is_same_v<A, Convex<D>>) {
            return from_convex(a, b, margin, wanted);
        } else {
            SignedDistance<D> result = over_solid(b, a, a.normal, search_tolerance * margin, search_tolerance * margin,
                                                  wanted, most_boxes_over_solid);
            if (std::isfinite(result.distance)) swap_roles(result);
            return result;
        }
    } else if constexpr (std::is_same_v<B, Convex<D>>) {
        SignedDistance<D> result = is_ball(b) ? from_ball(b, a, wanted) : from_convex(b, a, margin, wanted);
        if (std::isfinite(result.distance)) swap_roles(result);
        return result;
    } else {
        return over_solid(a, b, b.normal, search_tolerance * margin, search_tolerance * margin, wanted,
                          most_boxes_over_solid);
    }
}

template <int D>
bool stays_apart(const Convex<D>& first, const Convex<D>& last, double wide, const DistanceFunction<D>& function,
                 DVec<D>& place) {
    if (has_nothing(function.bounds)) return true;
    const double margin = function_margin(first, function), radius = first.radius + wide;
    const Affine<D> frame = own_frame<D>(function), back = back_from(frame);
    const DistanceFunction<D> own = moved(function, back);
    const FunctionThere<D> seen(own);
    LeastOptions<D> options;
    options.tolerance = 0.25 * margin;
    options.reach = options.enough = radius - 0.75 * margin;
    options.no_less = radius - function_doubt(first, function);
    options.most_boxes = most_boxes_of_way;
    const Least<D> least = least_bounded(seen, moved(first, back), moved(last, back), options);
    if (least.at_least >= std::min(options.no_less, radius - margin)) return true;
    place = frame.point(least.point);
    return false;
}

template <class A, class B>
requires FunctionPair<A, B>
bool function_overlap(const A& a, const B& b) {
    constexpr int D = PartDimension<A>::value;
    if constexpr (std::is_same_v<A, Convex<D>>) {
        if (is_ball(a) && !has_nothing(b.bounds))
            return FunctionThere<D>(b).at(a.place.point(DVec<D>(a.vertices()[0]))) <= a.radius;
    } else if constexpr (std::is_same_v<B, Convex<D>>) {
        return function_overlap(b, a);
    }
    return function_distance(a, b, {0, 0}).distance <= 0;
}

template <class A, class B>
requires FunctionPair<A, B>
bool part_contact(const A& a, const B& b, double reach, double margin, const SearchOptions<PartDimension<A>::value>&,
                  PartContact<PartDimension<A>::value>& contact) {
    constexpr int D = PartDimension<A>::value;
    contact.distance = function_distance(a, b, {-std::numeric_limits<double>::infinity(), reach});
    SignedDistance<D>& distance = contact.distance;
    if (!(distance.distance <= reach)) return false;
    if constexpr (is_function<A> && is_function<B>) {
        const DVec<D> middle = distance.on_a + distance.normal * (0.5 * distance.distance);
        contact.manifold.count = 1;
        contact.manifold.points[0] = {middle, -distance.distance, 0};
    } else if constexpr (std::is_same_v<A, Convex<D>>) {
        contact.manifold = points_of_face(a, b, distance, margin);
    } else if constexpr (std::is_same_v<B, Convex<D>>) {
        SignedDistance<D> turned = distance;
        swap_roles(turned);
        contact.manifold = points_of_face(b, a, turned, margin);
    } else if constexpr (std::is_same_v<A, HalfSpaceView<D>>) {
        SignedDistance<D> turned = distance;
        swap_roles(turned);
        contact.manifold = points_on_plane(b, a, turned, margin, function_margin(a, b));
    } else {
        contact.manifold = points_on_plane(a, b, distance, margin, function_margin(a, b));
    }
    return true;
}

#define ABUT_INSTANTIATE_FOR(D, A, B)                                                        \
    template double function_margin(const A&, const B&);                                     \
    template double function_doubt(const A&, const B&);                                      \
    template bool function_overlap(const A&, const B&);                                      \
    template SignedDistance<D> function_distance(const A&, const B&, const DistanceWanted&); \
    template bool part_contact(const A&, const B&, double, double, const SearchOptions<D>&, PartContact<D>&);
#define ABUT_INSTANTIATE(D)                                                                                      \
    template bool stays_apart(const Convex<D>&, const Convex<D>&, double, const DistanceFunction<D>&, DVec<D>&); \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, Convex<D>)                                                      \
    ABUT_INSTANTIATE_FOR(D, Convex<D>, DistanceFunction<D>)                                                      \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, HalfSpaceView<D>)                                               \
    ABUT_INSTANTIATE_FOR(D, HalfSpaceView<D>, DistanceFunction<D>)                                               \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, DistanceFunction<D>)
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
#undef ABUT_INSTANTIATE_FOR

}  // namespace abut
