// The direct methods for pairs in 2D against the general GJK and EPA.

#include "../oracle/pair.hpp"
#include <abut/convex/manifold/clip.hpp>
#include <abut/convex/pairs/pair2.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/overlaps.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Kind;
using oracle::Random;

/// Counts, so that no sample is vacuous.
struct PairCounts {
    int pairs = 0, answered = 0, overlapping = 0;
};

Closest<2> as_closest(const SignedDistance<2>& distance) {
    Closest<2> result;
    result.distance = static_cast<float>(distance.distance);
    result.normal = to_float(distance.normal);
    result.on_a = to_float(distance.on_a);
    result.on_b = to_float(distance.on_b());
    return result;
}

/// The answers of the direct method, if it knows the shapes.
class Direct {
public:
    Direct(const Convex<2>& a, const Convex<2>& b) : a_(a), b_(b) {}

    PairAnswer distance(Cache* cache, SignedDistance<2>& result) const {
        return with_polygons([&](PlacedPolygon& a, PlacedPolygon& b) {
            ClosestFeatures2 closest;
            const PairAnswer answer = pair2_closest(a, b, cache, closest);
            if (answer == PairAnswer::yes) write(closest, a, b, result);
            return answer;
        });
    }
    PairAnswer overlap(Cache* cache) const {
        return with_polygons([&](PlacedPolygon& a, PlacedPolygon& b) { return pair2_within(a, b, 0, cache); });
    }
    PairAnswer contact(SignedDistance<2>& distance, Manifold<2>& manifold) const {
        return with_polygons([&](PlacedPolygon& a, PlacedPolygon& b) {
            ClosestFeatures2 closest;
            ContactLanes points;
            const PairAnswer answer = pair2_contact(a, b, 0, 0, nullptr, closest, points);
            if (answer != PairAnswer::yes) return answer;
            write(closest, a, b, distance);
            write(points, manifold);
            return answer;
        });
    }

private:
    template <class Query>
    PairAnswer with_polygons(const Query& query) const {
        PlacedPolygon a, b;
        return set_placed_polygon(a_, a) && set_placed_polygon(b_, b) ? query(a, b) : PairAnswer::unknown;
    }

    const Convex<2>&a_, &b_;
};

/// Expects the answers of the general searches, certified, and again with a cache.
void expect_agreement(const Convex<2>& a, const Convex<2>& b, double tolerance, PairCounts& tally) {
    ++tally.pairs;
    const Direct method(a, b);
    SignedDistance<2> direct;
    if (method.distance(nullptr, direct) == PairAnswer::unknown) return;
    ++tally.answered;
    const SignedDistance<2> searched = signed_distance(a, b);
    tally.overlapping += searched.distance <= 0 ? 1 : 0;
    EXPECT_NEAR(direct.distance, searched.distance, 0.1 * tolerance);
    EXPECT_NEAR(length(direct.normal), 1, 1e-12);
    EXPECT_TRUE(certify(View<2>(a), View<2>(b), as_closest(direct)));

    const PairAnswer near = method.overlap(nullptr);
    const bool certain = std::abs(searched.distance) > tolerance;
    if (certain) {
        EXPECT_EQ(near, searched.distance <= 0 ? PairAnswer::yes : PairAnswer::no);
    }
    Cache cache;
    for (int time = 0; time < 3; ++time) {
        SignedDistance<2> again;
        ASSERT_NE(method.distance(&cache, again), PairAnswer::unknown);
        EXPECT_NEAR(again.distance, direct.distance, 1e-3 * tolerance);
        if (certain) {
            EXPECT_EQ(method.overlap(&cache), near);
        }
    }
}

/// Expects equal depths, and each point midway between surfaces that are as deep as it reports.
void expect_same_contact(const Convex<2>& a, const Convex<2>& b, double tolerance) {
    // The two find different edges of a box without thickness to face the other shape.
    const auto is_flat = [](const Convex<2>& c) { return c.core == Core::box && (c.own[0].x == 0 || c.own[0].y == 0); };
    if (is_flat(a) || is_flat(b)) return;
    SignedDistance<2> distance;
    Manifold<2> direct;
    if (Direct(a, b).contact(distance, direct) != PairAnswer::yes) return;
    const Manifold<2> expected = manifold(a, b, distance, 0);
    double deepest = 0;
    for (std::size_t i = 0; i < direct.count; ++i) deepest = std::max(deepest, direct.points[i].depth);
    EXPECT_NEAR(deepest, -distance.distance, 0.1 * tolerance);
    // An edge whose end just touches the other shape has one point, or two at one place.
    const auto has = [&](const Manifold<2>& all, const ManifoldPoint<2>& point) {
        for (std::size_t i = 0; i < all.count; ++i)
            if (length(all.points[i].position - point.position) <= tolerance &&
                std::abs(all.points[i].depth - point.depth) <= tolerance)
                return true;
        return false;
    };
    for (std::size_t i = 0; i < direct.count; ++i) EXPECT_TRUE(has(expected, direct.points[i]));
    for (std::size_t i = 0; i < expected.count; ++i) EXPECT_TRUE(has(direct, expected.points[i]));
}

