// Disassembly orders: known answers, thousands of random arrangements, and cycles without an order.

#include "arrangements.hpp"
#include <abut/motion/order/projection.hpp>
#include <abut/motion/removal_order.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/cylinder.hpp>

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::Things;

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> result(count);
    std::iota(result.begin(), result.end(), 0u);
    return result;
}

TEST(RemovalOrder, OfNothingAndOfOne) {
    EXPECT_TRUE(removal_order(std::vector<Box2>{}, {0, 1}));
    EXPECT_EQ(removal_order(std::vector<Circle>{{{3, 4}, 1}}, {0, 1}).order, counted(1));
}

TEST(RemovalOrder, TheUpperOneFirst) {
    const std::vector<Box2> stack{{{0, 0}, {1, 1}}, {{0.5f, 4}, {1, 1}}, {{-0.5f, 2}, {1, 1}}};
    EXPECT_EQ(removal_order(stack, {0, 1}).order, (std::vector<std::uint32_t>{1, 2, 0}));
    EXPECT_EQ(removal_order(stack, {0, -3}).order, (std::vector<std::uint32_t>{0, 2, 1}));
    EXPECT_EQ(removal_order(stack, {1, 0}).order, counted(3)) << "side by side: the lowest first";
}

TEST(RemovalOrder, WhatIsBelowByAChainAlone) {
    // A long plank under a ball lies on a post beside the ball's projection.
    const std::vector<Capsule2> things{{{5, 0}, {5, 1}, 0.1f}, {{0, 2}, {5, 2}, 0.1f}, {{0, 4}, {0, 4}, 0.5f}};
    EXPECT_EQ(removal_order(things, {0, 1}).order, (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(RemovalOrder, UprightRodsAndPoints) {
    // A rod over a box, a point over the rod, and a rod that stands at the box's side.
    Things<2> things;
    things.add(Box2{{0, 0}, {1, 1}});
    things.add(Segment<2>{{0.3f, 2}, {0.3f, 3}});
    things.add(Circle{{0.3f, 5}, 0});
    things.add(Segment<2>{{1, -9}, {1, -8}});
    EXPECT_EQ(removal_order(things.views(), {0, 1}).order, (std::vector<std::uint32_t>{2, 1, 0, 3}));
    EXPECT_EQ(removal_order(things.views(), {0, -1}).order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

/// Checks by `sweep` that each shape of an order leaves without hitting a remaining one.
void expect_takes_apart(std::span<const Convex<2>> shapes, const Vec2& direction,
                        const std::vector<std::uint32_t>& order, std::uint64_t seed) {
    ASSERT_EQ(order.size(), shapes.size());
    const DVec<2> up = normalized(DVec<2>(direction));
    Aabb2 all = Aabb2::empty();
    for (const Convex<2>& shape : shapes) all = merged(all, bounds(shape));
    const Vec2 far = to_float(up * length(DVec<2>(all.max) - DVec<2>(all.min)));
    std::vector<bool> gone(shapes.size(), false);
    for (const std::uint32_t i : order) {
        ASSERT_FALSE(gone[i]);
        gone[i] = true;
        for (std::uint32_t j = 0; j < shapes.size(); ++j)
            if (!gone[j] && sweep(shapes[i], far, shapes[j])) {
                ASSERT_LE(projected_depth(shapes[i], shapes[j], up), tolerance_for(shapes[i], shapes[j]))
                    << i << " runs into " << j << ", seed " << seed;
            }
    }
}

/// The reference, O(n^2): tests each pair by a separating plane. Pairs within the tolerance sideways stay undecided.
std::vector<std::pair<std::uint32_t, std::uint32_t>> all_waits(std::span<const Convex<2>> shapes, const DVec<2>& up) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    for (std::uint32_t i = 0; i < shapes.size(); ++i)
        for (std::uint32_t j = 0; j < shapes.size(); ++j)
            if (i != j && projected_depth(shapes[i], shapes[j], up) > tolerance_for(shapes[i], shapes[j]) &&
                dot(DVec<2>(closest(shapes[i], shapes[j]).normal), up) > 0)
                result.emplace_back(i, j);
    return result;
}

/// Repeatedly removes the lowest index that no remaining shape is above.
std::vector<std::uint32_t> plain_order(std::size_t count, std::vector<std::pair<std::uint32_t, std::uint32_t>> waits) {
    std::vector<std::uint32_t> order, left = counted(count);
    while (!left.empty()) {
        const auto next = std::find_if(left.begin(), left.end(), [&](std::uint32_t i) {
            return std::none_of(waits.begin(), waits.end(), [&](const auto& wait) { return wait.first == i; });
        });
        if (next == left.end()) return order;
        order.push_back(*next);
        std::erase_if(waits, [&](const auto& wait) { return wait.second == *next; });
        left.erase(next);
    }
    return order;
}

Vec2 some_direction(oracle::Random& random) {
    constexpr Vec2 axes[] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    return random.chance(0.5) ? axes[random.below(4)] : Vec2(random.direction<2>() * random.power_of_two(-9, 9));
}

TEST(RemovalOrder, OfPackedPiecesInThePlane) {
    constexpr std::uint64_t seed = 61;
    oracle::Random random(seed);
    std::size_t pieces = 0, waits = 0;
    for (int repeat = 0; repeat < 1500; ++repeat) {
        const double size = random.power_of_two(-6, 8);
        const bool turned = random.chance(0.3);
        const Pose2 pose{Vec2(random.in_cube<2>() * size), turned ? random.rotation<2>() : Turn{}};
        Things<2> things;
        cut_up(things, random, {{-size, -size}, {size, -size}, {size, size}, {-size, size}},
               2 + static_cast<int>(random.below(4)), pose);
        // Half of the directions are along the sides of the pieces.
        const Vec2 direction =
            turned && random.chance(0.5) ? rotate(pose.rotation, Vec2(0, 1)) : some_direction(random);
        const RemovalOrder order = removal_order(things.views(), direction);
        ASSERT_TRUE(order) << "seed " << seed << ", repeat " << repeat;
        expect_takes_apart(things.views(), direction, order.order, seed);
        std::vector<std::size_t> place(things.size());
        for (std::size_t i = 0; i < order.order.size(); ++i) place[order.order[i]] = i;
        for (const auto& [lower, upper] : all_waits(things.views(), normalized(DVec<2>(direction)))) {
            ASSERT_LT(place[upper], place[lower]) << "seed " << seed << ", repeat " << repeat;
            ++waits;
        }
        pieces += things.size();
    }
    EXPECT_GT(waits, pieces);
}

TEST(RemovalOrder, OfAGridOfEqualThings) {
    constexpr std::uint64_t seed = 62;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 300; ++repeat) {
        const Pose2 pose{Vec2(random.in_cube<2>() * 20.0), random.chance(0.5) ? Turn{} : random.rotation<2>()};
        Things<2> things;
        on_a_grid(things, random, 6, pose);
        const Vec2 direction = random.chance(0.5) ? rotate(pose.rotation, Vec2(1, 0)) : some_direction(random);
        const RemovalOrder order = removal_order(things.views(), direction);
        ASSERT_TRUE(order) << "seed " << seed << ", repeat " << repeat;
        expect_takes_apart(things.views(), direction, order.order, seed);
    }
}

TEST(RemovalOrder, IsThatOfTheReference) {
    constexpr std::uint64_t seed = 63;
    oracle::Random random(seed);
    std::size_t moved = 0, all = 0;
    for (int repeat = 0; repeat < 500; ++repeat) {
        Things<2> things;
        throw_in(things, random, 30, random.power_of_two(-6, 8));
        const Vec2 direction = some_direction(random);
        const RemovalOrder order = removal_order(things.views(), direction);
        const auto plain = plain_order(things.size(), all_waits(things.views(), normalized(DVec<2>(direction))));
        ASSERT_EQ(order.order, plain) << "seed " << seed << ", repeat " << repeat;
        for (std::uint32_t i = 0; i < plain.size(); ++i) moved += plain[i] != i ? 1 : 0;
        all += plain.size();
    }
    EXPECT_GT(moved, all / 4) << "no order but that of the indices";
}

TEST(RemovalOrder, OfAThousandPieces) {
    oracle::Random random(64);
    Things<2> things;
    cut_up(things, random, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, 10, {});
    ASSERT_EQ(things.size(), 1024u);
    for (const Vec2 direction : {Vec2(0, 1), Vec2(3, 4)}) {
        const RemovalOrder order = removal_order(things.views(), direction);
        ASSERT_TRUE(order);
        std::vector<std::size_t> place(things.size());
        for (std::size_t i = 0; i < order.order.size(); ++i) place[order.order[i]] = i;
        for (const auto& [lower, upper] : all_waits(things.views(), normalized(DVec<2>(direction))))
            ASSERT_LT(place[upper], place[lower]);
    }
}

// --- in space -----------------------------------------------------------------------------------------------------

template <class Above>
void expect_above_first(const std::vector<std::uint32_t>& order, std::size_t count, const Above& is_above) {
    ASSERT_EQ(order.size(), count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            ASSERT_FALSE(is_above(order[j], order[i])) << order[i] << " left from under " << order[j];
}

/// A densest packing: touching layers, each in the hollows of the one below.
std::vector<Sphere> packed_balls(float radius) {
    std::vector<Sphere> balls;
    const float x = 2 * radius, y = x * 0.8660254f, z = x * 0.8164966f;
    for (int layer = 0; layer < 4; ++layer)
        for (int row = 0; row < 4; ++row)
            for (int i = 0; i < 4; ++i) {
                const float shift = layer % 2 == 0 ? 0 : 1;
                balls.push_back({{x * (static_cast<float>(i) + 0.5f * static_cast<float>(row % 2) + 0.5f * shift),
                                  y * (static_cast<float>(row) + shift / 3), z * static_cast<float>(layer)},
                                 radius});
            }
    return balls;
}

std::vector<Sphere> thrown_balls(oracle::Random& random) {
    std::vector<Sphere> balls;
    for (int attempt = 0; attempt < 400; ++attempt) {
        const Sphere ball{Vec3(random.in_cube<3>() * 3.0), random.uniform_float(0.1, 1)};
        const auto is_clear = [&](const Sphere& other) { return closest(ball, other).distance > 0; };
        if (std::all_of(balls.begin(), balls.end(), is_clear)) balls.push_back(ball);
    }
    return balls;
}

TEST(RemovalOrder, OfBallsInAnyDirection) {
    constexpr std::uint64_t seed = 65;
    oracle::Random random(seed);
    int above = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
        const std::vector<Sphere> balls =
            repeat % 2 == 0 ? packed_balls(random.uniform_float(0.1, 9)) : thrown_balls(random);
        const Vec3 direction = repeat % 5 == 0 ? Vec3(0, 0, 1) : Vec3(random.direction<3>());
        const DVec<3> up = normalized(DVec<3>(direction));
        const RemovalOrder order = removal_order(balls, direction);
        ASSERT_TRUE(order) << "seed " << seed << ", repeat " << repeat;
        expect_above_first(order.order, balls.size(), [&](std::uint32_t i, std::uint32_t j) {
            const DVec<3> between = DVec<3>(balls[i].center) - DVec<3>(balls[j].center);
            const double along = dot(between, up), reach = double{balls[i].radius} + double{balls[j].radius};
            const bool is_above = along > 0 && length(between - up * along) < reach * (1 - 1e-4);
            above += is_above ? 1 : 0;
            return is_above;
        });
    }
    EXPECT_EQ(above, 0);
}

/// A box cut repeatedly by planes perpendicular to the axes.
void cut_up(std::vector<Aabb3>& pieces, oracle::Random& random, const Aabb3& box, int cuts) {
    if (cuts == 0) return pieces.push_back(box);
    const int axis = static_cast<int>(random.below(3));
    const float cut = random.uniform_float(0.2, 0.8) * (box.max[axis] - box.min[axis]) + box.min[axis];
    Aabb3 low = box, high = box;
    low.max[axis] = high.min[axis] = cut;
    cut_up(pieces, random, low, cuts - 1);
    cut_up(pieces, random, high, cuts - 1);
}

TEST(RemovalOrder, OfPackedBoxesAlongAnAxis) {
    constexpr std::uint64_t seed = 66;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 200; ++repeat) {
        std::vector<Aabb3> boxes;
        const auto size = static_cast<float>(random.power_of_two(-6, 8));
        cut_up(boxes, random, {Vec3(-size), Vec3(2 * size)}, 6);
        const int axis = static_cast<int>(random.below(3));
        const float sign = random.chance(0.5) ? 1.0f : -1.0f;
        Vec3 direction(0);
        direction[axis] = sign;
        const RemovalOrder order = removal_order(boxes, direction);
        ASSERT_TRUE(order) << "seed " << seed << ", repeat " << repeat;
        expect_above_first(order.order, boxes.size(), [&](std::uint32_t i, std::uint32_t j) {
            bool is_above =
                sign > 0 ? boxes[i].min[axis] >= boxes[j].max[axis] : boxes[i].max[axis] <= boxes[j].min[axis];
            for (int k = 0; k < 3; ++k)
                is_above = is_above && (k == axis || (boxes[i].min[k] < boxes[j].max[k] - 1e-4f * size &&
                                                      boxes[j].min[k] < boxes[i].max[k] - 1e-4f * size));
            return is_above;
        });
    }
}

TEST(RemovalOrder, OfPackedBoxesThatAreTurnedTogether) {
    // The boxes slide along each other; rounding must not make a cycle of precedences.
    constexpr std::uint64_t seed = 68;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 100; ++repeat) {
        const auto size = static_cast<float>(random.power_of_two(-6, 8));
        const Pose3 pose{Vec3(random.in_cube<3>()) * (30 * size), random.rotation<3>()};
        std::vector<Box3> boxes;
        for (int i = 0; i < 64; ++i) {
            // As with bricks, every second layer is shifted by half a box.
            const float shift = i / 16 % 2 == 0 ? 0 : 0.5f;
            const Vec3 place(static_cast<float>(i % 4) + shift, static_cast<float>(i / 4 % 4) + shift,
                             static_cast<float>(i / 16));
            boxes.push_back({pose * (place * size), Vec3(0.5f * size), pose.rotation});
        }
        const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (const Vec3& axis : axes)
            ASSERT_TRUE(removal_order(boxes, rotate(pose.rotation, axis))) << "seed " << seed << ", repeat " << repeat;
    }
}

TEST(RemovalOrder, OfCansOnAShelf) {
    // The cans are support functions, in directions from above or aside; they touch on all sides.
    constexpr std::uint64_t seed = 69;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Pose3 pose{Vec3(random.in_cube<3>() * 5.0), repeat == 0 ? no_rotation<3> : random.rotation<3>()};
        std::vector<Cylinder> cans;
        for (int i = 0; i < 27; ++i) {
            const Vec3 base(static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9) * 2);
            cans.push_back({pose * base, pose * (base + Vec3(0, 0, 2)), 0.5f});
        }
        const RemovalOrder up = removal_order(cans, rotate(pose.rotation, Vec3(0, 0, 1)));
        ASSERT_TRUE(up) << "seed " << seed << ", repeat " << repeat;
        const auto is_above = [](std::uint32_t i, std::uint32_t j) { return i % 9 == j % 9 && i > j; };
        expect_above_first(up.order, cans.size(), is_above);
        EXPECT_TRUE(removal_order(cans, rotate(pose.rotation, Vec3(1, 0, 0))))
            << "seed " << seed << ", repeat " << repeat;
    }
}

