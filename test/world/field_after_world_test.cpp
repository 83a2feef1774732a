// A World takes a Field in a file that includes world.hpp first: views of shapes are found by their arguments. (It once
// did not compile.) This file is compiled alone, since its neighbours include field.hpp.
#include <abut/bake/field.hpp>
#include <abut/world/world.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(FieldAfterWorld, IsAnItem) {
    const std::vector<Vec2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const Result<Field<2>> field = bake_field(square, {}, {.cell = 0.25f});
    ASSERT_TRUE(field) << field.problem().message;
    World2 world;
    const Id id = world.add(*field);
    EXPECT_TRUE(world.contains(id));
}

}  // namespace
}  // namespace abut
