// Queries from many threads at once, before an update: each has the same answer as on one thread.

#include "support/bits.hpp"
#include "support/simulation.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
Bits answers(const World<D>& world, std::uint64_t seed) {
    oracle::Random random(seed);
    Bits result;
    for (int i = 0; i < 20; ++i) {
        const Vec<D> from = to_float(random.in_cube<D>() * 4.0), to = to_float(random.in_cube<D>() * 4.0);
        const Ray<D> ray = Ray<D>::between(from, to);
        result.put(world.raycast(ray));
        result.put(world.raycast_all(ray));
        result.put(world.closest(from));
        result.put(world.containing(to));
        result.put(world.overlapping(Ball<D>{from, 1}));
        result.put(world.closest(Capsule<D>{from, to, 0.25f}));
        world.each_overlapping(stairs<D>(3, 1), [&](Id id) { result.put(id); });
        result.put(world.contacts());
    }
    return result;
}

template <int D>
void query_from_many_threads() {
    Simulation<D> game(5, 40);
    game.world.update();
    game.change();
    const World<D>& world = game.world;
    constexpr std::uint64_t threads = 4;
    std::vector<Bits> expected(threads), found(threads);
    for (std::uint64_t i = 0; i < threads; ++i) expected[i] = answers(world, i);
    EXPECT_NE(expected[0], expected[1]);
    std::vector<std::thread> running;
    for (std::uint64_t i = 0; i < threads; ++i) running.emplace_back([&, i] { found[i] = answers(world, i); });
    for (std::thread& thread : running) thread.join();
    EXPECT_EQ(found, expected);
}

TEST(Threads, ManyMayQueryAtOnce) {
    query_from_many_threads<2>();
    query_from_many_threads<3>();
}

/// Worlds on different threads don't interfere, even if they share a mesh's data.
TEST(Threads, WorldsOfTheirOwnRunSideBySide) {
    const Mesh mesh = house(1);
    const auto play = [&mesh] {
        World3 world;
        for (int i = 0; i < 8; ++i) world.add(mesh, {.pose = {{0.6f * static_cast<float>(i), 0, 0}}});
        Bits result;
        for (int frame = 0; frame < 5; ++frame) {
            const Events events = world.update();
            result.put(events.began);
            result.put(events.stayed);
            result.put(world.contacts());
            world.move({1, 1}, {{0.1f * static_cast<float>(frame), 0, 0.5f}});
        }
        return result;
    };
    const Bits expected = play();
    std::vector<Bits> found(4);
    std::vector<std::thread> running;
    for (Bits& each : found) running.emplace_back([&] { each = play(); });
    for (std::thread& thread : running) thread.join();
    for (const Bits& each : found) EXPECT_EQ(each, expected);
}

}  // namespace
}  // namespace abut::test
