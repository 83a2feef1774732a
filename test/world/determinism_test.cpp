// The same calls give the same bits, and the order in which items were added affects only their ids.

#include "support/bits.hpp"
#include "support/simulation.hpp"

#include <iostream>
#include <numeric>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// Records all answers of a world during a game; `balls` counts the pairs that were rejected by their balls.
template <int D>
Bits record(std::uint64_t seed, BallEarlyOut early_out = BallEarlyOut::measured, int frames = 40,
            std::size_t* balls = nullptr) {
    Simulation<D> game(seed, 30, false, {.ball_early_out = early_out});
    Bits result;
    for (int frame = 0; frame < frames; ++frame) {
        const Events events = game.world.update();
        if (balls != nullptr) *balls += game.world.counts().balls;
        result.put(events.began);
        result.put(events.stayed);
        result.put(events.ended);
        result.put(game.world.contacts());
        game.change();
        const Vec<D> from = game.any_point(), to = game.any_point();
        result.put(game.world.raycast_all(Ray<D>::between(from, to)));
        result.put(game.world.closest(from));
        result.put(game.world.overlapping(Ball<D>{to, 1}));
        // The order is unspecified, but deterministic.
        game.world.each_overlapping(Ball<D>{to, 2}, [&](Id id) { result.put(id); });
    }
    return result;
}

TEST(Determinism, SameCallsGiveTheSameBits) {
    EXPECT_EQ(record<2>(1), record<2>(1));
    EXPECT_EQ(record<3>(2), record<3>(2));
    EXPECT_NE(record<2>(1), record<2>(3));
}

template <int D>
void expect_same_with_and_without_balls(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    constexpr int frames = 200;
    std::size_t by_balls = 0, without = 0;
    const Bits never = record<D>(seed, BallEarlyOut::never, frames, &without);
    EXPECT_TRUE(never == record<D>(seed, BallEarlyOut::always, frames, &by_balls));
    EXPECT_TRUE(never == record<D>(seed, BallEarlyOut::measured, frames));
    EXPECT_EQ(without, 0u);
    EXPECT_GT(by_balls, 100u);
}

TEST(Determinism, BoundingBallsChangeNoAnswer) {
    expect_same_with_and_without_balls<2>(11);
    expect_same_with_and_without_balls<3>(12);
}

/// Records a game with so many pairs of one type that the world's measurements suffice for a decision within a frame.
template <int D>
Bits record_crowd(BallEarlyOut early_out, std::size_t& balls) {
    oracle::Random random(D);
    World<D> world({.ball_early_out = early_out});
    const double extent = D == 2 ? 14 : 5;
    const auto points = cloud<D>(random, 9, 0.9);
    const auto hull = [&] {
        if constexpr (D == 2)
            return *Polygon::build(points);
        else
            return *Polyhedron::build(points);
    }();
    std::vector<Id> ids;
    for (int i = 0; i < 500; ++i) {
        const Pose<D> pose = random_pose<D>(random, extent);
        ids.push_back(i % 2 == 0 ? world.add(hull, {.pose = pose})
                                 : world.add(Ball<D>{Vec<D>(0.0f), 0.5f}, {.pose = pose}));
    }
    Bits result;
    for (int frame = 0; frame < 30; ++frame) {
        const Events events = world.update();
        result.put(events.began);
        result.put(events.stayed);
        result.put(events.ended);
        result.put(world.contacts());
        balls += world.counts().balls;
        for (const Id id : ids) world.move(id, moved_a_little(random, world.pose(id), 0.2));
    }
    return result;
}

template <int D>
void expect_crowd_the_same() {
    std::size_t always = 0, measured = 0, never = 0;
    const Bits expected = record_crowd<D>(BallEarlyOut::never, never);
    EXPECT_TRUE(expected == record_crowd<D>(BallEarlyOut::always, always));
    EXPECT_TRUE(expected == record_crowd<D>(BallEarlyOut::measured, measured));
    EXPECT_EQ(never, 0u);
    EXPECT_GT(always, 1000u);
    EXPECT_LE(measured, always);
    std::cout << D << "D: of " << always << " pairs that balls can reject, they rejected " << measured << "\n";
}

TEST(Determinism, WhatIsMeasuredChangesNoAnswer) {
    expect_crowd_the_same<2>();
    expect_crowd_the_same<3>();
}

/// Records dense rotated boxes and balls, so that most contacts have neighbours: surface normals, and substitutes for
/// normals of internal edges.
template <int D>
std::uint64_t hash_of_crowd(std::size_t items, double extent) {
    oracle::Random random(D);
    World<D> world({.ball_early_out = BallEarlyOut::never});
    std::vector<Id> ids;
    for (std::size_t i = 0; i < items; ++i) {
        const ItemOptions<D> options{.pose = random_pose<D>(random, extent), .fixed = i % 5 == 0};
        ids.push_back(i % 3 == 0 ? world.add(Ball<D>{Vec<D>(0.0f), 0.5f}, options)
                                 : world.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, options));
    }
    Bits bits;
    for (int frame = 0; frame < 4; ++frame) {
        const Events events = world.update();
        bits.put(events.began);
        bits.put(events.ended);
        bits.put(world.contacts());
        for (const Id id : ids) world.move(id, moved_a_little(random, world.pose(id), 0.1));
    }
    return bits.hash();
}

