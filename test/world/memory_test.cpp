// What a World takes an item, shape and broad phase included.

#include "../broad_phase/allocations.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <iostream>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct BytesAnItem {
    double added = 0, updated = 0, moved = 0;
};

/// Items on a lattice, none near another.
template <int D, class S>
BytesAnItem bytes_an_item(const S& shape) {
    constexpr std::size_t count = 100'000;
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

// After an update a circle took 783 bytes, a sphere 1033 and a box in 3D 1065.
TEST(Memory, OfAnItem) {
    const auto expect = [](const BytesAnItem& bytes, double most, double most_moved) {
        std::cout << bytes.added << " bytes added, " << bytes.updated << " updated, " << bytes.moved << " moved\n";
        EXPECT_LT(bytes.updated, most);
        EXPECT_LT(bytes.moved, most_moved);
    };
    expect(bytes_an_item<2>(Circle{{0, 0}, 1}), 280, 310);
    expect(bytes_an_item<3>(Sphere{{0, 0, 0}, 1}), 320, 360);
    expect(bytes_an_item<3>(Box3{{0, 0, 0}, {1, 1, 1}}), 355, 395);
}

}  // namespace
}  // namespace abut::test
