// A mover in levels that are distance functions, baked or user-defined: it stands on the floor while it is pressed
// against a wall.

#include <abut/bake/field.hpp>
#include <abut/math/dvec.hpp>
#include <abut/motion/mover.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/placed.hpp>

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D>
Box<D> block(const Vec<D>& low, const Vec<D>& high) {
    Box<D> result;
    result.center = 0.5f * (low + high);
    result.half = 0.5f * (high - low);
    return result;
}
template <int D>
Vec<D> with_height(const Vec<D>& v, float height) {
    Vec<D> result = v;
    result[1] = height;
    return result;
}

/// A floor at height 0 as far as 3 from the origin, walls from x = 2 on and, in space, from z = 2 on as well.
template <int D>
std::vector<Box<D>> room() {
    const Vec<D> low(-3.0f), high(3.0f);
    std::vector<Box<D>> result{block<D>(with_height<D>(low, -1), with_height<D>(high, 0))};
    for (int axis = 0; axis < D; axis += 2) {
        Vec<D> corner = with_height<D>(low, -1);
        corner[axis] = 2;
        result.push_back(block<D>(corner, high));
    }
    return result;
}

/// The room as a distance function: the minimum over the boxes, which is a bound inside several.
template <int D>
struct OwnRoom {
    std::vector<Box<D>> boxes = room<D>();
};
template <int D>
Aabb<D> bounds(const OwnRoom<D>&) {
    return {with_height<D>(Vec<D>(-3.0f), -1), Vec<D>(3.0f)};
}
template <int D>
float signed_distance(const OwnRoom<D>& own, const Vec<D>& point) {
    float result = std::numeric_limits<float>::infinity();
    for (const Box<D>& box : own.boxes) result = std::min(result, closest(box, point).distance);
    return result;
}

template <int D>
AnyShape<D> compound() {
    const std::vector<Box<D>> boxes = room<D>();
    return *Compound<D>::build(std::vector<AnyShape<D>>(boxes.begin(), boxes.end()));
}
template <int D>
AnyShape<D> baked(float cell) {
    return *bake_field(*Compound<D>::build([] {
        const std::vector<Box<D>> boxes = room<D>();
        return std::vector<AnyShape<D>>(boxes.begin(), boxes.end());
    }()),
                       FieldOptions<D>{.cell = cell});
}

template <int D>
Pose<D> turned_by(float angle) {
    Pose<D> result;
    if constexpr (D == 2)
        result.rotation = Turn::by(angle);
    else
        result.rotation = turn_about({0, 1, 0}, angle);
    return result;
}

struct Walk {
    int not_grounded = 0, not_at_rest = 0, overlapping = 0;
    float height = 0, gap = 0;  ///< at the end: above the floor, and from the wall
};

/// Moves the shape into the wall for 600 frames, with the level at `pose`. The shape's lowest point is `below` its
/// position, and its front is `ahead` of it.
template <int D, class S>
Walk walk(const AnyShape<D>& level, const Pose<D>& pose, const S& shape, float below, float ahead,
          const Vec<D>& motion_of_level) {
    World<D> world;
    const Id id = world.add(level, {.pose = pose, .fixed = true});
    MoverOptions<D> options;
    options.up = rotate(pose.rotation, with_height<D>(Vec<D>(0.0f), 1));
    Mover<D> mover(options);
    Vec<D> position = pose * with_height<D>(Vec<D>(0.0f), below + 0.1f);
    Moved<D> moved;
    for (int i = 0; i < 30; ++i) {
        moved = mover.move(world, shape, position, -0.02f * options.up);
        position = moved.position;
    }
    Walk result;
    const Vec<D> motion = rotate(pose.rotation, motion_of_level);
    for (int i = 0; i < 600; ++i) {
        const Vec<D> before = position;
        moved = mover.move(world, shape, position, motion);
        position = moved.position;
        result.not_grounded += moved.grounded && moved.ground.id == id && moved.ground.is_ground ? 0 : 1;
        result.overlapping += world.overlapping(at(shape, Pose<D>{position})).empty() ? 0 : 1;
        if (i >= 300) result.not_at_rest += length(DVec<D>(position) - DVec<D>(before)) <= 1e-4 ? 0 : 1;
    }
    const Vec<D> own = inverse(pose) * position;
    result.height = own[1] - below;
    result.gap = 2 - own[0] - ahead;
    return result;
}

template <class Dimension>
class MoverOnFields : public testing::Test {
protected:
    static constexpr int D = Dimension::value;

    static Vec<D> ahead(float speed, float fall) {
        Vec<D> result(0.0f);
        result[0] = speed;
        result[1] = -fall;
        return result;
    }
    static Capsule<D> hero() { return {with_height<D>(Vec<D>(0.0f), -0.5f), with_height<D>(Vec<D>(0.0f), 0.5f), 0.5f}; }
    static Box<D> crate() {
        Box<D> result;
        result.half = with_height<D>(Vec<D>(0.4f), 1);
        return result;
    }
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MoverOnFields, Dimensions);

