// Box against box, flat ones among them: the separating axis test against the general GJK and EPA.

#include "../oracle/pair.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/convex/pairs/box3.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/detail/pair_dispatch.hpp>
#include <abut/query/overlaps.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// The relative position of two boxes.
enum class BoxFamily { any, aligned, flush, turned_about_a_normal, edge_on_edge, nested, stretched_out, flat };
constexpr int box_family_count = 8;

struct Boxes {
    Box3 a, b;
    double size;  ///< of the smaller
};

Vec3 random_half(Random& random, double size, bool long_ones) {
    Vec3 half;
    for (int i = 0; i < 3; ++i)
        half[i] = static_cast<float>(size * (long_ones ? random.power_of_two(-9, 1) : random.uniform(0.25, 1)));
    return half;
}

glm::quat quarter_turns(Random& random) {
    const float s = std::sqrt(0.5f);
    const glm::quat turns[] = {{1, 0, 0, 0}, {s, s, 0, 0}, {s, 0, s, 0}, {s, 0, 0, s}, {0, 1, 0, 0}};
    return turns[random.below(5)];
}

double size_of(const Box3& box) {
    return length(DVec<3>(box.half));
}

/// B moved along the separating direction to a chosen gap; about half of all pairs overlap.
void put_apart(Boxes& boxes, Random& random) {
    const SignedDistance<3> now = signed_distance<3>(view(boxes.a), view(boxes.b));
    const double scale = random.chance(0.5) ? 1 : random.power_of_two(-20, -2);
    const double wanted = boxes.size * scale * random.uniform(-0.6, 0.5);
    boxes.b.center += to_float(now.normal * (wanted - now.distance));
}

Boxes random_boxes(Random& random, BoxFamily family) {
    const double size_a = random.power_of_two(-10, 13);
    const double size_b = random.chance(0.8) ? size_a * random.power_of_two(-1, 1) : random.power_of_two(-10, 13);
    const bool long_ones = family == BoxFamily::stretched_out;
    Boxes boxes;
    boxes.a.half = random_half(random, size_a, long_ones);
    boxes.b.half = random_half(random, size_b, long_ones);
    boxes.size = std::min(size_of(boxes.a), size_of(boxes.b));
    boxes.a.center = to_float(random.direction<3>() * (random.chance(0.5) ? 0 : size_a * random.power_of_two(0, 13)));
    boxes.a.rotation = random.rotation<3>();
    boxes.b.rotation = random.rotation<3>();
    boxes.b.center = boxes.a.center + to_float(random.direction<3>() * (1.5 * (size_a + size_b)));
    switch (family) {
        case BoxFamily::any:
        case BoxFamily::stretched_out:
            put_apart(boxes, random);
            break;
        case BoxFamily::flat:
            for (Box3* box : {&boxes.a, &boxes.b})
                if (random.chance(0.7)) box->half[static_cast<int>(random.below(3))] *= random.chance(0.5) ? 0 : 1e-5f;
            put_apart(boxes, random);
            break;
        case BoxFamily::aligned:
            if (random.chance(0.5)) boxes.a.rotation = no_rotation<3>;
            boxes.b.rotation = boxes.a.rotation * quarter_turns(random);
            put_apart(boxes, random);
            break;
        case BoxFamily::flush: {
            // Coplanar faces that touch exactly.
            boxes.a.rotation = boxes.b.rotation = no_rotation<3>;
            boxes.a.center = Vec3(0);
            for (int i = 0; i < 3; ++i) {
                const float sign = static_cast<float>(static_cast<int>(random.below(3)) - 1);
                const float to = boxes.a.half[i] + (random.chance(0.5) ? boxes.b.half[i] : -boxes.b.half[i]);
                boxes.b.center[i] = sign * to;
            }
            break;
        }
        case BoxFamily::turned_about_a_normal: {
            const int up = static_cast<int>(random.below(3));
            Vec3 normal(0), offset(0);
            normal[up] = 1;
            for (int i = 0; i < 3; ++i) offset[i] = boxes.a.half[i] * random.uniform_float(-1, 1);
            offset[up] = boxes.a.half[up] +
                         boxes.b.half[up] * (1 + random.uniform_float(-0.1, 0.05) * (random.chance(0.5) ? 1 : 0));
            const Pose3 pose =
                Pose3{boxes.a.center, boxes.a.rotation} * Pose3{offset, turn_about(normal, random.uniform_float(0, 6))};
            boxes.b.center = pose.position;
            boxes.b.rotation = pose.rotation;
            break;
        }
        case BoxFamily::edge_on_edge: {
            const float eighth = 0.78539816f;
            boxes.a.rotation = turn_about({1, 0, 0}, eighth);
            boxes.b.rotation = turn_about({0, 0, 1}, random.uniform_float(0, 3)) * turn_about({1, 0, 0}, eighth);
            boxes.b.center = boxes.a.center + Vec3(0, 0, 1.5f * static_cast<float>(size_a + size_b));
            put_apart(boxes, random);
            break;
        }
        case BoxFamily::nested:
            boxes.b.center = boxes.a.center + to_float(random.in_cube<3>() * (0.3 * size_a));
            break;
    }
    return boxes;
}

