// The memory that a World takes for each item, including shape and broad phase, and after many frames.

#include "../broad_phase/allocations.hpp"
#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include "../oracle/sanitized.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct BytesAnItem {
    double added = 0, updated = 0, moved = 0;
};

/// Measures items on a lattice, none of them near another.
template <int D, class S>
BytesAnItem bytes_an_item(const S& shape, std::size_t count) {
    std::vector<Id> ids;
    ids.reserve(count);
    const std::size_t before = allocated_bytes();
    const auto since = [&] { return static_cast<double>(allocated_bytes() - before) / static_cast<double>(count); };
    BytesAnItem result;
    World<D> world;
    const auto pose = [](std::size_t i, float x) {
        Pose<D> there;
        there.position[0] = 4 * static_cast<float>(i % 400) + x;
        there.position[1] = 4 * static_cast<float>(i / 400);
        return there;
    };
    for (std::size_t i = 0; i < count; ++i) ids.push_back(world.add(shape, {.pose = pose(i, 0)}));
    result.added = since();
    world.update();
    result.updated = since();
    for (int frame = 1; frame < 3; ++frame) {
        for (std::size_t i = 0; i < count; ++i) world.move(ids[i], pose(i, 0.1f * static_cast<float>(frame)));
        world.update();
    }
    result.moved = since();
    return result;
}

/// Tests the maximum over several numbers of items: lists grow by a quarter at a time, so their unused share varies.
template <int D, class S>
void expect_little(const char* name, const S& shape) {
    BytesAnItem max_bytes;
    for (const std::size_t count : {64'000u, 80'000u, 100'000u}) {
        const BytesAnItem bytes = bytes_an_item<D>(shape, count);
        max_bytes.added = std::max(max_bytes.added, bytes.added);
        max_bytes.updated = std::max(max_bytes.updated, bytes.updated);
        max_bytes.moved = std::max(max_bytes.moved, bytes.moved);
    }
    std::cout << name << ": " << max_bytes.added << " bytes added, " << max_bytes.updated << " updated, "
              << max_bytes.moved << " moved\n";
    constexpr double limit = 280 + sizeof(S), growth = 1.25;
    EXPECT_LT(max_bytes.updated, limit);
    // Moved items need their previous pose and an entry in the list of changed items.
    EXPECT_LT(max_bytes.moved, limit + growth * (sizeof(Pose<D>) + sizeof(std::uint32_t)));
}

// Measured after an update of 64,000 to 100,000 items: 234 bytes for a circle, 290 for a sphere, 306 for a 3D box.
TEST(Memory, OfAnItem) {
    expect_little<2>("circle", Circle{{0, 0}, 1});
    expect_little<2>("box in 2D", Box2{{0, 0}, {1, 1}});
    expect_little<3>("sphere", Sphere{{0, 0, 0}, 1});
    expect_little<3>("box in 3D", Box3{{0, 0, 0}, {1, 1, 1}});
}

/// The pages of memory that the program has; 0 where the system doesn't show them, or a sanitizer holds what was freed.
std::size_t pages_in_memory() {
    std::size_t all = 0, here = 0;
    if (!oracle::sanitized) std::ifstream("/proc/self/statm") >> all >> here;
    return here;
}

/// The most memory of a world in two halves of many frames, in which items come, go, move and get other shapes, without
/// the first frames, in which lists grow. The number of items stays.
struct MostMemory {
    std::size_t allocated = 0, pages = 0;
};
template <int D>
std::array<MostMemory, 2> most_memory(int frames, std::uint64_t seed) {
    oracle::Random random(seed);
    const auto pose = [&] { return Pose<D>{detail::to_float(random.in_cube<D>() * 8.0), random.rotation<D>()}; };
    const auto add = [&](World<D>& world) {
        const float radius = random.uniform_float(0.2, 1.5);
        ItemOptions<D> options;
        options.pose = pose();
        options.fixed = random.chance(0.2);
        options.continuous = random.chance(0.1);
        return random.chance(0.5) ? world.add(Ball<D>{Vec<D>(0.0f), radius}, options)
                                  : world.add(Box<D>{Vec<D>(0.0f), Vec<D>(radius)}, options);
    };
    World<D> world;
    std::vector<Id> ids;
    for (int i = 0; i < 100; ++i) ids.push_back(add(world));
    std::array<MostMemory, 2> result;
    std::vector<std::byte> saved;
    const int warm = frames / 5;
    for (int frame = 0; frame < frames; ++frame) {
        for (Id& id : ids) {
            if (random.chance(0.02)) {
                world.remove(id);
                id = add(world);
            } else if (random.chance(0.5)) {
                world.move(id, pose());
            } else if (random.chance(0.02)) {
                world.set_shape(id, Box<D>{Vec<D>(0.0f), Vec<D>(random.uniform_float(0.2, 1.5))});
            }
        }
        world.update();
        if (frame % 10 == 0) world.save(saved);
        if (frame % 10 == 5 && random.chance(0.1)) {
            EXPECT_FALSE(world.restore(saved));
            ids.clear();
            world.each_item([&](Id id) { ids.push_back(id); });
        }
        if (frame < warm) continue;
        MostMemory& most = result[frame < (warm + frames) / 2 ? 0 : 1];
        most.allocated = std::max(most.allocated, allocated_bytes());
        if (frame % 100 == 0) most.pages = std::max(most.pages, pages_in_memory());
    }
    return result;
}

template <int D>
void expect_flat() {
    const std::uint64_t seed = 1;
    const int frames = oracle::is_long() ? 100'000 : 3'000;
    const auto [first, second] = most_memory<D>(frames, seed);
    std::cout << frames << " frames, seed " << seed << ": " << first.allocated << " and " << second.allocated
              << " bytes, " << first.pages << " and " << second.pages << " pages\n";
    EXPECT_LE(second.allocated, first.allocated + first.allocated / 50);
    EXPECT_LE(second.pages, first.pages + 64);
}

TEST(Memory, IsFlatOverManyFrames) {
    expect_flat<2>();
    expect_flat<3>();
}

}  // namespace
}  // namespace abut::test
