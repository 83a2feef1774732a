#include <abut/math/to_vec.hpp>

#include <array>
#include <type_traits>

#include <gtest/gtest.h>

namespace game {
namespace {

struct Vec2 {
    double x, y;
};
struct Vec3 {
    float x, y, z;
};
struct Reordered {
    float z, y, x;
};
struct Vec4 {
    float x, y, z, w;
};
struct Indexed {
    std::array<short, 3> elements;
    short operator[](int i) const { return elements[static_cast<std::size_t>(i)]; }
    short& operator[](int i) { return elements[static_cast<std::size_t>(i)]; }
};
struct Constant {
    Constant(float a, float b, float c) : x(a), y(b), z(c) {}
    const float x, y, z;
};
// Members of other names, and members that mislead: its functions come first.
struct Place {
    float x, y, up;
};
abut::Vec3 to_vec(const Place& place) {
    return {place.x, place.up, -place.y};
}
void from_vec(const abut::Vec3& v, Place& out) {
    out = {v.x, -v.z, v.y};
}
struct Nothing {};

}  // namespace
}  // namespace game

namespace abut::test {
namespace {

using game::Place;

template <class V>
constexpr bool converts = std::is_invocable_v<decltype(abut::to_vec), const V&>;

static_assert(abut::to_vec(game::Vec3{1, 2, 3}) == Vec3(1, 2, 3));
static_assert(abut::to_vec(game::Vec2{1, 2}) == Vec2(1, 2));
static_assert(abut::to_vec(Vec3(1, 2, 3)) == Vec3(1, 2, 3));
static_assert(abut::to_vec(std::array<float, 2>{1, 2}) == Vec2(1, 2));
static_assert(from_vec<game::Vec3>(Vec3(1, 2, 3)).z == 3);
static_assert(!converts<game::Vec4> && !converts<game::Nothing> && !converts<float> && !converts<const float*> &&
              !converts<std::array<float, 4>>);

TEST(ToVec, Members) {
    EXPECT_EQ(abut::to_vec(game::Reordered{3, 2, 1}), Vec3(1, 2, 3));
    EXPECT_EQ(abut::to_vec(glm::dvec3(1, 2, 0.1)), Vec3(1, 2, 0.1f));
    const auto back = from_vec<game::Reordered>(Vec3(1, 2, 3));
    EXPECT_EQ(back.x, 1);
    EXPECT_EQ(back.z, 3);
    EXPECT_EQ(from_vec<game::Vec2>(Vec2(1, 2)).y, 2);
    EXPECT_EQ(from_vec<glm::dvec3>(Vec3(1, 2, 3)), glm::dvec3(1, 2, 3));
}

TEST(ToVec, Elements) {
    const float array[]{1, 2, 3};
    EXPECT_EQ(abut::to_vec(array), Vec3(1, 2, 3));
    EXPECT_EQ(abut::to_vec(game::Indexed{{1, 2, 3}}), Vec3(1, 2, 3));
    EXPECT_EQ(from_vec<game::Indexed>(Vec3(1, 2, 3)).elements, (std::array<short, 3>{1, 2, 3}));
    EXPECT_EQ((from_vec<std::array<double, 2>>(Vec2(1, 2))), (std::array<double, 2>{1, 2}));
}

TEST(ToVec, Constructor) {
    EXPECT_EQ(from_vec<game::Constant>(Vec3(1, 2, 3)).z, 3);
}

TEST(ToVec, FunctionsOfTheUserComeFirst) {
    EXPECT_EQ(abut::to_vec(Place{1, 2, 3}), Vec3(1, 3, -2));
    const Place back = from_vec<Place>(Vec3(1, 3, -2));
    EXPECT_EQ(back.x, 1);
    EXPECT_EQ(back.y, 2);
    EXPECT_EQ(back.up, 3);
    // In generic code the name alone finds both.
    using abut::to_vec;
    EXPECT_EQ(to_vec(game::Vec3{1, 2, 3}), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace abut::test
