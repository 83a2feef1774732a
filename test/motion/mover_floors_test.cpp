// A mover over floors made of pieces has no ghost collisions: its path is as long and straight as requested.

#include "../broad_phase/allocations.hpp"
#include "../oracle/random.hpp"
#include <abut/motion/mover.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

constexpr std::uint64_t floors_seed = 20260722;
constexpr int tiles = 16;  // along each axis, each 1 wide, from -8 on; the surface is at height 0

float about(float number, Random* random) {
    return random != nullptr ? number + random->uniform_float(-1e-6, 1e-6) : number;
}

void add_boxes(World3& world, Random* random) {
    for (int z = -8; z < 8; ++z)
        for (int x = -8; x < 8; ++x)
            world.add(
                Box3{{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random), static_cast<float>(z) + 0.5f},
                     {0.5f, 0.5f, 0.5f}},
                {.fixed = true});
}
void add_mesh(World3& world, Random* random) {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (int z = 0; z <= tiles; ++z)
        for (int x = 0; x <= tiles; ++x) points.push_back({x - 8, about(0, random), z - 8});
    const auto at = [](int x, int z) { return static_cast<std::uint32_t>(z * (tiles + 1) + x); };
    for (int z = 0; z < tiles; ++z)
        for (int x = 0; x < tiles; ++x) {
            triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
            triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
        }
    world.add(*Mesh::build(points, triangles), {.fixed = true});
}
void add_boxes(World2& world, Random* random) {
    for (int x = -8; x < 8; ++x)
        world.add(Box2{{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random)}, {0.5f, 0.5f}},
                  {.fixed = true});
}
void add_segments(World2& world, Random* random) {
    std::vector<Vec2> points;
    for (int x = -8; x <= 8; ++x) points.push_back({x, about(0, random)});
    for (std::size_t x = 0; x < tiles; ++x) world.add(Segment2{points[x], points[x + 1]}, {.fixed = true});
}

/// The boxes as one SolidBsp of brushes.
template <int D>
void add_solid(World<D>& world, Random* random) {
    std::vector<HalfSpace<D>> sides;
    std::vector<std::uint32_t> ends;
    for (int z = -8; z < (D == 3 ? 8 : -7); ++z)
        for (int x = -8; x < 8; ++x) {
            Vec<D> center(static_cast<float>(z) + 0.5f);
            center[0] = about(static_cast<float>(x) + 0.5f, random);
            center[1] = about(-0.5f, random);
            for (int axis = 0; axis < D; ++axis) {
                Vec<D> normal(0.0f);
                normal[axis] = 1;
                sides.push_back({normal, center[axis] + 0.5f});
                sides.push_back({-normal, 0.5f - center[axis]});
            }
            ends.push_back(static_cast<std::uint32_t>(sides.size()));
        }
    world.add(*SolidBsp<D>::from_brushes(sides, ends), {.fixed = true});
}
void add_solid_of_faces(World2& world, Random* random) {
    std::vector<Vec2> points;
    std::vector<glm::uvec2> faces;
    for (int x = -8; x < 8; ++x) {
        const auto first = static_cast<std::uint32_t>(points.size());
        const Vec2 low(about(static_cast<float>(x), random), -1),
            high(about(static_cast<float>(x + 1), random), about(0, random));
        points.insert(points.end(), {low, {high.x, low.y}, high, {low.x, high.y}});
        for (std::uint32_t i = 0; i < 4; ++i) faces.emplace_back(first + i, first + (i + 1) % 4);
    }
    world.add(*SolidBsp2::build(points, faces), {.fixed = true});
}

template <int D>
Vec<D> level_direction(Random& random) {
    Vec<D> result(0.0f);
    if constexpr (D == 2) {
        result[0] = random.chance(0.5) ? 1.0f : -1.0f;
    } else {
        // Every third direction is along the internal edges.
        const DVec<2> direction =
            random.chance(0.3) ? (random.chance(0.5) ? DVec<2>{1, 0} : DVec<2>{0, -1}) : random.direction<2>();
        result = {static_cast<float>(direction.x), 0, static_cast<float>(direction.y)};
    }
    return result;
}

/// Slides the shape, whose lowest point is `reach` below it, from the middle in many directions at several speeds.
/// `off` is the tolerance of normals.
template <int D, class S>
void expect_no_catch(const char* name, const World<D>& world, const S& shape, float reach, double off) {
    Random random(floors_seed);
    for (const float speed : {0.003f, 0.05f, 0.4f, 2.7f}) {
        for (int run = 0; run < 12; ++run) {
            Mover<D> mover;
            const Vec<D> direction = level_direction<D>(random);
            Vec<D> position(0.0f);
            position[1] = reach + 0.005f;
            if (random.chance(0.5)) position[0] = random.uniform_float(-0.5, 0.5);
            const Vec<D> from = position;
            const int frames = std::min(60, static_cast<int>(5.5f / speed));
            for (int i = 0; i < frames; ++i) {
                Vec<D> motion = direction * speed;
                motion[1] = -0.01f;
                const Moved<D> moved = mover.move(world, shape, position, motion);
                position = moved.position;
                ASSERT_TRUE(moved.grounded) << name << ' ' << speed << ' ' << run << ' ' << i;
                for (const MoverTouch<D>& touch : moved.touches)
                    ASSERT_NEAR(touch.normal[1], 1, off) << name << ' ' << speed << ' ' << run << ' ' << i;
            }
            const DVec<D> wanted = DVec<D>(from) + DVec<D>(direction * speed) * static_cast<double>(frames);
            DVec<D> error = DVec<D>(position) - wanted;
            EXPECT_LT(std::abs(error[1]), 0.01) << name << ' ' << speed << ' ' << run;
            error[1] = 0;
            EXPECT_LT(length(error), 1e-4 + off * speed * frames) << name << ' ' << speed << ' ' << run;
        }
    }
}

