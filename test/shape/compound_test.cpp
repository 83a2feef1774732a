#include "../oracle/expect.hpp"
#include "meshes.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/world/world.hpp>

#include <limits>

namespace abut {
namespace {

TEST(Compound, TellsWhatIsWrongAndWhere) {
    EXPECT_EQ(Compound3::build({}).problem().code, ProblemCode::empty_input);
    const Result<Compound3> with_floor = Compound3::build({Sphere{{0, 0, 0}, 1}, HalfSpace3{{0, 1, 0}, 0}});
    ASSERT_FALSE(with_floor);
    EXPECT_EQ(with_floor.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(with_floor.problem().index, 1u);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Result<Compound2> with_nan = Compound2::build({Circle{{0, 0}, 1}, Circle{{0, 0}, 1}, Circle{{nan, 0}, 1}});
    ASSERT_FALSE(with_nan);
    EXPECT_EQ(with_nan.problem().code, ProblemCode::not_finite);
    EXPECT_EQ(with_nan.problem().index, 2u);
}

TEST(Compound, TellsTheChild) {
    // A dumbbell; the polygon's corners live in the compound from here on.
    const Compound2 dumbbell =
        *Compound2::build({Circle{{-2, 0}, 1}, Box2{{0, 0}, {2, 0.25f}}, *Polygon::build({{2, -1}, {3, 0}, {2, 1}})});
    EXPECT_EQ(dumbbell.size(), 3u);
    EXPECT_EQ(closest(dumbbell, Vec2(-4, 0)).feature_a.part, 0u);
    EXPECT_EQ(closest(dumbbell, Vec2(0, 2)).feature_a.part, 1u);
    EXPECT_EQ(closest(dumbbell, Vec2(4, 0)).feature_a.part, 2u);
    EXPECT_FLOAT_EQ(closest(dumbbell, Vec2(4, 0)).distance, 1);
    EXPECT_EQ(raycast(Ray2::between({0, 5}, {0, -5}), dumbbell)->feature.part, 1u);
    EXPECT_TRUE(contains(dumbbell, Vec2(-2.5f, 0.25f)));
    EXPECT_FALSE(contains(dumbbell, Vec2(-0.5f, 0.5f)));
}

TEST(Compound, OfLevelsReportsTheChildAndIsSolidWhereThatIs) {
    const Mesh cube = test::box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
    const Compound3 inner = *Compound3::build({Sphere{{0, 5, 0}, 1}, at(cube, Pose3{{10, 0, 0}})});
    const Compound3 outer =
        *Compound3::build({Sphere{{0, 0, 0}, 1}, at(stretched(inner, Vec3(1, 1, 2)), Pose3{{0, 0, 10}})});
    EXPECT_EQ(closest(outer, Vec3(10, 3, 10)).feature_a.part, 1u);
    EXPECT_FLOAT_EQ(closest(outer, Vec3(10, 3, 10)).distance, 2);
    EXPECT_TRUE(contains(outer, Vec3(10, 0, 11.5f)));
    EXPECT_FALSE(contains(outer, Vec3(10, 0, 12.5f)));
    EXPECT_FALSE(overlaps(outer, Sphere{{10, 0, 10}, 0.5f}));  // within the mesh's surface
}

/// A compound of an instance of a mesh in a world: nothing is copied, and all queries find it.
TEST(Compound, InAWorldOutlivesWhatItWasMadeOf) {
    World3 world;
    Id id;
    {
        const Mesh cube = test::box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
        id = world.add(*Compound3::build({at(cube, Pose3{{2, 0, 0}}), Capsule<3>{{-2, -1, 0}, {-2, 1, 0}, 0.5f}}),
                       {.pose = {{0, 0, 7}}});
    }
    world.update();
    const auto hit = world.raycast(Ray3::between({2, 5, 7}, {2, -5, 7}));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id, id);
    EXPECT_EQ(hit->hit.feature.part, 0u);
    EXPECT_FLOAT_EQ(hit->hit.distance, 4);
    EXPECT_EQ(world.containing({2, 0, 7}).size(), 1u);
    EXPECT_EQ(world.overlapping(Sphere{{-2, 0, 7}, 0.1f}).size(), 1u);
    EXPECT_EQ(world.overlapping(Sphere{{0, 0, 7}, 0.1f}).size(), 0u);
}

}  // namespace
}  // namespace abut