const Convex<2>& convex_of(const oracle::Sample<2>& sample) {
    return std::get<Convex<2>>(sample.view);
}

TEST(PlanePairs, AgreeWithTheSearches) {
    constexpr Kind kinds[] = {Kind::ball, Kind::capsule, Kind::segment, Kind::triangle,
                              Kind::box,  Kind::aabb,    Kind::polytope};
    PairCounts tally;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(10000)); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Kind kind_a = kinds[random.below(7)], kind_b = kinds[random.below(7)];
        const auto pair = oracle::random_pair<2>(random, kind_a, kind_b);
        const double tolerance = oracle::tolerance_for(pair.a.solid, pair.b.solid);
        expect_agreement(convex_of(pair.a), convex_of(pair.b), tolerance, tally);
        expect_same_contact(convex_of(pair.a), convex_of(pair.b), tolerance);
    }
    EXPECT_GT(tally.answered, tally.pairs * 8 / 10);
    EXPECT_GT(tally.overlapping, tally.answered * 3 / 10);
    EXPECT_LT(tally.overlapping, tally.answered * 7 / 10);
}

/// Corners on a coarse grid: collinear edges, touching corners, nested shapes, boxes without width.
TEST(PlanePairs, AgreeOnAGrid) {
    PairCounts tally;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(10000)); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const float unit = static_cast<float>(random.power_of_two(-10, 13));
        const auto on_grid = [&](std::uint32_t reach) {
            return unit * (static_cast<float>(random.below(2 * reach + 1)) - static_cast<float>(reach));
        };
        const auto point = [&] { return Vec2(on_grid(3), on_grid(3)); };
        const auto shape = [&](Polygon& polygon) -> Convex<2> {
            const Pose2 pose{
                point(), random.chance(0.5) ? Turn{} : Turn::by(static_cast<float>(random.below(8)) * 0.785398163f)};
            std::vector<Vec2> points(3 + random.below(6));
            for (Vec2& corner : points) corner = point();
            polygon = *Polygon::build(points);
            switch (random.below(6)) {
                case 0:
                    return view(at(Circle{point(), std::abs(on_grid(2))}, pose));
                case 1:
                    return view(at(Capsule2{point(), point(), std::abs(on_grid(1))}, pose));
                case 2:
                    return view(at(Box2{point(), {std::abs(on_grid(3)), std::abs(on_grid(3))}}, pose));
                case 3:
                    return view(at(Triangle2{point(), point(), point()}, pose));
                case 4:
                    return view(rounded(at(polygon, pose), unit / 2));
                default:
                    return view(at(polygon, pose));
            }
        };
        Polygon polygon_a, polygon_b;
        const Convex<2> a = shape(polygon_a), b = shape(polygon_b);
        const double tolerance = 1e-5 * std::min(size(a), size(b)) + 1e-5 * static_cast<double>(unit);
        expect_agreement(a, b, tolerance, tally);
    }
    EXPECT_GT(tally.answered, tally.pairs * 6 / 10);
    EXPECT_GT(tally.overlapping, tally.answered * 3 / 10);
    EXPECT_LT(tally.overlapping, tally.answered * 7 / 10);
}

TEST(PlanePairs, OfAPointBesideSidesOnOneLine) {
    // The second and third corner are collinear with their neighbours, up to the smallest float.
    const Polygon polygon = *Polygon::build({{-64, -64}, {-32, -64}, {2.80259693e-45f, -32}, {64, 32}, {0, 64}});
    EXPECT_NEAR(closest(polygon, Vec2(40, -8)).distance, std::sqrt(128.0f), 1e-5f);
    EXPECT_NEAR(closest(polygon, Vec2(-8, -56)).distance, std::sqrt(128.0f), 1e-5f);
}

TEST(PlanePairs, NameTheSameCornersAsTheSearches) {
    const Box2 box{{0, 0}, {1, 1}};
    const Box2 other{{0.25f, 1.75f}, {1, 1}};
    const Contact<2> direct = contact(box, other);
    const Manifold<2> expected = manifold(view(box), view(other), signed_distance<2>(view(box), view(other)), 0);
    ASSERT_EQ(direct.points.size(), 2u);
    ASSERT_EQ(expected.count, 2u);
    for (const ContactPoint<2>& point : direct.points) {
        const bool first = length(DVec<2>(point.position) - expected.points[0].position) < 1e-6;
        EXPECT_EQ(point.feature, expected.points[first ? 0 : 1].feature);
    }
    EXPECT_EQ(direct.depth, 0.25f);
    EXPECT_EQ(direct.normal, Vec2(0, 1));
}

