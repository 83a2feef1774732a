#include <abut/convex/manifold/round_manifold.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/query/detail/closed_form/core_pairs3.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/polyhedron.hpp>

#include <bit>
#include <cstring>

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
[[gnu::always_inline]] inline void write_features(const CoresDistance& found, Answer& result) {
    const auto feature = [](const CoreFeature& part) { return &core_features[(part.free ^ 7u) + 8 * part.low]; };
    // With the padding, so that compilers drop the initial values.
    std::memcpy(&result.feature_a, feature(found.part_a), sizeof(Feature));
    std::memcpy(&result.feature_b, feature(found.part_b), sizeof(Feature));
}

// Each answer is written in the place of the caller's: a copy right after the writes would stall.

[[gnu::always_inline]] inline Closest<3> written(const CoresDistance& found) {
    Closest<3> result;
    result.distance = static_cast<float>(found.distance[0]);
    store(found.normal, result.normal);
    store(found.on_a, result.on_a);
    store(found.on_b, result.on_b);
    write_features(found, result);
    return result;
}

inline Contact<3> written(const CoresDistance& found, const SignedDistance<3>& distance, const Manifold<3>& points) {
    Contact<3> result;
    write(distance, points, result);
    write_features(found, result);
    return result;
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

/// Likewise, without a root: 2 (r^2 + s^2) is at least (r + s)^2.
[[gnu::always_inline]] inline bool bounding_balls_apart(const Box3& a, const Box3& b) {
    using namespace lanes;
    const Double3 between = loaded(b.center) - loaded(a.center), half_a = loaded(a.half), half_b = loaded(b.half);
    const double square = dot(between, between)[0], radii = (dot(half_a, half_a) + dot(half_b, half_b))[0];
    if (!(square > (2 + 1e-6) * radii)) return false;
    const glm::quat &p = a.rotation, &q = b.rotation;
    return std::isfinite(square + static_cast<double>(p.w + p.x + p.y + p.z + (q.w + q.x + q.y + q.z)));
}

// Answers by views, for pairs without a closed form, and for what one leaves open. Out of line, to keep the closed
// forms short.

[[gnu::noinline]] bool overlap_of_views(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    if (options.trace == nullptr && bounding_balls_apart(a, b, 0)) return false;
    return overlaps(convex_of(a), convex_of(b), options);
}

[[gnu::noinline]] Closest<3> closest_of_views(const ShapeRef<3>& a, const ShapeRef<3>& b,
                                              const QueryOptions<3>& options) {
    return closest(convex_of(a), convex_of(b), options);
}

[[gnu::noinline]] Contact<3> contact_of_views(const ShapeRef<3>& a, const ShapeRef<3>& b,
                                              const QueryOptions<3>& options) {
    if (options.trace == nullptr && bounding_balls_apart(a, b, static_cast<double>(options.margin)))
        return no_contact<3>();
    return contact(convex_of(a), convex_of(b), options);
}

// A function for each pair of cores, out of line, so that each keeps its numbers in registers.

template <class A, class B>
bool overlap_of_kinds(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    if (options.trace == nullptr) {
        if constexpr (std::is_same_v<A, PlacedBox> && std::is_same_v<B, PlacedBox>)
            if (options.cache == nullptr && a.pose == nullptr && b.pose == nullptr &&
                bounding_balls_apart(a.as<Box3>(), b.as<Box3>()))
                return false;
        const PairAnswer answer = a.pose == nullptr && b.pose == nullptr
                                      ? overlap_of(core_in_place<A>(a), core_in_place<B>(b), options.cache)
                                      : overlap_of(core_of<A>(a), core_of<B>(b), options.cache);
        if (answer != PairAnswer::unknown) return answer == PairAnswer::yes;
    }
    return overlap_of_views(a, b, options);
}

template <class A, class B>
[[gnu::noinline]] Closest<3> closest_in_full(const ShapeRef<3>& a, const ShapeRef<3>& b,
                                             const QueryOptions<3>& options) {
    CoresDistance found;
    if (options.trace == nullptr && distance_of(core_of<A>(a), core_of<B>(b), options.cache, found))
        return written(found);
    return closest_of_views(a, b, options);
}

template <class A, class B>
Closest<3> closest_of_kinds(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    CoresDistance found;
    if (a.pose == nullptr && b.pose == nullptr && options.trace == nullptr &&
        short_distance(core_in_place<A>(a), core_in_place<B>(b), found) && lanes::finite(found.distance))
        return written(found);
    return closest_in_full<A, B>(a, b, options);
}

template <class A, class B>
Contact<3> contact_of_cores(const A& a, const B& b, const ShapeRef<3>& given_a, const ShapeRef<3>& given_b,
                            const QueryOptions<3>& options) {
    constexpr bool boxes = std::is_same_v<A, PlacedBox> && std::is_same_v<B, PlacedBox>;
    const double margin = static_cast<double>(options.margin);
    CoresDistance found;
    Manifold<3> points;
    if constexpr (boxes) {
        const PairAnswer answer = contact_of_boxes(a, b, margin, margin, options.cache, found, points);
        if (answer == PairAnswer::no) return no_contact<3>();
        if (answer == PairAnswer::unknown) return contact_of_views(given_a, given_b, options);
    } else {
        if (are_apart(a, b, margin)) return no_contact<3>();
        if (!distance_of(a, b, options.cache, found)) return contact_of_views(given_a, given_b, options);
        if (found.distance[0] > margin) return no_contact<3>();
    }
    SignedDistance<3> distance;
    set_distance(found, distance);
    if constexpr (!boxes)
        if (!core_manifold(a, b, distance, margin, points)) return contact_of_views(given_a, given_b, options);
    return written(found, distance, points);
}

template <class A, class B>
Contact<3> contact_of_kinds(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    if (options.trace != nullptr) return contact_of_views(a, b, options);
    if (a.pose == nullptr && b.pose == nullptr)
        return contact_of_cores(core_in_place<A>(a), core_in_place<B>(b), a, b, options);
    return contact_of_cores(core_of<A>(a), core_of<B>(b), a, b, options);
}

/// A function for each pair of shapes: of(type_identity<core of A>, type_identity<core of B>), or `otherwise` for
/// shapes without cores. One jump through it costs less than comparing kinds.
template <class Function>
struct PairTable {
    static constexpr std::size_t kinds = std::bit_ceil(static_cast<std::size_t>(ShapeKind::polytope) + 1);
    Function functions[kinds][kinds];

    template <class Of>
    constexpr PairTable(Function otherwise, const Of& of) : functions{} {
        for (std::size_t i = 0; i < kinds; ++i)
            for (std::size_t j = 0; j < kinds; ++j)
                functions[i][j] = with_kinds(static_cast<ShapeKind>(i), static_cast<ShapeKind>(j), otherwise, of);
    }

    Function of(const ShapeRef<3>& a, const ShapeRef<3>& b) const {
        return functions[static_cast<std::size_t>(a.kind)][static_cast<std::size_t>(b.kind)];
    }
};

constexpr PairTable overlap_table(&overlap_of_views, [](auto a, auto b) {
    return &overlap_of_kinds<typename decltype(a)::type, typename decltype(b)::type>;
});
constexpr PairTable closest_table(&closest_of_views, [](auto a, auto b) {
    return &closest_of_kinds<typename decltype(a)::type, typename decltype(b)::type>;
});
constexpr PairTable contact_table(&contact_of_views, [](auto a, auto b) {
    return &contact_of_kinds<typename decltype(a)::type, typename decltype(b)::type>;
});

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

template <>
bool overlaps(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    return overlap_table.of(a, b)(a, b, options);
}

template <>
Closest<3> closest(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    return closest_table.of(a, b)(a, b, options);
}

template <>
Contact<3> contact(const ShapeRef<3>& a, const ShapeRef<3>& b, const QueryOptions<3>& options) {
    return contact_table.of(a, b)(a, b, options);
}

}  // namespace abut
