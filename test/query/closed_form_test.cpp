// Closed forms against the iterative searches that they replace, and known answers.

#include "../oracle/pair.hpp"
#include <abut/convex/manifold/round_manifold.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>

#include <memory>
#include <optional>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

std::optional<SignedDistance<3>> form_of(const Convex<3>& a, const Convex<3>& b) {
    SignedDistance<3> result;
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const PairAnswer answer = closed_form_distance(a, b, unlimited, nullptr, result);
    return answer == PairAnswer::yes ? std::optional(result) : std::nullopt;
}

TEST(ClosedForm, OfABallDeepInABoxIsExact) {
    const Box3 box{{0, 0, 0}, {1, 2, 3}};
    const auto found = form_of(view(box), view(Sphere{{0.25f, -0.5f, 0.125f}, 0.5f}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance, -1.25);
    EXPECT_EQ(found->normal, DVec<3>(1, 0, 0));
    EXPECT_EQ(found->on_a, DVec<3>(1, -0.5, 0.125));
    EXPECT_EQ(found->on_b(), DVec<3>(-0.25, -0.5, 0.125));
}

TEST(ClosedForm, OfCapsulesIsThatOfTheirSegments) {
    const Capsule3 a{{-2, 0, 0}, {2, 0, 0}, 0.5f}, b{{1, 3, -2}, {1, 3, 2}, 1};
    const auto found = form_of(view(a), view(b));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance, 1.5);
    EXPECT_EQ(found->on_a, DVec<3>(1, 0.5, 0));
    EXPECT_EQ(found->on_b(), DVec<3>(1, 2, 0));
}

TEST(ClosedFormOracle, AgreesWithTheSearches) {
    constexpr int D = 3;
    using oracle::Kind;
    constexpr Kind round[] = {Kind::ball, Kind::capsule, Kind::segment};
    constexpr Kind any[] = {Kind::ball, Kind::capsule, Kind::segment, Kind::triangle, Kind::box, Kind::polytope};
    int pairs = 0, answered = 0, overlapping = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(10000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        Kind kind_a = round[random.below(3)], kind_b = any[random.below(6)];
        if (random.chance(0.5)) std::swap(kind_a, kind_b);
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const Convex<D>&a = convex_of(pair.a), &b = convex_of(pair.b);
        ++pairs;
        const auto form = form_of(a, b);
        if (!form) continue;
        ++answered;
        const SignedDistance<D> searched = signed_distance(a, b);
        overlapping += searched.distance <= 0 ? 1 : 0;
        const double margin = oracle::tolerance_for(pair.a.solid, pair.b.solid);
        EXPECT_NEAR(form->distance, searched.distance, 0.1 * margin);
        EXPECT_NEAR(length(form->normal), 1, 1e-12);
        EXPECT_NEAR(oracle::gap_along(pair.a.solid, pair.b.solid, form->normal) - a.radius - b.radius, form->distance,
                    0.1 * margin);
    }
    EXPECT_GT(answered, pairs / 3);
    EXPECT_GT(overlapping, answered * 3 / 10);
    EXPECT_LT(overlapping, answered * 7 / 10);
}

TEST(ClosedForm, OfCapsulesThatCrossIsTheSumOfTheirRadii) {
    const Capsule3 a{{-2, 0, 0}, {2, 0, 0}, 0.5f}, b{{1, 0, -1}, {1, 0, 2}, 1};
    const auto found = form_of(view(a), view(b));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance, -1.5);
    EXPECT_EQ(std::abs(found->normal.y), 1);
    EXPECT_EQ(found->on_a, DVec<3>(1, 0.5 * found->normal.y, 0));
}

TEST(ClosedForm, OfACapsuleInABoxIsTheNearestWayOut) {
    const Box3 box{{0, 0, 0}, {2, 1, 3}};
    // Both ends are in the box; the separating direction is up.
    const auto side = form_of(view(box), view(Capsule3{{-1, 0.5f, 0}, {1, 0.75f, 0}, 0.25f}));
    ASSERT_TRUE(side);
    EXPECT_EQ(side->distance, -0.75);
    EXPECT_EQ(side->normal, DVec<3>(0, 1, 0));
    EXPECT_EQ(side->on_a, DVec<3>(-1, 1, 0));
    EXPECT_EQ(side->on_b(), DVec<3>(-1, 0.25, 0));
    // The segment cuts the edge at x = 2, y = 1; both ends are outside.
    const auto edge = form_of(view(box), view(Capsule3{{1.5f, 1.25f, 0.5f}, {2.25f, 0.5f, 0.5f}, 0}));
    ASSERT_TRUE(edge);
    EXPECT_NEAR(edge->distance, -0.25 * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(edge->normal.x, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(length(edge->on_a - DVec<3>(2, 1, 0.5)), 0, 1e-12);
}

TEST(ClosedForm, OfACapsuleThroughATriangleIsTheNearestWayOut) {
    const Triangle3 triangle{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}};
    const auto face = form_of(view(triangle), view(Capsule3{{1, -0.25f, 1}, {1, 3, 1}, 0.5f}));
    ASSERT_TRUE(face);
    EXPECT_EQ(face->distance, -0.75);
    EXPECT_EQ(face->normal, DVec<3>(0, 1, 0));
    const auto edge = form_of(view(triangle), view(Capsule3{{0.25f, -2, 1}, {0.25f, 3, 1}, 0.5f}));
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->distance, -0.75);
    EXPECT_EQ(edge->normal, DVec<3>(-1, 0, 0));
    EXPECT_EQ(edge->on_a, DVec<3>(0, 0, 1));
}

