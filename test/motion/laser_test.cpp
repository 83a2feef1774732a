// Lasers between mirrors stay in the room for a million bounces.

#include "../broad_phase/allocations.hpp"
#include "../oracle/random.hpp"
#include <abut/motion/laser.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/segment.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

/// The shapes of the walls of a room.
enum class Walls { half_spaces, boxes, thin };

/// A convex room: the points whose height above each wall is not below zero.
template <int D>
struct Room {
    World<D> world;
    std::vector<std::pair<DVec<D>, double>> walls;  ///< normal into the room, and offset
    double size = 0;

    Vec<D> middle() const {
        DVec<D> sum(0.0);
        for (const auto& [normal, offset] : walls) sum += normal * (0.5 * offset);
        return to_float(sum);
    }
    /// The minimal height above a wall.
    double inside(const Vec<D>& point) const {
        double min_height = std::numeric_limits<double>::infinity();
        for (const auto& [normal, offset] : walls)
            min_height = std::min(min_height, dot(normal, DVec<D>(point)) - offset);
        return min_height;
    }
};

/// A box-shaped room at a random position and rotation.
template <int D>
Room<D> make_room(oracle::Random& random, Walls kind, double size, double far) {
    Room<D> room;
    room.size = size;
    const Pose<D> pose{to_float(random.direction<D>() * far), random.rotation<D>()};
    const Affine<D> place = affine(pose);
    Vec<D> half;
    for (int i = 0; i < D; ++i) half[i] = random.uniform_float(0.05 * size, size);
    for (int i = 0; i < D; ++i)
        for (const float side : {-1.0f, 1.0f}) {
            Vec<D> out(0);
            out[i] = side;
            const DVec<D> normal = place.vector(DVec<D>(out) * -1.0);
            const double offset = dot(normal, place.point(DVec<D>(out * half[i])));
            room.walls.emplace_back(normal, offset);
            if (kind == Walls::half_spaces)
                room.world.add(HalfSpace<D>{to_float(normal * -1.0) * -1.0f, static_cast<float>(offset)});
            if (kind == Walls::boxes) {
                Vec<D> wide = half * 2.0f;
                wide[i] = 0.1f * half[i];
                room.world.add(Box<D>{out * (half[i] + wide[i]), wide}, {.pose = pose});
            }
        }
    if (kind == Walls::thin) {
        if constexpr (D == 2) {
            const Vec2 corner[] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
            for (int i = 0; i < 4; ++i) room.world.add(Segment<2>{corner[i], corner[(i + 1) % 4]}, {.pose = pose});
        } else {
            std::vector<Vec3> points;
            for (int i = 0; i < 8; ++i)
                points.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                    (i & 4) != 0 ? half.z : -half.z);
            const std::vector<glm::uvec3> triangles{{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 4, 5}, {0, 5, 1},
                                                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
            room.world.add(*Mesh::build(points, triangles), {.pose = pose});
        }
    }
    return room;
}

/// A ray from the center, often straight into a corner or along a wall.
template <int D>
Ray<D> first_ray(oracle::Random& random, const Room<D>& room, const Vec<D>& middle) {
    DVec<D> direction = random.direction<D>();
    if (random.chance(0.3)) {
        direction = DVec<D>(0.0);
        for (std::size_t i = 0; i < room.walls.size(); i += 2) {
            const auto& [normal, offset] = room.walls[i];
            const double height = dot(normal, DVec<D>(middle)) - offset;
            direction += normal * (random.chance(0.5) ? height : -height);
        }
    } else if (random.chance(0.5)) {
        const DVec<D>& normal = room.walls[random.below(static_cast<std::uint32_t>(room.walls.size()))].first;
        direction -= normal * dot(normal, direction);
        direction += normal * random.power_of_two(random.chance(0.5) ? -30 : -7, -3);
    }
    return {middle, to_float(normalized(direction))};
}