TEST(MoverFloors, NothingCatchesInSpace) {
    Random perturbation(floors_seed);
    for (Random* random : {static_cast<Random*>(nullptr), &perturbation}) {
        for (const auto& add : {static_cast<void (*)(World3&, Random*)>(add_boxes), add_mesh, add_solid<3>}) {
            World3 world;
            add(world, random);
            const double off = random != nullptr ? 1e-3 : 1e-5;
            expect_no_catch<3>("box", world, Box3{{0, 0, 0}, {0.4f, 0.5f, 0.6f}}, 0.5f, off);
            expect_no_catch<3>("capsule", world, Capsule3{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f}, 0.9f, off);
            expect_no_catch<3>("ball", world, Sphere{{0, 0, 0}, 0.5f}, 0.5f, off);
            expect_no_catch<3>("cylinder", world, Cylinder{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f}, 0.5f, off);
        }
    }
}

TEST(MoverFloors, NothingCatchesInThePlane) {
    Random perturbation(floors_seed);
    for (Random* random : {static_cast<Random*>(nullptr), &perturbation}) {
        for (const auto& add :
             {static_cast<void (*)(World2&, Random*)>(add_boxes), add_segments, add_solid<2>, add_solid_of_faces}) {
            World2 world;
            add(world, random);
            const double off = random != nullptr ? 1e-3 : 1e-5;
            expect_no_catch<2>("box", world, Box2{{0, 0}, {0.4f, 0.5f}}, 0.5f, off);
            expect_no_catch<2>("capsule", world, Capsule2{{0, -0.5f}, {0, 0.5f}, 0.4f}, 0.9f, off);
            expect_no_catch<2>("ball", world, Circle{{0, 0}, 0.5f}, 0.5f, off);
        }
    }
}

TEST(MoverFloors, AllocatesNothingOnceWarm) {
    World3 world;
    add_mesh(world, nullptr);
    world.add(Box3{{3, 1, 0}, {0.3f, 1, 5}}, {.fixed = true});
    Mover3 mover;
    std::size_t allocated = 0;
    for (int round = 0; round < 2; ++round) {
        const std::size_t before = test::allocations();
        Vec3 position{0, 0.91f, 0};
        for (int i = 0; i < 100; ++i)
            position = mover.move(world, Capsule3{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.4f}, position, {0.05f, -0.01f, 0.02f})
                           .position;
        allocated = test::allocations() - before;
    }
    EXPECT_EQ(allocated, 0u);
}

/// Random walks through a world of random walls, steps and slopes: the mover is never inside an item, never moves
/// farther than requested, and is deterministic.
template <int D>
void walk_at_random(std::uint64_t number) {
    Random random(number);
    World<D> world;
    Vec<D> up(0.0f);
    up[1] = 1;
    world.add(HalfSpace<D>{up, 0}, {.fixed = true});
    for (int i = 0; i < 40; ++i) {
        Box<D> box;
        box.center = Vec<D>(to_float<D>(random.in_cube<D>() * 6.0));
        box.center[1] = random.uniform_float(-0.5, 2.5);
        for (int axis = 0; axis < D; ++axis) box.half[axis] = random.uniform_float(0.1, 1);
        if (random.chance(0.5)) box.rotation = random.rotation<D>();
        world.add(box, {.fixed = true});
    }
    Vec<D> a(0.0f), b(0.0f);
    a[1] = -0.3f;
    b[1] = 0.3f;
    const Capsule<D> shape{a, b, 0.3f};
    const MoverOptions<D> options;
    Mover<D> mover(options);
    Vec<D> position(0.0f);
    position[1] = 8;
    Vec<D> direction(0.0f);
    float fall = 0;
    int crushed = 0, grounded = 0;
    for (int i = 0; i < 400; ++i) {
        if (i % 20 == 0)
            direction = level_direction<D>(random) * random.uniform_float(0, random.chance(0.1) ? 1.5 : 0.15);
        Vec<D> motion = direction;
        fall = std::min(fall + 0.01f, 0.5f);
        motion[1] = random.chance(0.03) ? 0.3f : -fall;
        const Moved<D> moved = mover.move(world, shape, position, motion);
        const DVec<D> gone = DVec<D>(moved.position - position - moved.pushed - moved.carried);
        const double max_length = length(DVec<D>(motion)), height = gone[1];
        DVec<D> level = gone;
        level[1] = 0;
        ASSERT_LT(length(level), max_length + 1e-5) << number << ' ' << i;
        ASSERT_LT(std::abs(height), max_length + 0.31) << number << ' ' << i;
        position = moved.position;
        crushed += moved.crushed ? 1 : 0;
        grounded += moved.grounded ? 1 : 0;
        if (moved.grounded) fall = 0;
        ASSERT_TRUE(moved.crushed || world.overlapping(at(shape, Pose<D>{position})).empty()) << number << ' ' << i;
        // A move of a new mover from the same position has no state.
        Mover<D> other(options);
        ASSERT_EQ(other.move(world, shape, position, motion).position,
                  Mover<D>(options).move(world, shape, position, motion).position);
    }
    EXPECT_EQ(crushed, 0) << number;
    EXPECT_GT(grounded, 50) << number;
}

TEST(MoverFloors, AtRandomItNeverEndsInsideNorGoesFarther) {
    for (std::uint64_t number = 0; number < 40; ++number) {
        walk_at_random<2>(floors_seed + number);
        walk_at_random<3>(floors_seed + number);
    }
}

}  // namespace
}  // namespace abut