TEST(PlanePairs, MoveWithTheirCacheFromOverlappingToApart) {
    const Polygon a = *Polygon::build({{-1, -1}, {1, -1}, {1.5f, 0}, {1, 1}, {-1, 1}});
    Cache cache;
    for (int step = 0; step < 400; ++step) {
        const float along = static_cast<float>(step) * 0.01f;
        const auto b = at(a, Pose2{{along, 0.5f * along}, Turn::by(3 * along)});
        const Closest<2> cold = closest(a, b), warm = closest(a, b, {.cache = &cache});
        EXPECT_NEAR(warm.distance, cold.distance, 1e-6f);
        EXPECT_TRUE(certify(a, b, warm));
        EXPECT_EQ(overlaps(a, b, {.cache = &cache}), cold.distance <= 0);
    }
}

/// Of a triangle around a point, the first edge was named (4, 5): its padding won the tie of the two.
TEST(PlanePairs, NameTheNearestEdgeOfAPolygonAroundACircle) {
    for (std::size_t count = 3; count <= max_soa_edges; ++count) {
        std::vector<Vec2> corners;
        for (std::size_t i = 0; i < count; ++i) {
            const Turn turn = Turn::by(6.2831853f * static_cast<float>(i) / static_cast<float>(count));
            corners.emplace_back(turn.cos, turn.sin);
        }
        const Polygon polygon = *Polygon::build(corners);
        ASSERT_EQ(polygon.points().size(), count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t next = i + 1 == count ? 0 : i + 1;
            const Circle circle{0.45f * (polygon.points()[i] + polygon.points()[next]), 0.01f};
            const Feature edge{0, edge_index(i, next), FeatureKind::edge};
            EXPECT_EQ(closest(polygon, circle).feature_a, edge) << count;
            EXPECT_EQ(closest(circle, at(polygon, Pose2{})).feature_b, edge) << count;
            EXPECT_EQ(contact(polygon, circle).feature_a, edge) << count;
        }
    }
}

TEST(PlaneIntersection, IsThatOfTheGeneralCut) {
    int overlapping = 0, pairs = 0;
    Polygon direct;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(5000)); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Kind kinds[] = {Kind::box, Kind::polytope, Kind::triangle};
        const auto pair = oracle::random_pair<2>(random, kinds[random.below(3)], kinds[random.below(3)]);
        const Convex<2>&a = convex_of(pair.a), &b = convex_of(pair.b);
        if (a.radius > 0 || b.radius > 0) continue;
        ++pairs;
        std::vector<Vec2> corners;
        for (const DVec<2>& corner : clip(a, b)) corners.push_back(to_float(corner));
        const bool overlap = intersection(a, b, direct);
        const double tolerance = oracle::tolerance_for(pair.a.solid, pair.b.solid);
        if (overlap == corners.empty()) {
            EXPECT_LE(std::abs(signed_distance(a, b).distance), tolerance);
            continue;
        }
        overlapping += overlap ? 1 : 0;
        if (!overlap) continue;
        const Polygon expected = *Polygon::build(corners);
        const double extent = 2 * std::min(size(a), size(b));
        EXPECT_NEAR(direct.area(), expected.area(), 4 * tolerance * extent);
        for (const Vec2& corner : direct.points()) EXPECT_LE(closest(expected, corner).distance, tolerance);
        for (const Vec2& corner : expected.points()) EXPECT_LE(closest(direct, corner).distance, tolerance);
    }
    EXPECT_GT(overlapping, pairs * 3 / 10);
}

TEST(PlaneIntersection, BeginsAtTheLeastCornerAndGivesWhatLiesInsideBack) {
    const Polygon small = *Polygon::build({{0.1f, 0.2f}, {0.7f, -0.3f}, {1.3f, 0.9f}, {0.3f, 1.1f}});
    Polygon out;
    ASSERT_TRUE(intersection(Box2{{0, 0}, {4, 4}}, small, out));
    EXPECT_TRUE(std::ranges::equal(out.points(), small.points()));
    ASSERT_TRUE(intersection(Box2{{0, 0}, {1, 1}}, Box2{{1, 1}, {1, 1}}, out));
    EXPECT_TRUE(std::ranges::equal(out.points(), std::array{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}));
    ASSERT_TRUE(intersection(Box2{{0, 0}, {1, 1}}, Box2{{2, 0.5f}, {1, 1}}, out));
    EXPECT_EQ(out.rank(), 1);
    EXPECT_FALSE(intersection(Box2{{0, 0}, {1, 1}}, Box2{{2.5f, 0.5f}, {1, 1}}, out));
}

}  // namespace
}  // namespace abut
