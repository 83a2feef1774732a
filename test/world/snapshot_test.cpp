// A restored world and a copy answer as the world that was saved.

#include "../broad_phase/allocations.hpp"
#include "support/bits.hpp"
#include "support/simulation.hpp"
#include <abut/shape/detail/content_hash.hpp>
#include <abut/shape/mesh.hpp>

#include <set>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// Plays some frames and returns all answers that have an order.
template <int D>
Bits play(Simulation<D>& game, int frames) {
    Bits result;
    for (int frame = 0; frame < frames; ++frame) {
        game.change();
        if (game.random().chance(0.3)) continue;  // two changes of an item before an update
        const Events events = game.world.update();
        result.put(events.began);
        result.put(events.stayed);
        result.put(events.ended);
        for (const float fraction : events.fractions) result.put(fraction);
        result.put(game.world.contacts());
        result.put(game.world.impacts());
        const Vec<D> from = game.any_point(), to = game.any_point();
        const Filter filter = game.filter();
        result.put(game.world.raycast_all(Ray<D>::between(from, to), filter));
        result.put(game.world.closest(from, filter));
        result.put(game.world.overlapping(Ball<D>{to, 1}, filter));
        const Id id = game.any_id();
        result.put(game.world.touching(id));
        result.put(static_cast<std::uint32_t>(game.world.user(id)));
    }
    return result;
}

template <int D>
void expect_the_same_future(std::uint64_t seed, double continuous) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation<D> game(seed, 40, seed % 4 == 0, {}, continuous);
    game.with_all = true;
    (void)play(game, 10 + static_cast<int>(seed % 3));
    if (seed % 2 == 0) game.change();
    const std::vector<std::byte> bytes = game.world.save();
    Simulation<D> copy = game, restored = game;
    const Bits expected = play(game, 15);

    EXPECT_TRUE(play(copy, 15) == expected);
    EXPECT_EQ(copy.world.save(), game.world.save());

    restored.world = game.world;
    const std::optional<Problem> problem = restored.world.restore(bytes);
    ASSERT_FALSE(problem) << problem->message;
    restored.world.set_pair_filter(restored.reference.pair_filter);
    EXPECT_EQ(restored.world.size(), restored.reference.items().size());
    EXPECT_EQ(restored.world.save(), bytes);
    EXPECT_TRUE(play(restored, 15) == expected);
    EXPECT_EQ(restored.world.save(), game.world.save());
}

TEST(Snapshot, HasTheSameFuture) {
    for (std::uint64_t seed = 500; seed < 540; ++seed) {
        expect_the_same_future<2>(seed, seed % 3 == 0 ? 0.2 : 0);
        expect_the_same_future<3>(seed, seed % 3 == 0 ? 0.2 : 0);
    }
}

TEST(Snapshot, GivesBackTheIds) {
    World2 world;
    const Id crate = world.add(Box2{{0, 0}, {1, 1}}, {.user = 7}), bullet = world.add(Circle{{5, 0}, 0.1f});
    world.update();
    const std::vector<std::byte> bytes = world.save();
    world.remove(bullet);
    const Id later = world.add(Capsule2{{0, 0}, {1, 0}, 0.2f});
    world.set_user(crate, 8);
    ASSERT_FALSE(world.restore(bytes));
    EXPECT_TRUE(world.contains(bullet));
    EXPECT_FALSE(world.contains(later));
    EXPECT_EQ(world.user(crate), 7u);
    EXPECT_EQ(world.size(), 2u);
    EXPECT_TRUE(world.raycast({{5, 5}, {0, -1}}));
    // The same call gives the same id again.
    world.remove(bullet);
    EXPECT_EQ(world.add(Capsule2{{0, 0}, {1, 0}, 0.2f}), later);
}

