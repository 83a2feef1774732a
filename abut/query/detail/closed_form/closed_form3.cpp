#include <abut/convex/manifold/round_manifold.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/core_pairs3.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/shape/polyhedron.hpp>

#include <bit>

namespace abut::detail {
namespace {

/// The features of cores, by two sets of bits: the axes along which a feature doesn't extend, plus 8 times those at
/// their low end.
constexpr std::array<Feature, 64> core_features = [] {
    std::array<Feature, 64> result{};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t fixed = i & 7u, low = i >> 3 & fixed;
        const int count = std::popcount(fixed);
        if (count == 1) result[i] = {0, (fixed & 6u) + (low != 0 ? 1u : 0u), FeatureKind::face};
        if (count == 2) result[i] = {0, edge_index(low, low | (fixed ^ 7u)), FeatureKind::edge};
        if (count == 3) result[i] = {0, low, FeatureKind::vertex};
    }
    return result;
}();

template <class Answer>
void write_features(const CoresDistance& found, Answer& result) {
    result.feature_a = core_features[(found.part_a.free ^ 7u) + 8 * found.part_a.low];
    result.feature_b = core_features[(found.part_b.free ^ 7u) + 8 * found.part_b.low];
}

[[gnu::always_inline]] inline void write_closest(const CoresDistance& found, Closest<3>& result) {
    result.distance = static_cast<float>(found.distance[0]);
    store(found.normal, result.normal);
    store(found.on_a, result.on_a);
    store(found.on_b(), result.on_b);
    write_features(found, result);
}

// A function for each pair of cores, out of line, so that each keeps its numbers in registers.

template <class A, class B>
[[gnu::noinline]] bool closest_in_full(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result) {
    CoresDistance found;
    if (!distance_of(core_of<A>(a), core_of<B>(b), cache, found)) return false;
    write_closest(found, result);
    return true;
}

template <class A, class B>
[[gnu::noinline]] bool closest_of(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result) {
    CoresDistance found;
    if (a.pose == nullptr && b.pose == nullptr && short_distance(core_in_place<A>(a), core_in_place<B>(b), found) &&
        lanes::finite(found.distance)) {
        write_closest(found, result);
        return true;
    }
    return closest_in_full<A, B>(a, b, cache, result);
}

template <class A, class B>
[[gnu::noinline]] PairAnswer overlap_of_kinds(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache) {
    return overlap_of(core_of<A>(a), core_of<B>(b), cache);
}

template <class A, class B>
[[gnu::noinline]] PairAnswer contact_of(const ShapeRef<3>& given_a, const ShapeRef<3>& given_b, double margin,
                                        Cache* cache, Contact<3>& result) {
    const A a = core_of<A>(given_a);
    const B b = core_of<B>(given_b);
    CoresDistance found;
    SignedDistance<3> distance;
    Manifold<3> points;
    if constexpr (std::is_same_v<A, PlacedBox> && std::is_same_v<B, PlacedBox>) {
        const PairAnswer answer = contact_of_boxes(a, b, margin, margin, cache, found, points);
        if (answer != PairAnswer::yes) return answer;
        set_distance(found, distance);
    } else {
        if (are_apart(a, b, margin)) return PairAnswer::no;
        if (!distance_of(a, b, cache, found)) return PairAnswer::unknown;
        if (found.distance[0] > margin) return PairAnswer::no;
        set_distance(found, distance);
        if (!core_manifold(a, b, distance, margin, points)) return PairAnswer::unknown;
    }
    write(distance, points, result);
    write_features(found, result);
    return PairAnswer::yes;
}

/// A ball around a box, a sphere or a polyhedron.
bool set_ball(const ShapeRef<3>& given, BoundingBall<3>& ball) {
    if (given.kind == ShapeKind::box) {
        const Box3& box = given.as<Box3>();
        const glm::quat& q = box.rotation;
        // NaN if the rotation isn't finite.
        const double nothing = 0 * static_cast<double>(q.w + q.x + q.y + q.z);
        ball = {DVec<3>(box.center), length(DVec<3>(box.half)) + nothing};
    } else if (given.kind == ShapeKind::polytope) {
        ball = given.as<Polyhedron>().ball();
    } else if (given.kind == ShapeKind::ball) {
        const Sphere& sphere = given.as<Sphere>();
        ball = {DVec<3>(sphere.center), static_cast<double>(sphere.radius)};
    } else {
        return false;
    }
    if (given.pose != nullptr) ball.center = placed<3>(ball.center, *given.pose);
    return true;
}

/// Whether the bounding spheres are farther apart than `reach`, which rejects most pairs at once.
bool bounding_balls_apart(const ShapeRef<3>& a, const ShapeRef<3>& b, double reach) {
    BoundingBall<3> first, second;
    if (!(reach >= 0) || !set_ball(a, first) || !set_ball(b, second)) return false;
    const double radii = first.radius + second.radius + reach, square = length_squared(second.center - first.center);
    return square > radii * radii * (1 + 1e-12) && std::isfinite(square);
}

}  // namespace

PairAnswer closed_form_overlap(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache) {
    const PairAnswer answer = with_kinds(a, b, PairAnswer::unknown, [&](auto kind_a, auto kind_b) {
        return overlap_of_kinds<typename decltype(kind_a)::type, typename decltype(kind_b)::type>(a, b, cache);
    });
    return answer == PairAnswer::unknown && bounding_balls_apart(a, b, 0) ? PairAnswer::no : answer;
}

bool closed_form_closest(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result) {
    return with_kinds(a, b, false, [&](auto kind_a, auto kind_b) {
        return closest_of<typename decltype(kind_a)::type, typename decltype(kind_b)::type>(a, b, cache, result);
    });
}

bool closed_form_contact(const ShapeRef<3>& a, const ShapeRef<3>& b, double margin, Cache* cache, Contact<3>& result) {
    const PairAnswer answer = with_kinds(a, b, PairAnswer::unknown, [&](auto kind_a, auto kind_b) {
        return contact_of<typename decltype(kind_a)::type, typename decltype(kind_b)::type>(a, b, margin, cache,
                                                                                            result);
    });
    return answer != PairAnswer::unknown || bounding_balls_apart(a, b, margin);
}

}  // namespace abut::detail