/// Calls visit(boxes, random) for boxes of all families; 30 to 70 of a hundred overlap.
template <class Visit>
void each_pair(Visit&& visit) {
    int pairs = 0, overlapping = 0;
    for (int i = 0; i < oracle::case_count(3000); ++i)
        for (int family = 0; family < box_family_count; ++family) {
            const auto seed = static_cast<std::uint64_t>(pairs++);
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", family " << family);
            Random random(seed);
            const Boxes boxes = random_boxes(random, static_cast<BoxFamily>(family));
            overlapping += signed_distance<3>(view(boxes.a), view(boxes.b)).distance <= 0 ? 1 : 0;
            visit(boxes, random);
            if (testing::Test::HasFailure()) return;
        }
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

/// The error of GJK and EPA.
double search_tolerance(const Boxes& boxes) {
    return 1e-7 * (size_of(boxes.a) + size_of(boxes.b));
}

TEST(Boxes, AreAsFarApartAsTheSearchesSay) {
    each_pair([&](const Boxes& boxes, Random&) {
        const Convex<3> a = view(boxes.a), b = view(boxes.b);
        const SignedDistance<3> found = part_distance<3>(a, b, {}), searched = signed_distance(a, b);
        EXPECT_NEAR(found.distance, searched.distance, search_tolerance(boxes) + 1e-9 * std::abs(searched.distance));
        EXPECT_NEAR(length(found.normal), 1, 1e-14);
        EXPECT_EQ(part_overlaps<3>(a, b, {}), found.distance <= 0);
        const auto answer = closest(boxes.a, boxes.b);
        EXPECT_EQ(answer.distance, static_cast<float>(found.distance));
        EXPECT_TRUE(certify(boxes.a, boxes.b, answer));
    });
}

/// The largest distance of the points of one contact from the nearest point of the other.
double farthest_from(const Manifold<3>& points, const Manifold<3>& others) {
    double farthest = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < others.count; ++j)
            nearest = std::min(nearest, length(points.points[i].position - others.points[j].position));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

double area_of(const Manifold<3>& points, const DVec<3>& normal) {
    double most = 0;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        double area = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto at = [&](std::size_t k) {
                return points.points[std::min(order[k % 4], points.count - 1)].position;
            };
            area += dot(normal, cross(at(i) - at(0), at(i + 1) - at(0)));
        }
        most = std::max(most, std::abs(area));
    } while (std::next_permutation(order.begin() + 1, order.end()));
    return most;
}

TEST(Boxes, TouchWhereTheSearchesSay) {
    int touching = 0, several = 0, similar = 0;
    each_pair([&](const Boxes& boxes, Random& random) {
        const Convex<3> a = view(boxes.a), b = view(boxes.b);
        const double margin = random.chance(0.5) ? 0 : boxes.size * random.uniform(0, 0.5);
        PartContact<3> contact;
        const bool found = part_contact<3>(a, b, margin, margin, {}, contact);
        const SignedDistance<3>& distance = contact.distance;
        const Manifold<3>& points = contact.manifold;
        const SignedDistance<3> reference = part_distance<3>(a, b, {});
        EXPECT_EQ(found, reference.distance <= margin);
        if (!found) return;
        ++touching;
        several += points.count > 1 ? 1 : 0;
        EXPECT_EQ(distance.distance, reference.distance);
        EXPECT_EQ(distance.normal, reference.normal);
        const double allowed = 2e-6 * boxes.size;
        // One box may be ten million times as large as the other: its planes are rounded in double.
        const double of_planes = 1e-11 * std::max(size_of(boxes.a), size_of(boxes.b));
        double deepest = -std::numeric_limits<double>::infinity();
        ASSERT_GE(points.count, 1u);
        for (std::size_t i = 0; i < points.count; ++i) {
            const ManifoldPoint<3>& point = points.points[i];
            deepest = std::max(deepest, point.depth);
            EXPECT_GE(point.depth, margin > 0 ? -margin - allowed : 0);
            for (const double side : {0.5, -0.5}) {
                const DVec<3> surface = point.position + distance.normal * (side * point.depth);
                EXPECT_LE(closest(side > 0 ? boxes.a : boxes.b, to_float(surface)).distance,
                          5 * allowed + 4e-7 * largest(surface) + of_planes);
            }
            for (std::size_t j = 0; j < i; ++j) EXPECT_NE(point.feature, points.points[j].feature);
        }
        EXPECT_NEAR(deepest, -distance.distance, allowed);
        // Among points of equal depth, the reduction may choose another one, and then other neighbours.
        const Manifold<3> clipped = manifold(a, b, distance, margin);
        EXPECT_GE(area_of(points, distance.normal), 0.5 * area_of(clipped, distance.normal) - allowed * boxes.size);
        similar += farthest_from(points, clipped) <= allowed && farthest_from(clipped, points) <= allowed ? 1 : 0;
    });
    EXPECT_GT(touching, 5000);
    EXPECT_GT(several, touching / 3);
    EXPECT_GT(similar, touching * 9 / 10);
}