TEST(Snapshot, FitsAnotherWorldOfTheSameShapes) {
    Simulation<3> game(77, 30), other(77, 30);
    for (int frame = 0; frame < 5; ++frame)
        for (const Id id : game.all_ids()) game.move(id, game.any_pose());
    game.world.update();
    const std::vector<std::byte> bytes = game.world.save();
    ASSERT_FALSE(other.world.restore(bytes));
    EXPECT_EQ(other.world.save(), bytes);
}

TEST(Snapshot, HoldsReleasedShapesUpToALimit) {
    for (const std::size_t limit : {0u, 1u, 2u}) {
        World3 world({.max_released_shapes = limit});
        const Id first = world.add(Sphere{{0, 0, 0}, 1}), second = world.add(Sphere{{0, 0, 0}, 2});
        const std::vector<std::byte> bytes = world.save();
        world.set_shape(first, Box3{{0, 0, 0}, {1, 1, 1}});
        world.remove(second);
        const std::vector<std::byte> before = world.save();
        const std::optional<Problem> problem = world.restore(bytes);
        if (limit == 2) {
            EXPECT_FALSE(problem);
            EXPECT_TRUE(world.contains(second));
        } else {
            ASSERT_TRUE(problem);
            EXPECT_EQ(problem->code, ProblemCode::not_found);
            EXPECT_EQ(problem->index, first.index);
            EXPECT_EQ(problem->message, "a snapshot needs the shape of item 1, which this world has not");
            EXPECT_EQ(world.save(), before);
        }
    }
}

TEST(Snapshot, RefusesDamagedBytes) {
    Simulation<2> game(9, 12);
    (void)play(game, 6);
    const std::vector<std::byte> bytes = game.world.save();
    game.change();
    const std::vector<std::byte> before = game.world.save();
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_TRUE(game.world.restore(std::span(bytes).first(size))) << size;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::byte> damaged = bytes;
        damaged[i] ^= std::byte{static_cast<unsigned char>(1u << i % 8)};
        const std::optional<Problem> problem = game.world.restore(damaged);
        ASSERT_TRUE(problem) << i;
        EXPECT_EQ(problem->code, ProblemCode::bad_format);
    }
    const std::optional<Problem> problem = World3().restore(bytes);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->message, "a snapshot of a world has version 2 and dimension 2, not 2 and 3");
    EXPECT_EQ(game.world.save(), before);
    EXPECT_FALSE(game.world.restore(bytes));
}

TEST(Snapshot, IsSmall) {
    World3 world;
    std::vector<Id> ids;
    for (int i = 0; i < 100; ++i)
        ids.push_back(world.add(Sphere{{0, 0, 0}, 0.5f}, {.pose = {{static_cast<float>(i), 0, 0}}}));
    world.update();
    std::vector<std::byte> bytes = world.save();
    EXPECT_EQ(bytes.size(), 52u + 60 * 100 + 8 * 99);
    const std::size_t before = allocations();
    world.save(bytes);
    EXPECT_EQ(allocations(), before);
}

TEST(ContentHash, DiffersForDifferentShapes) {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<Vec3> others{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    const std::vector<glm::uvec3> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const auto mesh = Mesh::build(corners, triangles);
    const std::vector<AnyShape<3>> shapes{Sphere{{0, 0, 0}, 1},
                                          Sphere{{0, 0, 0}, 2},
                                          Capsule3{{0, 0, 0}, {0, 0, 0}, 1},
                                          Box3{{0, 0, 0}, {1, 1, 1}},
                                          Box3{{0, 0, 0}, {1, 1, 2}},
                                          *Polyhedron::build(corners),
                                          *Polyhedron::build(others),
                                          *mesh,
                                          *Mesh::build(others, triangles),
                                          HalfSpace3{{0, 1, 0}, 0},
                                          HalfSpace3{{0, 1, 0}, 1}};
    std::set<std::uint64_t> hashes;
    for (const AnyShape<3>& shape : shapes) hashes.insert(content_hash(shape.view()));
    EXPECT_EQ(hashes.size(), shapes.size());
    EXPECT_TRUE(hashes.contains(content_hash(View<3>(view(*mesh)))));
}

}  // namespace
}  // namespace abut::test
