// A world with its shapes as a file.

#include "../oracle/seal.hpp"
#include "../shape/saved_shapes.hpp"
#include "support/bits.hpp"
#include "support/random_shapes.hpp"
#include <abut/shape/half_space.hpp>
#include <abut/world/file.hpp>

#include <string>

#include <gtest/gtest.h>

namespace abut::test {

namespace {

using oracle::Random;
using oracle::seal;

constexpr std::size_t checksum_sums = 8;

template <int D>
Pose<D> pose_nearby(Random& random) {
    Pose<D> pose{.position = {}, .rotation = random.rotation<D>()};
    for (int i = 0; i < D; ++i) pose.position[i] = random.uniform_float(-8, 8);
    return pose;
}

/// Shapes of every kind that a file can hold, some more than once, some of which moved, some removed.
template <int D>
World<D> random_world(Random& random) {
    World<D> world;
    const auto add = [&](const auto& shape) {
        ItemOptions<D> options{.pose = pose_nearby<D>(random), .user = static_cast<std::uint64_t>(world.size())};
        // Two levels, each of many parts, take long to test.
        options.fixed = random.chance(0.2) || std::holds_alternative<detail::Composite<D>>(View<D>(view(shape)));
        options.sensor = random.chance(0.1);
        options.continuous = random.chance(0.1);
        options.group = random.chance(0.1) ? -3 : 0;
        options.enabled = random.chance(0.9);
        world.add(shape, options);
    };
    Vec<D> up(0.0f);
    up[1] = 1;
    world.add(HalfSpace<D>{up, -3}, {.fixed = true});
    world.add(at(rounded(HalfSpace<D>{up, -3}, 0.25f), pose_nearby<D>(random)), {.fixed = true});
    for (int i = 0; i < 3; ++i) {
        add(Ball<D>{Vec<D>(0.0f), 0.5f});
        add(Box<D>{Vec<D>(0.1f), Vec<D>(0.5f), random.rotation<D>()});
        add(Capsule<D>{Vec<D>(0.0f), Vec<D>(0.4f), 0.3f});
        add(rounded(Segment<D>{Vec<D>(0.0f), up}, 0.125f));
        add(stretched(Ball<D>{Vec<D>(0.0f), 0.5f}, Vec<D>(0.5f) + up));
        if constexpr (D == 2) {
            add(random_shape<Polygon>(random));
            add(random_shape<Chain>(random));
            add(random_shape<TileMap>(random));
        } else {
            add(Cylinder{{0, 0, 0}, {0, 1, 0}, 0.5f});
            add(Cone{{0, 0, 0}, {0, 1, 0}, 0.5f});
            add(random_shape<Polyhedron>(random));
            add(random_shape<HeightField>(random));
            const Mesh mesh = random_shape<Mesh>(random);
            add(mesh);
            add(stretched(mesh, {1, 2, 1}));
        }
        add(random_shape<Compound<D>>(random));
        add(random_shape<SolidBsp<D>>(random));
    }
    world.update();
    std::vector<Id> ids;
    world.each_item([&](Id id) { ids.push_back(id); });
    for (const Id id : ids) {
        if (random.chance(0.3)) world.move(id, pose_nearby<D>(random));
        if (random.chance(0.1)) world.remove(id);
    }
    return world;
}

/// Changes a world and returns its answers.
template <int D>
Bits play(World<D>& world, std::uint64_t seed) {
    Random random(seed);
    Bits bits;
    for (int frame = 0; frame < 5; ++frame) {
        world.each_item([&](Id id) {
            if (!world.is_fixed(id) && random.chance(0.5)) world.move(id, pose_nearby<D>(random));
        });
        bits.put(world.add(Ball<D>{pose_nearby<D>(random).position, 0.5f}));
        const Events events = world.update();
        bits.put(events.began);
        bits.put(events.stayed);
        bits.put(events.ended);
        bits.put(world.contacts());
        bits.put(world.raycast_all(Ray<D>::between(pose_nearby<D>(random).position, pose_nearby<D>(random).position)));
    }
    return bits;
}

template <class Dimension>
class WorldFile : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WorldFile, Dimensions);

TYPED_TEST(WorldFile, IsTheSameWorldAgain) {
    constexpr int D = TypeParam::value;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        World<D> world = random_world<D>(random);
        const Result<Bytes> bytes = save_with_shapes(world);
        ASSERT_TRUE(bytes) << bytes.problem().message;
        Result<World<D>> loaded = load_world<D>(*bytes);
        ASSERT_TRUE(loaded) << loaded.problem().message;
        ASSERT_EQ(loaded->size(), world.size());
        ASSERT_EQ(loaded->save(), world.save());
        ASSERT_EQ(*save_with_shapes(*loaded), *bytes);
        ASSERT_EQ(play(*loaded, seed), play(world, seed));
        ASSERT_EQ(loaded->save(), world.save());
    }
}