TEST(RemovalOrder, OfThingsOfAllKindsInSpaceIsJudgedBySweeps) {
    constexpr std::uint64_t seed = 67;
    oracle::Random random(seed);
    int ordered = 0, waits = 0;
    for (int repeat = 0; repeat < 150; ++repeat) {
        Things<3> things;
        const double size = random.power_of_two(-6, 8);
        throw_in(things, random, 40, size);
        const Vec3 direction(random.direction<3>());
        const RemovalOrder order = removal_order(things.views(), direction);
        ordered += order ? 1 : 0;
        std::vector<bool> gone(things.size(), false);
        for (const std::uint32_t i : order.order) {
            gone[i] = true;
            for (std::uint32_t j = 0; j < things.size(); ++j) {
                const bool runs_into =
                    j != i &&
                    sweep(things.views()[i], direction * static_cast<float>(4 * size), things.views()[j]).has_value();
                ASSERT_FALSE(runs_into && !gone[j])
                    << i << " runs into " << j << ", seed " << seed << ", repeat " << repeat;
                waits += runs_into ? 1 : 0;
            }
        }
    }
    EXPECT_GT(ordered, 120);
    EXPECT_GT(waits, 400);
}

TEST(RemovalOrder, ThreeSticksBlockOneAnother) {
    const std::vector<Aabb3> sticks = test::three_sticks();
    for (const Aabb3& a : sticks)
        for (const Aabb3& b : sticks)
            if (&a != &b) {
                EXPECT_NEAR(closest(a, b).distance, 0, 1e-6) << "they touch, and overlap nowhere";
            }
    const RemovalOrder order = removal_order(sticks, {1, 1, 1});
    EXPECT_FALSE(order);
    EXPECT_TRUE(order.order.empty());
    ASSERT_EQ(order.cycle.size(), 3u);
    EXPECT_EQ(order.cycle.front(), 0u);
    // Each stick hits the next.
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(sweep(sticks[order.cycle[i]], Vec3(20), sticks[order.cycle[(i + 1) % 3]]));
    for (const Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}) EXPECT_TRUE(removal_order(sticks, axis));
}

TEST(RemovalOrder, NamesWhatCanLeaveBeforeTheCycle) {
    std::vector<Aabb3> things = test::three_sticks();
    things.insert(things.begin(), Aabb3{Vec3(9), Vec3(10)});  // above them all
    things.push_back(Aabb3{Vec3(-10), Vec3(-9)});             // below
    const RemovalOrder order = removal_order(things, {1, 1, 1});
    EXPECT_EQ(order.order, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(order.cycle.size(), 3u);
    EXPECT_EQ(order.cycle.front(), 1u);
}

}  // namespace
}  // namespace abut
