// Distance functions and fields among the shapes of a world: every query, with every kind of shape.

#include "../query/user_functions.hpp"
#include <abut/bake/field.hpp>
#include <abut/draw/draw.hpp>
#include <abut/motion/depenetrate.hpp>
#include <abut/motion/laser.hpp>
#include <abut/motion/mover.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <class T>
class FunctionWorld : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FunctionWorld, Dimensions);

template <int D>
Vec<D> at_height(double height) {
    return to_float(axis<D>(1, height));
}
template <int D>
Pose<D> pose_at(double height) {
    Pose<D> result;
    result.position = at_height<D>(height);
    return result;
}
/// A box as a field whose samples lie on the box's sides.
template <int D>
Field<D> field_of_box(const Vec<D>& half, float cell) {
    return *bake_field(Box<D>{Vec<D>(0.0f), half}, FieldOptions<D>{.cell = cell});
}
template <int D>
AnyShape<D> level() {
    if constexpr (D == 2)
        return *Chain::build({{-4, 0.5f}, {0, -0.5f}, {4, 0.5f}}, false);
    else {
        // The triangles of the height field face up.
        const float half = std::sqrt(0.5f);
        const std::vector<float> heights{0.5f, 0.5f, 0.5f, 0.5f, -0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
        return at(*HeightField::build(heights, 3, 4), Pose3{{-4, 0, 4}, {half, -half, 0, 0}});
    }
}

template <int D>
struct Drawing final : Canvas<D> {
    Aabb<D> shown() const override { return {Vec<D>(-4.0f), Vec<D>(4.0f)}; }
    void line(const Vec<D>& a, const Vec<D>& b, const Style&) override {
        points.push_back(a);
        points.push_back(b);
    }
    void point(const Vec<D>&, const Style&) override {}
    void polygon(std::span<const Vec<D>> corners, const Style&) override {
        points.insert(points.end(), corners.begin(), corners.end());
    }
    std::vector<Vec<D>> points;
};

/// All queries about all pairs are finite, and related queries agree.
TYPED_TEST(FunctionWorld, EveryKindBesideEveryKind) {
    constexpr int D = TypeParam::value;
    const Field<D> field = field_of_box<D>(Vec<D>(1.0f), 0.25f);
    const std::vector<AnyShape<D>> shapes{Ball<D>{Vec<D>(0.0f), 1},
                                          Box<D>{Vec<D>(0.0f), Vec<D>(1.0f)},
                                          HalfSpace<D>{at_height<D>(1), 0},
                                          level<D>(),
                                          users::Pill<D>{at_height<D>(-1), at_height<D>(1), 0.5f},
                                          field,
                                          rounded(field, 0.25f)};
    int pairs = 0;
    for (const AnyShape<D>& a : shapes)
        for (const AnyShape<D>& b : shapes) {
            const auto index = [](const AnyShape<D>& shape) { return shape.view().index(); };
            if (index(a) == 1 && index(b) == 1) continue;
            if (index(a) != 3 && index(b) != 3) continue;
            ++pairs;
            SCOPED_TRACE(testing::Message() << index(a) << " beside " << index(b) << ", pair " << pairs);
            const auto lower = at(a, pose_at<D>(-0.125));
            const Closest<D> nearest = closest(lower, b);
            EXPECT_LE(nearest.distance, 0);
            EXPECT_TRUE(overlaps(lower, b));
            const Contact<D> contact = abut::contact(lower, b);
            EXPECT_TRUE(contact);
            int contacts = 0;
            each_contact(lower, b, [&](const Contact<D>&) { ++contacts; });
            EXPECT_GE(contacts, 1);
            EXPECT_GE(certify(lower, b, nearest).margin, 0);
            // The motion starts far above and goes down.
            if (index(a) != 1) {
                const auto high = at(a, pose_at<D>(12));
                EXPECT_TRUE(sweep(high, at_height<D>(-12), b));
                EXPECT_TRUE(sweep(b, at_height<D>(12), high));
                EXPECT_TRUE(sweep(a, pose_at<D>(12), pose_at<D>(0), b, Pose<D>{}, Pose<D>{}));
                EXPECT_GT(closest(high, b).distance, 1);
            }
            // A world returns the answer of the query function.
            World<D> world;
            const Id id_a = world.add(a, {.pose = pose_at<D>(-0.125)}), id_b = world.add(b);
            EXPECT_EQ(world.update().began.size(), 1u);
            EXPECT_EQ(world.contacts().size(), static_cast<std::size_t>(contacts));
            world.move(id_a, pose_at<D>(0.125));
            world.update();
            EXPECT_TRUE(world.contains(id_b));
        }
    EXPECT_EQ(pairs, 33);
}

TYPED_TEST(FunctionWorld, QueriesOfAWorld) {
    constexpr int D = TypeParam::value;
    World<D> world;
    const Id ground = world.add(users::Hills<D>{0.2f}, {.fixed = true});
    const Id rock = world.add(field_of_box<D>(Vec<D>(0.5f), 0.125f), {.pose = pose_at<D>(4)});
    const Id ball = world.add(Ball<D>{Vec<D>(0.0f), 0.25f}, {.pose = pose_at<D>(0.2)});
    const auto events = world.update();
    ASSERT_EQ(events.began.size(), 1u);
    EXPECT_EQ(events.began[0], (IdPair{ground, ball}));
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_GT(world.contacts()[0].contact.normal[1], 0.9f);

    const Ray<D> down{at_height<D>(8), at_height<D>(-1), 100};
    const auto hit = world.raycast(down);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id, rock);
    EXPECT_NEAR(hit->hit.distance, 3.5f, 1e-4f);
    EXPECT_EQ(world.raycast_all(down).size(), 3u);
    EXPECT_TRUE(world.raycast_any(down));
    EXPECT_EQ(world.containing(at_height<D>(-1)), std::vector<Id>{ground});
    EXPECT_EQ(world.containing(at_height<D>(4)), std::vector<Id>{rock});
    EXPECT_EQ(world.overlapping(Ball<D>{at_height<D>(3.4), 0.2f}), std::vector<Id>{rock});
    const auto nearest = world.closest(at_height<D>(3));
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->id, rock);
    EXPECT_NEAR(nearest->closest.distance, 0.5f, 1e-4f);
    const auto swept = world.sweep(Box<D>{at_height<D>(2), Vec<D>(0.125f)}, at_height<D>(4));
    ASSERT_TRUE(swept);
    EXPECT_EQ(swept->id, rock);
    EXPECT_NEAR(swept->hit.distance, 1.375f, 1e-3f);

    // A continuous item passes through the ground.
    const Id bullet = world.add(Ball<D>{Vec<D>(0.0f), 0.05f}, {.pose = pose_at<D>(2), .continuous = true});
    world.update();
    world.move(bullet, pose_at<D>(-3));
    bool hit_ground = false;
    for (const IdPair& pair : world.update().began) hit_ground = hit_ground || pair == IdPair{ground, bullet};
    EXPECT_TRUE(hit_ground);

    // Functions that query the world agree.
    const Depenetration<D> out = depenetrate(Ball<D>{at_height<D>(-0.1), 0.25f}, world, {.ignore = ball});
    EXPECT_TRUE(out);
    EXPECT_GT(out.push[1], 0.2f);
    Laser<D> laser(world, Ray<D>{at_height<D>(2), at_height<D>(-1), 100}, {.ignore = ball});
    ASSERT_TRUE(laser.hit());
    EXPECT_EQ(laser.hit()->id, ground);
    laser.bounce();

    Drawing<D> drawing;
    draw(drawing, world);
    EXPECT_GT(drawing.points.size(), 100u);
}