TYPED_TEST(WorldFile, HoldsEachShapeOnce) {
    constexpr int D = TypeParam::value;
    Random random(1);
    const auto shape = random_shape<std::conditional_t<D == 2, Chain, Mesh>>(random);
    World<D> one, many;
    one.add(shape);
    for (int i = 0; i < 50; ++i) many.add(shape, {.pose = pose_nearby<D>(random)});
    EXPECT_LT(save_with_shapes(many)->size(), save_with_shapes(one)->size() + 50 * 64);
}

TYPED_TEST(WorldFile, RefusesDamage) {
    constexpr int D = TypeParam::value;
    Random random(2);
    World<D> world = random_world<D>(random);
    const Bytes bytes = *save_with_shapes(world);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64)
        ASSERT_FALSE(load_world<D>(std::span(bytes).first(size))) << size;
    std::size_t loaded_count = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 256) {
        Bytes damaged = bytes;
        damaged[i] ^= static_cast<std::byte>(1 << i % 8);
        const Result<World<D>> refused = load_world<D>(damaged);
        ASSERT_FALSE(refused) << i;
        ASSERT_EQ(refused.problem().code, ProblemCode::bad_format) << i;
        // With a right checksum it is refused, or it can be used.
        seal(damaged, checksum_sums);
        if (Result<World<D>> loaded = load_world<D>(damaged)) {
            ++loaded_count;
            loaded->update();
            loaded->raycast_any(Ray<D>::between(Vec<D>(-9.0f), Vec<D>(9.0f)));
        }
    }
    EXPECT_LT(loaded_count, 100u) << "the snapshot and most shapes have checksums of their own";
}

TYPED_TEST(WorldFile, NamesWhatItCantHold) {
    constexpr int D = TypeParam::value;
    World<D> world;
    world.add(Ball<D>{Vec<D>(0.0f), 1});
    world.add(Diamond<D>{Vec<D>(0.0f), 1});
    const Result<Bytes> bytes = save_with_shapes(world);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(bytes.problem().index, 2u);
    EXPECT_EQ(bytes.problem().message, "item 2 has a shape of a kind that can't be saved");
}

TEST(WorldFileOfAnother, SaysWhatItIs) {
    World2 world;
    const Bytes bytes = *save_with_shapes(world);
    EXPECT_TRUE(load_world<2>(bytes));
    EXPECT_EQ(load_world<3>(bytes).problem().message, "the file of a world has version 1 and dimension 2, not 1 and 3");
    EXPECT_EQ(load_world<2>(world.save()).problem().message, "this is not the file of a world: its signature is wrong");
    Bytes longer = bytes;
    longer.insert(longer.end() - 8, std::byte{0});
    seal(longer, checksum_sums);
    EXPECT_EQ(load_world<2>(longer).problem().message, "the file of a world has extra bytes at its end");
}

}  // namespace

}  // namespace abut::test