/// Regression: the point of contact was 5.6e-8 off the larger box, and the normal 0.013 rad off.
TEST(Boxes, OfAMillimetreTouchThoseOfHalfAKilometre) {
    const Box3 small{{0, 0, 0},
                     {0.000503779971f, 0.00048122913f, 0.000784267031f},
                     {0.297415495f, -0.136282846f, 0.582673907f, 0.743950307f}};
    const Box3 large{{108.420113f, -374.035217f, -16.4568787f},
                     {131.876694f, 268.227295f, 364.861237f},
                     {0.214475989f, -0.441059619f, 0.147537783f, 0.85889411f}};
    PartContact<3> contact;
    ASSERT_TRUE(part_contact<3>(view(small), view(large), 1e-4, 1e-4, {}, contact));
    ASSERT_EQ(contact.manifold.count, 1u);
    const ManifoldPoint<3>& point = contact.manifold.points[0];
    for (const double side : {0.5, -0.5}) {
        const DVec<3> surface = point.position + contact.distance.normal * (side * point.depth);
        EXPECT_LE(closest(side > 0 ? small : large, to_float(surface)).distance, 5e-9);
    }
}

TEST(Boxes, NeedNoCacheAndMindNone) {
    Cache strange;
    each_pair([&](const Boxes& boxes, Random& random) {
        const Box3& a = boxes.a;
        Box3 b = boxes.b;
        Cache cache = random.chance(0.5) ? Cache{} : strange;
        for (int i = 0; i < 3; ++i) {
            const auto fresh = closest(a, b), cached = closest(a, b, {.cache = &cache});
            EXPECT_NEAR(cached.distance, fresh.distance,
                        1e-6 * size_of(a) + 1e-6 * std::abs(fresh.distance) + 1e-9 * size_of(b));
            EXPECT_TRUE(certify(a, b, cached));
            if (std::abs(static_cast<double>(fresh.distance)) > 1e-6 * (size_of(a) + size_of(b))) {
                EXPECT_EQ(overlaps(a, b, {.cache = &cache}), fresh.distance <= 0);
                EXPECT_EQ(!!contact(a, b, {.cache = &cache}), fresh.distance <= 0);
            }
            b.center += to_float(random.in_cube<3>() * (0.01 * boxes.size));
        }
        strange = cache;
    });
}

/// The numbers of all contacts of some pairs, for a comparison of bits.
std::vector<double> numbers_of_contacts() {
    std::vector<double> numbers;
    for (std::uint64_t seed = 0; seed < 700; ++seed) {
        Random random(seed);
        const Boxes boxes = random_boxes(random, static_cast<BoxFamily>(seed % box_family_count));
        PartContact<3> contact;
        if (!part_contact<3>(view(boxes.a), view(boxes.b), boxes.size, boxes.size, {}, contact)) continue;
        const Manifold<3>& points = contact.manifold;
        for (std::size_t i = 0; i < points.count; ++i) {
            const ManifoldPoint<3>& point = points.points[i];
            for (int k = 0; k < 3; ++k) numbers.push_back(point.position[k]);
            numbers.push_back(point.depth);
            numbers.push_back(point.feature);
        }
    }
    return numbers;
}

using BoxesByTarget = oracle::BySimdTarget;

TEST_P(BoxesByTarget, TouchAtTheSamePoints) {
    const std::vector<double> here = numbers_of_contacts();
    TearDown();
    EXPECT_EQ(here, numbers_of_contacts());
    EXPECT_GT(here.size(), 5000u);
}
INSTANTIATE_TEST_SUITE_P(Units, BoxesByTarget, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