template <int D>
void stays_in_the_room(Walls kind, bool with_ball, int rooms, std::uint64_t seed) {
    oracle::Random random(seed);
    constexpr int bounces = 1000;
    int hits = 0, grazing = 0, corners = 0, most_at_once = 0;
    for (int r = 0; r < rooms; ++r) {
        const double size = random.power_of_two(-10, 14), far = size * random.power_of_two(-4, 9);
        Room<D> room = make_room<D>(random, kind, size, far);
        const Vec<D> middle = room.middle();
        if (with_ball) {
            const DVec<D> aside = random.direction<D>() * (0.02 * size);
            room.world.add(Ball<D>{to_float(DVec<D>(middle) + aside), static_cast<float>(0.01 * size)});
        }
        const double margin = 1e-5 * size + 16 * 6e-8 * (far + 2 * size);
        int left = bounces, at_once = 0;
        Id last;
        const Ray<D> end =
            follow_laser(room.world, first_ray(random, room, middle), [&](const Ray<D>& ray, const WorldHit<D>& hit) {
                ++hits;
                grazing += dot(DVec<D>(ray.direction), DVec<D>(hit.hit.normal)) > -0.05 ? 1 : 0;
                const bool at_same_place = static_cast<double>(hit.hit.distance) <= margin;
                corners += at_same_place ? 1 : 0;
                at_once = at_same_place ? at_once + 1 : 0;
                most_at_once = std::max(most_at_once, at_once);
                EXPECT_FALSE(hit.id == last && !(kind == Walls::thin && D == 3))
                    << "the mirror it just left; room " << r << ", seed " << seed;
                last = hit.id;
                EXPECT_GE(room.inside(hit.hit.point), -margin) << "room " << r << ", seed " << seed;
                EXPECT_GE(room.inside(ray.origin), -margin) << "room " << r << ", seed " << seed;
                return --left > 0;
            });
        EXPECT_EQ(left, 0) << "it left the room at " << room.inside(end.origin) / size << "; room " << r << ", size "
                           << size << ", seed " << seed;
    }
    EXPECT_EQ(hits, rooms * bounces);
    EXPECT_GT(grazing, hits / 2000);
    EXPECT_GT(corners, rooms / 10);
    EXPECT_LE(most_at_once, D) << "more hits in one corner than it has walls";
}

TEST(Laser, StaysAmongHalfSpaces2) {
    stays_in_the_room<2>(Walls::half_spaces, false, 250, 71);
}
TEST(Laser, StaysAmongHalfSpaces3) {
    stays_in_the_room<3>(Walls::half_spaces, false, 250, 72);
}
TEST(Laser, StaysAmongBoxes2) {
    stays_in_the_room<2>(Walls::boxes, true, 250, 73);
}
TEST(Laser, StaysAmongBoxes3) {
    stays_in_the_room<3>(Walls::boxes, true, 250, 74);
}

TEST(Laser, StaysAmongSegments) {
    stays_in_the_room<2>(Walls::thin, true, 250, 75);
}
TEST(Laser, StaysInAMesh) {
    stays_in_the_room<3>(Walls::thin, true, 250, 76);
}

TEST(Laser, StopsWhereTheVisitorSaysAndWhereNothingIs) {
    World2 world;
    const Id mirror = world.add(Box2{{5, 0}, {1, 9}}), wall = world.add(Box2{{-5, 0}, {1, 9}});
    std::vector<Id> hit;
    const Ray2 start{{0, 0}, {1, 0}};
    follow_laser(world, start, [&](const Ray2&, const WorldHit<2>& next) {
        hit.push_back(next.id);
        return next.id == mirror;
    });
    EXPECT_EQ(hit, (std::vector<Id>{mirror, wall}));
    world.remove(wall);
    const Ray2 last = follow_laser(world, start, [](const Ray2&, const WorldHit<2>&) { return true; });
    EXPECT_EQ(last.direction, Vec2(-1, 0));
    EXPECT_EQ(last.length, std::numeric_limits<float>::infinity());
    // The length of the ray is the total of all pieces.
    const Ray2 rest = follow_laser(world, {{0, 0}, {1, 0}, 10}, [](const Ray2&, const WorldHit<2>&) { return true; });
    EXPECT_NEAR(rest.length, 6, 1e-4);
    EXPECT_FALSE(Laser<2>(world, {{0, 0}, {0, 1}}).hit());
}

TEST(Laser, AllocatesNothing) {
    oracle::Random random(77);
    Room<3> room = make_room<3>(random, Walls::thin, 3, 5);
    room.world.update();
    int left = 1000;
    const std::size_t before = test::allocations();
    follow_laser(room.world, first_ray<3>(random, room, room.middle()),
                 [&](const Ray3&, const WorldHit<3>&) { return --left > 0; });
    EXPECT_EQ(test::allocations(), before);
    EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace abut
