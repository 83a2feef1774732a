// Cached parts, and parts that are visited each time, give the same contacts.

#include "../../oracle/random.hpp"
#include <abut/query/detail/surface/part_cache.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// A composite whose parts store their vertices, or refer to them.
struct GroundOfParts {
    std::vector<Triangle3> triangles;
    bool refers = false;
};

Aabb3 bounds(const GroundOfParts& ground) {
    Aabb3 result = Aabb3::empty();
    for (const Triangle3& triangle : ground.triangles) result = merged(result, bounds(convex(triangle)));
    return result;
}

template <class Visit>
void each_part(const GroundOfParts& ground, const Aabb3& box, Visit&& visit) {
    for (std::uint32_t i = 0; i < ground.triangles.size(); ++i) {
        const Triangle3& triangle = ground.triangles[i];
        Convex<3> part = convex(triangle);
        const Vec3 corners[] = {triangle.a, triangle.b, triangle.c};
        if (!overlaps(bounds(part), box)) continue;
        if (ground.refers) {
            part.points = corners;
            part.own = {};
        }
        if (!visit(part, i)) return;
    }
}

GroundOfParts random_ground(Random& random) {
    constexpr int columns = 12;
    Vec3 points[columns + 1][columns + 1];
    const float rough = random.chance(0.3) ? 0 : random.uniform_float(0, 0.6);
    for (int i = 0; i <= columns; ++i)
        for (int j = 0; j <= columns; ++j)
            points[i][j] = {static_cast<float>(i) - 6, rough * random.uniform_float(-1, 1), static_cast<float>(j) - 6};
    GroundOfParts result;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < columns; ++j) {
            result.triangles.push_back({points[i][j], points[i][j + 1], points[i + 1][j]});
            result.triangles.push_back({points[i + 1][j + 1], points[i + 1][j], points[i][j + 1]});
        }
    return result;
}

void expect_same(const std::vector<Contact<3>>& a, const std::vector<Contact<3>>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].normal, b[i].normal);
        EXPECT_EQ(a[i].depth, b[i].depth);
        EXPECT_EQ(a[i].feature_a, b[i].feature_a);
        EXPECT_EQ(a[i].feature_b, b[i].feature_b);
        ASSERT_EQ(a[i].points.size(), b[i].points.size());
        for (std::size_t j = 0; j < a[i].points.size(); ++j) {
            EXPECT_EQ(a[i].points[j].position, b[i].points[j].position);
            EXPECT_EQ(a[i].points[j].depth, b[i].points[j].depth);
        }
    }
}

template <class Shape>
std::vector<Contact<3>> contacts(const Shape& shape, const GroundOfParts& ground, float margin, bool turned_round) {
    std::vector<Contact<3>> result;
    const auto take = [&](const Contact<3>& contact) { result.push_back(contact); };
    if (turned_round)
        each_contact(ground, shape, take, {.margin = margin});
    else
        each_contact(shape, ground, take, {.margin = margin});
    return result;
}

TEST(PartCache, GivesTheContactsOfUncachedParts) {
    int cached = 0, too_many = 0, compared = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        GroundOfParts ground = random_ground(random);
        const float size = random.chance(0.25) ? 4 : random.uniform_float(0.3, 1.5);
        const float margin = random.chance(0.5) ? 0 : 0.1f * size;
        const Vec3 center = {random.uniform_float(-4, 4), size * random.uniform_float(-0.3, 1.2),
                             random.uniform_float(-4, 4)};
        const bool turned_round = random.chance(0.5);
        const auto compare = [&](const auto& shape) {
            ground.refers = false;
            const std::vector<Contact<3>> by_cache = contacts(shape, ground, margin, turned_round);
            ground.refers = true;
            expect_same(by_cache, contacts(shape, ground, margin, turned_round));
            compared += static_cast<int>(by_cache.size());
            ground.refers = false;
            PartCache<3> parts;
            (parts.fill(view(ground), bounds(convex(shape))) ? cached : too_many) += 1;
        };
        switch (random.below(3)) {
            case 0:
                compare(Ball<3>{center, size});
                break;
            case 1:
                compare(Box3{center, Vec3(size, 0.7f * size, 0.5f * size), random.rotation<3>()});
                break;
            default:
                compare(Capsule3{center, center + to_float(random.in_cube<3>()) * size, 0.5f * size});
        }
    }
    EXPECT_GT(cached, 150);
    EXPECT_GT(too_many, 20);
    EXPECT_GT(compared, 600);
}

TEST(PartCache, VisitsClosestPointsWithinItsBoxAlone) {
    Random random(1);
    const GroundOfParts ground = random_ground(random);
    const Composite<3> shape = view(ground);
    PartCache<3> parts;
    ASSERT_TRUE(parts.fill(shape, {Vec3(-1.2f), Vec3(1.2f)}));
    int compared = 0, beyond = 0;
    for (int i = 0; i < 2000; ++i) {
        const DVec<3> point = random.in_cube<3>() * 1.5;
        const double within = random.uniform(0, 1);
        std::vector<double> by_cache, by_shape;
        if (!parts.each_closest_point(point, within, [&](const ClosestPoint<3>& found) {
                by_cache.push_back(found.distance);
                return within;
            })) {
            ++beyond;
            EXPECT_TRUE(by_cache.empty());
            continue;
        }
        each_closest_point_on<3>(View<3>(shape), point, within, [&](const ClosestPoint<3>& found) {
            by_shape.push_back(found.distance);
            return within;
        });
        EXPECT_EQ(by_cache, by_shape);
        compared += static_cast<int>(by_cache.size());
    }
    EXPECT_GT(beyond, 100);
    EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace abut
