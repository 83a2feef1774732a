// A world as a container: ids, the data it stores, and moving the world.

#include "support/bits.hpp"
#include "support/random_shapes.hpp"
#include <abut/world/world.hpp>

#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

static_assert(std::is_copy_constructible_v<World2> && std::is_copy_assignable_v<World2> &&
              std::is_nothrow_move_constructible_v<World2>);

TEST(World, StoresItemsById) {
    World3 world;
    EXPECT_EQ(world.size(), 0u);
    const Pose3 pose{{1, 2, 3}, turn_about({0, 0, 1}, 0.5f)};
    const Id a = world.add(Sphere{{0, 0, 0}, 1}, {.pose = pose, .user = 77}), b = world.add(Sphere{{0, 0, 0}, 2});
    EXPECT_EQ(world.size(), 2u);
    EXPECT_TRUE(world.contains(a) && world.contains(b));
    EXPECT_EQ(world.user(a), 77u);
    EXPECT_EQ(world.user(b), 0u);
    EXPECT_EQ(world.pose(a), pose);
    EXPECT_EQ(world.pose(b), Pose3{});
    EXPECT_LT(a, b);
    world.move(b, pose);
    EXPECT_EQ(world.pose(b), pose);
    EXPECT_EQ(Bits(closest(world.shape(b), Vec3(9, 9, 9))),
              Bits(closest(at(Sphere{{0, 0, 0}, 2}, pose), Vec3(9, 9, 9))));
    world.remove(a);
    EXPECT_FALSE(world.contains(a));
    EXPECT_TRUE(world.contains(b));
    EXPECT_EQ(world.size(), 1u);
}

TEST(World, IdOfARemovedItemIsNeverReused) {
    World2 world;
    std::set<Id> given;
    for (int i = 0; i < 100; ++i) {
        const Id id = world.add(Circle{{0, 0}, 1});
        EXPECT_TRUE(given.insert(id).second);
        EXPECT_LE(id.index, 4u) << "indices stay small";
        if (i % 3 == 0) world.update();
        if (world.size() == 4)
            for (const Id& each : given)
                if (world.contains(each)) world.remove(each);
    }
}

/// A tetrahedron with a vertex at the origin.
Mesh corner_mesh(float size) {
    const std::vector<Vec3> points{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    const std::vector<glm::uvec3> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return *Mesh::build(points, triangles);
}

/// Adds shapes that refer to local variables; the world must copy them.
std::vector<Id> add_all_from_locals(World3& world) {
    std::vector<Id> ids;
    Mesh mesh = corner_mesh(2);
    ids.push_back(world.add(at(mesh, {{10, 0, 0}})));
    ids.push_back(world.add(at(corner_mesh(2), {{20, 0, 0}})));
    ids.push_back(world.add(at(std::as_const(mesh), {{10, 0, 0}}), {.pose = {{20, 0, 0}}}));
    ids.push_back(world.add(rounded(stretched(mesh, {2, 2, 2}), 0.25f), {.pose = {{40, 0, 0}}}));
    const auto inner = stretched(mesh, {1, 1, -1});
    const auto outer = at(inner, {{50, 0, 0}});
    ids.push_back(world.add(outer));
    auto points = std::make_unique<std::vector<Vec3>>(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
    auto hull = std::make_unique<Polyhedron>(*Polyhedron::build(*points));
    ids.push_back(world.add(at(*hull, {{60, 0, 0}})));
    auto steps = std::make_unique<Stairs<3>>(stairs<3>(3, 1));
    ids.push_back(world.add(rounded(at(*steps, {{70, 0, 0}}), 0.125f)));
    Diamond<3> diamond{{0, 0, 0}, 1};
    ids.push_back(world.add(diamond, {.pose = {{80, 0, 0}}}));
    // Overwritten locals would change the answers of a world that refers to them.
    diamond.center = {1000, 0, 0};
    steps->steps.clear();
    mesh = corner_mesh(100);
    return ids;
}

void expect_all_there(World3& world, const std::vector<Id>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const float x = 10 * static_cast<float>(i + 1);
        EXPECT_EQ(world.containing({x, 0, 0}), std::vector{ids[i]});
        const auto hit = world.raycast(Ray3::between({x, -5, 0}, {x, 5, 0}));
        ASSERT_TRUE(hit) << i;
        EXPECT_EQ(hit->id, ids[i]);
        EXPECT_FALSE(world.closest(Vec3(x, 0, 0), {.ignore = ids[i]})->id == ids[i]);
    }
    EXPECT_NEAR(world.closest(Vec3(40, 0, -1.25f))->closest.distance, 1, 1e-6);
}

TEST(World, OwnsCopiesOfAllThatShapesReferTo) {
    World3 world;
    const std::vector<Id> ids = add_all_from_locals(world);
    expect_all_there(world, ids);
    world.update();
    expect_all_there(world, ids);
    for (int i = 0; i < 100; ++i) world.add(Sphere{{0, 500, 0}, 1});
    expect_all_there(world, ids);
}

TEST(World, SetShapeOwnsToo) {
    World3 world;
    const Id id = world.add(Sphere{{0, 0, 0}, 1});
    {
        auto mesh = std::make_unique<Mesh>(corner_mesh(3));
        world.set_shape(id, at(*mesh, {{5, 0, 0}}));
    }
    EXPECT_EQ(world.containing({8, 0, 0}), std::vector{id});
    EXPECT_TRUE(world.containing({0, 0, 0}).empty());
}

TEST(World, MovedWorldAnswersAsBefore) {
    World3 first;
    const std::vector<Id> ids = add_all_from_locals(first);
    first.update();
    World3 second = std::move(first);
    expect_all_there(second, ids);
    second.add(Sphere{{10, 0, 0}, 1});
    EXPECT_EQ(second.update().began.size(), 1u);
    World3 third;
    third.add(Sphere{{0, 0, 0}, 1});
    third = std::move(second);
    EXPECT_EQ(third.size(), ids.size() + 1);
    EXPECT_FALSE(third.contacts().empty());
    EXPECT_EQ(third.update().stayed.size(), 1u);
}

}  // namespace
}  // namespace abut::test