/// Whether each point of one contact is near an equally deep point of the other. Points at the limit of the clipping
/// tolerance are ignored.
bool are_among(const Manifold<3>& some, const Manifold<3>& others, double reach, double near) {
    const auto is_there = [&](const ManifoldPoint<3>& point) {
        return std::any_of(others.points.begin(), others.points.begin() + others.count, [&](const auto& other) {
            return length(other.position - point.position) <= near && std::abs(other.depth - point.depth) <= near;
        });
    };
    return std::all_of(some.points.begin(), some.points.begin() + some.count,
                       [&](const auto& point) { return point.depth <= near - reach || is_there(point); });
}

/// Pairs of a point or segment with any shape.
struct RoundPair {
    Convex<3> a, b;
    std::shared_ptr<const Polyhedron> keeper;
};

/// Tests pairs of all scales, at random rotations, near the origin and far from it. B overlaps A by a random depth.
/// Half of the pairs are degenerate: parallel, crossing, flat or without length.
RoundPair round_pair(oracle::Random& random) {
    const double scale = random.power_of_two(-10, 13);
    const Vec3 center = to_float<3>(random.in_cube<3>() * (random.chance(0.5) ? scale : 1000 * scale));
    const bool special = random.chance(0.5);
    const Pose3 pose{center, random.rotation<3>()};
    const auto number = [&] {
        return static_cast<float>(special ? scale * 0.25 * (static_cast<double>(random.below(9)) - 4)
                                          : scale * random.uniform(-1, 1));
    };
    const auto point = [&] { return Vec3{number(), number(), number()}; };
    const auto radius = [&] { return special && random.chance(0.3) ? 0 : std::abs(number()); };
    const bool turned = random.chance(0.7);
    const auto put = [&](const Vec3& p) { return turned ? pose * p : p; };
    const auto round = [&](const Vec3& shift) {
        const Vec3 a = point() + shift, b = random.chance(0.2) ? a : point() + shift;
        return random.chance(0.2) ? view(Sphere{put(a), radius()}) : view(Capsule3{put(a), put(b), radius()});
    };
    RoundPair result{round(Vec3(0)), {}, {}};
    const double apart = scale * (special ? static_cast<double>(random.below(3)) : random.uniform(0, 2.5));
    const Vec3 shift =
        to_float<3>((special ? axis<3>(static_cast<int>(random.below(3))) : random.direction<3>()) * apart);
    switch (random.below(5)) {
        case 0:
            result.b = view(Triangle3{put(point() + shift), put(point() + shift), put(point() + shift)});
            break;
        case 1:
            result.b = round(shift);
            break;
        case 2: {
            std::vector<Vec3> points;
            for (std::uint32_t i = 1 + random.below(20); i > 0; --i) points.push_back(point());
            result.keeper = std::make_shared<const Polyhedron>(*Polyhedron::build(points));
            result.b =
                view(at(*result.keeper, turned ? Pose3{put(shift), pose.rotation} : Pose3{shift, no_rotation<3>}));
            break;
        }
        default:
            result.b = view(Box3{put(shift), {radius(), radius(), radius()}, turned ? pose.rotation : no_rotation<3>});
            if (!special) result.b.place = affine(Pose3{put(shift), random.rotation<3>()});
    }
    if (random.chance(0.3)) result.b.radius += static_cast<double>(radius());
    if (random.chance(0.5)) std::swap(result.a, result.b);
    return result;
}

TEST(RoundPairs, AreAsTheSearchesSay) {
    int pairs = 0, left_to_searches = 0, overlapping = 0, several = 0, differing = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(40000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto [a, b, keeper] = round_pair(random);
        ++pairs;
        const auto form = form_of(a, b);
        const Closest<3> answer = closest(a, b);
        const auto certificate = certify<3>(a, b, answer);
        EXPECT_TRUE(certificate) << answer.distance << " margin " << certificate.margin << " plane "
                                 << certificate.plane << " off " << certificate.off_a << " and " << certificate.off_b
                                 << " across " << certificate.across << " common " << certificate.off_common;
        const SignedDistance<3> searched = signed_distance(a, b);
        const double margin = certificate.margin;
        left_to_searches += !form && !keeper ? 1 : 0;
        overlapping += searched.distance <= 0 ? 1 : 0;
        if (form) {
            EXPECT_NEAR(length(form->normal), 1, 1e-11);
            EXPECT_NEAR(form->distance, searched.distance, 0.1 * margin);
        }
        Manifold<3> direct;
        for (const double reach : {0.0, 0.1 * std::min(size(a), size(b))}) {
            const SignedDistance<3>& distance = form ? *form : searched;
            if (distance.distance > reach || !round_manifold(a, b, distance, reach, direct)) continue;
            const Manifold<3> clipped = manifold(a, b, distance, reach);
            const double near = 2 * margin;
            differing += are_among(direct, clipped, reach, near) && are_among(clipped, direct, reach, near) ? 0 : 1;
            several += direct.count > 1 ? 1 : 0;
        }
    }
    EXPECT_LT(left_to_searches, pairs / 500);
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
    EXPECT_GT(several, pairs / 50);
    // If two faces have the same angle to the normal, either is a valid reference face.
    EXPECT_LE(differing, pairs / 100000);
}

}  // namespace
}  // namespace abut