/// Balls among themselves, and items whose centre others contain, have their own contacts.
TEST(Determinism, CrowdsAreGolden) {
    EXPECT_EQ(hash_of_crowd<2>(300, 5), 9080655657195711739u);
    EXPECT_EQ(hash_of_crowd<2>(600, 5), 2248062542871011355u);
    EXPECT_EQ(hash_of_crowd<3>(400, 3), 6181791961382690151u);
}

/// A scene whose items are added in some order, with their number as `user`.
template <int D>
class Scene {
public:
    Scene(std::uint64_t seed, std::span<const std::uint32_t> order) : ids_(order.size()) {
        for (const std::uint32_t i : order) {
            oracle::Random random(seed + i);
            const Pose<D> pose = random_pose<D>(random, Simulation<D>::extent);
            with_random_shape<D>(random, random_kind<D>(random), [&](const auto& shape) {
                ids_[i] = world.add(shape, {.pose = pose, .user = i, .fixed = i % 4 == 0, .sensor = i % 7 == 0});
            });
        }
    }

    void move(std::uint32_t number, const Pose<D>& pose) { world.move(ids_[number], pose); }
    std::uint32_t number(Id id) const { return static_cast<std::uint32_t>(world.user(id)); }

    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers(std::span<const IdPair> pairs) const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
        for (const IdPair& pair : pairs) result.push_back(std::minmax(number(pair.a), number(pair.b)));
        std::sort(result.begin(), result.end());
        return result;
    }
    std::vector<std::uint32_t> numbers(const std::vector<Id>& ids) const {
        std::vector<std::uint32_t> result;
        for (const Id id : ids) result.push_back(number(id));
        std::sort(result.begin(), result.end());
        return result;
    }

    /// Sorts by distance, then by number: if a ray starts inside several items, the lowest id comes first.
    std::vector<std::pair<float, std::uint32_t>> hits(const Ray<D>& ray) const {
        std::vector<std::pair<float, std::uint32_t>> result;
        for (const WorldHit<D>& each : world.raycast_all(ray)) result.emplace_back(each.hit.distance, number(each.id));
        const auto first = world.raycast(ray);
        EXPECT_EQ(first.has_value(), !result.empty());
        EXPECT_TRUE(!first || first->hit.distance == result.front().first);
        std::sort(result.begin(), result.end());
        return result;
    }

    World<D> world;

private:
    std::vector<Id> ids_;
};

template <int D>
void expect_same_in_any_order(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<std::uint32_t> order(40);
    std::iota(order.begin(), order.end(), 0u);
    Scene<D> straight(seed, order);
    oracle::Random random(seed);
    for (std::uint32_t i = 40; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    Scene<D> shuffled(seed, order);
    std::size_t began = 0, ended = 0, hits = 0;
    for (int frame = 0; frame < 30; ++frame) {
        const Events one = straight.world.update(), other = shuffled.world.update();
        ASSERT_EQ(straight.numbers(one.began), shuffled.numbers(other.began));
        ASSERT_EQ(straight.numbers(one.stayed), shuffled.numbers(other.stayed));
        ASSERT_EQ(straight.numbers(one.ended), shuffled.numbers(other.ended));
        began += one.began.size();
        ended += one.ended.size();
        const Vec<D> from = to_float(random.in_cube<D>() * 4.0), to = to_float(random.in_cube<D>() * 4.0);
        const Ray<D> ray = Ray<D>::between(from, to);
        const auto all = straight.hits(ray);
        ASSERT_EQ(all, shuffled.hits(ray));
        hits += all.size();
        const auto nearest = straight.world.closest(from), same_nearest = shuffled.world.closest(from);
        ASSERT_TRUE(nearest && same_nearest);
        ASSERT_EQ(straight.number(nearest->id), shuffled.number(same_nearest->id));
        ASSERT_EQ(Bits(nearest->closest), Bits(same_nearest->closest));
        const Ball<D> ball{to, 1};
        ASSERT_EQ(straight.numbers(straight.world.overlapping(ball)),
                  shuffled.numbers(shuffled.world.overlapping(ball)));
        ASSERT_EQ(straight.numbers(straight.world.containing(to)), shuffled.numbers(shuffled.world.containing(to)));
        for (std::uint32_t i = 0; i < 40; ++i) {
            if (random.chance(0.5)) continue;
            const Pose<D> pose = random_pose<D>(random, Simulation<D>::extent);
            straight.move(i, pose);
            shuffled.move(i, pose);
        }
    }
    EXPECT_GT(began, 100u);
    EXPECT_GT(ended, 100u);
    EXPECT_GT(hits, 20u);
}

TEST(Determinism, OrderOfAddingAffectsIdsAlone) {
    expect_same_in_any_order<2>(100);
    expect_same_in_any_order<3>(200);
}

}  // namespace
}  // namespace abut::test