/// A mover walks over hills and stays on the ground.
TYPED_TEST(FunctionWorld, AMoverOnHills) {
    constexpr int D = TypeParam::value;
    World<D> world;
    const users::Hills<D> hills{0.2f};
    world.add(hills, {.fixed = true});
    world.update();
    Mover<D> mover;
    const Capsule<D> body{at_height<D>(-0.3), at_height<D>(0.3), 0.2f};
    Pose<D> pose = pose_at<D>(1.5);
    bool grounded = false;
    for (int i = 0; i < 60; ++i) {
        Vec<D> motion(0.0f);
        motion[0] = 0.05f;
        motion[1] = -0.1f;
        const Moved<D> moved = mover.move(world, body, pose.position, motion);
        EXPECT_FALSE(moved.crushed);
        pose.position = moved.position;
        grounded = moved.grounded;
        EXPECT_GT(closest(at(body, pose), hills).distance, -1e-3f);
    }
    EXPECT_TRUE(grounded);
    EXPECT_GT(pose.position[0], 1.5f);
    EXPECT_LT(closest(at(body, pose), hills).distance, 0.1f);
}

/// A compound's child must have convex parts.
TYPED_TEST(FunctionWorld, NoChildOfACompound) {
    constexpr int D = TypeParam::value;
    const auto built = Compound<D>::build({Ball<D>{}, field_of_box<D>(Vec<D>(1.0f), 0.5f)});
    ASSERT_FALSE(built);
    EXPECT_EQ(built.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(built.problem().index, 1u);
}

/// The vertices of the drawn outline have distance 0.
TYPED_TEST(FunctionWorld, DrawnWhereItIsZero) {
    constexpr int D = TypeParam::value;
    const users::Blob<D> blob{Vec<D>(0.5f), 1.5f};
    Drawing<D> drawing;
    draw(drawing, blob);
    EXPECT_GT(drawing.points.size(), 200u);
    for (const Vec<D>& point : drawing.points) EXPECT_NEAR(signed_distance(blob, point), 0.0f, 0.01f);
}

}  // namespace
}  // namespace abut
