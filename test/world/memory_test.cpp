// The memory that a World takes for each item, including shape and broad phase.

#include "../broad_phase/allocations.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
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

}  // namespace
}  // namespace abut::test
