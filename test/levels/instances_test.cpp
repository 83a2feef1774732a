// One mesh at many poses and scales: one tree, no copies, and separate answers.

#include "levels.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/placed.hpp>
#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(Instances, ShareTheirMesh) {
    const Mesh mesh = box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
    const auto stored = owned(at(stretched(mesh, Vec3(1, 2, 3)), Pose3{{5, 0, 0}}));
    EXPECT_EQ(stored.shape.shape.points().data(), mesh.points().data());
    EXPECT_EQ(stored.shape.shape.triangles().data(), mesh.triangles().data());
}

TEST(Instances, OfOneMeshStandWhereTheyWerePut) {
    const Mesh mesh = box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
    World3 world;
    std::vector<Id> ids;
    for (int i = 0; i < 100; ++i) {
        // Each instance is wider than the last, mirrored, and a little higher.
        const auto at_x = static_cast<float>(10 * i);
        const Vec3 scale(1 + 0.01f * static_cast<float>(i), -1, 2);
        ids.push_back(world.add(stretched(mesh, scale), {.pose = {{at_x, 0, static_cast<float>(i)}}, .fixed = true}));
    }
    world.update();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto x = static_cast<float>(10 * i), z = static_cast<float>(i);
        const auto from_above = world.raycast(Ray3::between({x, 0.25f, z + 5}, {x, 0.25f, z}));
        ASSERT_TRUE(from_above);
        EXPECT_EQ(from_above->id, ids[i]);
        EXPECT_NEAR(from_above->hit.distance, 3, 1e-5);
        const auto beside = world.closest(Vec3(x + 3, 0, z));
        ASSERT_TRUE(beside);
        EXPECT_EQ(beside->id, ids[i]);
        EXPECT_NEAR(beside->closest.distance, 2 - 0.01 * static_cast<double>(i), 1e-4);
        // A mirrored solid mesh is still closed.
        EXPECT_EQ(world.containing({x, 0, z + 1.9f}).size(), 1u);
    }
}

}  // namespace
}  // namespace abut::test