// Regression: a mover wasn't grounded in up to 583 of the 600 frames, because a field has one part, and only the
// closest point of a part was used.
TYPED_TEST(MoverOnFields, PressedToAWallItIsGrounded) {
    static constexpr int N = TestFixture::D;
    const std::array<std::pair<const char*, AnyShape<N>>, 3> levels{
        {{"compound", compound<N>()}, {"field of 0.25", baked<N>(0.25f)}, {"own function", OwnRoom<N>{}}}};
    for (const auto& [name, level] : levels)
        for (const auto& [speed, fall] : {std::pair(0.02f, 0.0f), std::pair(0.1f, 0.02f)}) {
            SCOPED_TRACE(name + std::string(", speed ") + std::to_string(speed) + ", fall " + std::to_string(fall));
            const Vec<N> motion_of_level = this->ahead(speed, fall);
            for (const bool is_ball : {false, true}) {
                if (!is_ball && name == std::string("own function")) continue;
                const Walk round = is_ball
                                       ? walk<N>(level, {}, Ball<N>{Vec<N>(0.0f), 0.5f}, 0.5f, 0.5f, motion_of_level)
                                       : walk<N>(level, {}, this->hero(), 1, 0.5f, motion_of_level);
                EXPECT_EQ(round.not_grounded, 0) << is_ball;
                EXPECT_EQ(round.not_at_rest, 0) << is_ball;
                EXPECT_EQ(round.overlapping, 0) << is_ball;
                // In the corner, the field's distance is rounded by less than a quarter of a cell.
                EXPECT_NEAR(round.height, 0.03, 0.03) << is_ball;
                EXPECT_NEAR(round.gap, 0.03, 0.03) << is_ball;
            }
            if (name == std::string("own function")) continue;  // a search for each step: slow
            const Walk box = walk<N>(level, {}, this->crate(), 1, 0.4f, motion_of_level);
            EXPECT_EQ(box.not_grounded, 0);
            EXPECT_EQ(box.not_at_rest, 0);
            EXPECT_EQ(box.overlapping, 0);
            EXPECT_NEAR(box.height, 0.03, 0.03);
            EXPECT_NEAR(box.gap, 0.03, 0.03);
        }
}

TYPED_TEST(MoverOnFields, ATurnedLevelIsNoOther) {
    static constexpr int N = TestFixture::D;
    const AnyShape<N> level = baked<N>(0.1f);
    for (const float angle : {0.3f, 0.785f, 2.0f}) {
        const Ball<N> ball{Vec<N>(0.0f), 0.5f};
        const Walk turned = walk<N>(level, turned_by<N>(angle), ball, 0.5f, 0.5f, this->ahead(0.05f, 0.02f));
        EXPECT_EQ(turned.not_grounded, 0) << angle;
        EXPECT_EQ(turned.not_at_rest, 0) << angle;
        EXPECT_NEAR(turned.height, 0.03, 0.03) << angle;
        EXPECT_NEAR(turned.gap, 0.03, 0.03) << angle;
    }
}

/// A mover that slides along a wall into the corner of two walls comes to rest on the floor.
TEST(MoverOnFields3, InACornerOfTwoWallsItIsGrounded) {
    const Capsule3 hero{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.5f};
    const Box3 crate{{0, 0, 0}, {0.4f, 1, 0.4f}};
    for (const AnyShape<3>& level : {compound<3>(), baked<3>(0.25f)}) {
        const Walk round = walk<3>(level, {}, hero, 1, 0.5f, {0.05f, -0.02f, 0.03f});
        EXPECT_EQ(round.not_grounded, 0);
        EXPECT_EQ(round.not_at_rest, 0);
        EXPECT_NEAR(round.height, 0.03, 0.03);
        const Walk box = walk<3>(level, {}, crate, 1, 0.4f, {0.05f, -0.02f, 0.03f});
        EXPECT_EQ(box.not_grounded, 0);
        EXPECT_EQ(box.not_at_rest, 0);
    }
}

/// Floor and wall of one field are separate touches.
TYPED_TEST(MoverOnFields, TouchesFloorAndWall) {
    static constexpr int N = TestFixture::D;
    World<N> world;
    const Id id = world.add(baked<N>(0.1f), {.fixed = true});
    Mover<N> mover;
    Vec<N> position = with_height<N>(Vec<N>(0.0f), 1.1f);
    Moved<N> moved;
    for (int i = 0; i < 60; ++i) {
        moved = mover.move(world, this->hero(), position, this->ahead(0.1f, 0.02f));
        position = moved.position;
    }
    int floors = 0, walls = 0;
    for (const MoverTouch<N>& touch : moved.touches) {
        EXPECT_EQ(touch.id, id);
        if (touch.normal[1] > 0.99f) {
            ++floors;
            EXPECT_TRUE(touch.is_ground);
            EXPECT_NEAR(touch.point[1], 0, 1e-3);
        } else if (touch.normal[0] < -0.99f && std::abs(touch.point[0] - 2) < 1e-3f) {
            ++walls;
            EXPECT_FALSE(touch.is_ground);
        }
    }
    EXPECT_EQ(floors, 1);
    EXPECT_EQ(walls, 1);
    EXPECT_NEAR(moved.ground.normal[1], 1, 1e-3);
    EXPECT_NEAR(moved.motion[0], 0, 1e-5);
    EXPECT_NEAR(moved.motion[1], 0, 1e-5);
}

/// A mover leaves the corner freely, without state from it.
TYPED_TEST(MoverOnFields, WalksAwayFromTheWall) {
    static constexpr int N = TestFixture::D;
    World<N> world;
    world.add(baked<N>(0.1f), {.fixed = true});
    Mover<N> mover;
    Vec<N> position = with_height<N>(Vec<N>(0.0f), 1.1f);
    for (int i = 0; i < 90; ++i) {
        const float speed = i < 60 ? 0.1f : -0.1f;
        const Moved<N> moved = mover.move(world, this->hero(), position, this->ahead(speed, 0.02f));
        if (i >= 60) {
            EXPECT_NEAR(moved.position[0], position[0] - 0.1f, 0.03) << i;
            EXPECT_TRUE(moved.grounded) << i;
        }
        position = moved.position;
    }
    EXPECT_NEAR(position[1], 1.005, 0.01);
}

}  // namespace
}  // namespace abut
