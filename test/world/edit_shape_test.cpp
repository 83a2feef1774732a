// Levels that change: an edited shape gives the answers of one that is built anew, in every query and at the seams that
// the change made.

#include "../oracle/random.hpp"
#include "support/bits.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

namespace {

using oracle::Random;

constexpr std::uint64_t seed = 20261128;

/// A tile map, and the tiles that it should have.
struct ChangingTiles {
    using Level = TileMap;
    static constexpr int D = 2;
    static constexpr std::uint32_t columns = 23, rows = 9;

    /// The right half is empty at first, so that tiles are set outside of the blocks that had any.
    ChangingTiles() {
        for (std::uint32_t i = 0; i < tiles.size(); ++i)
            if (i % columns > columns / 2) tiles[i] = Tile::empty;
    }
    Level build() const { return *TileMap::build(tiles, columns, {0.75f, 0.5f}); }
    void change(Random& random, TileMap& map) {
        const auto index = static_cast<std::uint32_t>(random.uniform_float(0, columns * rows - 0.01));
        const Tile tile = random.chance(0.4)   ? Tile::empty
                          : random.chance(0.5) ? Tile::full
                                               : static_cast<Tile>(random.uniform_float(0, 13.99));
        tiles[index] = tile;
        map.set(index, tile);
    }
    static Vec2 extent() { return {columns * 0.75f, rows * 0.5f}; }

    std::vector<Tile> tiles = std::vector<Tile>(columns * rows, Tile::full);
};

/// A height field with holes, and the heights that it should have.
struct ChangingHeights {
    using Level = HeightField;
    static constexpr int D = 3;
    static constexpr std::uint32_t columns = 21, rows = 14;

    Level build() const {
        std::vector<std::uint32_t> list;
        for (std::uint32_t i = 0; i < holes.size(); ++i)
            if (holes[i]) list.push_back(i);
        return *HeightField::build(heights, columns, {0.75f, 0.5f}, {.holes = list});
    }
    void change(Random& random, HeightField& field) {
        if (random.chance(0.3)) {
            const auto cell = static_cast<std::uint32_t>(random.uniform_float(0, (columns - 1) * (rows - 1) - 0.01));
            holes[cell] = random.chance(0.5);
            field.set_hole(cell, holes[cell]);
            return;
        }
        const auto below = [&](std::uint32_t count) {
            return static_cast<std::uint32_t>(random.uniform_float(0, count - 0.01));
        };
        const std::uint32_t column = below(columns), row = below(rows),
                            width = 1 + below(std::min(4u, columns - column)),
                            height = 1 + below(std::min(4u, rows - row));
        std::vector<float> block;
        for (std::uint32_t j = 0; j < height; ++j)
            for (std::uint32_t i = 0; i < width; ++i) {
                block.push_back(random.chance(0.5) ? 0 : random.uniform_float(-1, 1));
                heights[column + i + (row + j) * columns] = block.back();
            }
        EXPECT_FALSE(field.set(column, row, width, block));
    }
    static Vec3 extent() { return {(columns - 1) * 0.75f, (rows - 1) * 0.5f, 1}; }

    std::vector<float> heights = std::vector<float>(columns * rows, 0);
    std::vector<bool> holes = std::vector<bool>((columns - 1) * (rows - 1), false);
};

/// A voxel map, and the voxels that should be solid. The upper half is empty at first.
struct ChangingVoxels {
    using Level = VoxelMap;
    static constexpr int D = 3;
    static constexpr std::uint32_t nx = 11, ny = 6, nz = 9, size = nx * ny * nz;

    ChangingVoxels() {
        for (std::uint32_t i = 0; i < size / 2; ++i) bits[i / 64] |= std::uint64_t{1} << i % 64;
    }
    Level build() const { return *VoxelMap::build(bits, {nx, ny, nz}, {0.75f, 0.5f, 0.6f}); }
    void change(Random& random, VoxelMap& map) {
        const std::uint32_t x = random.below(nx), y = random.below(ny), z = random.below(nz), i = x + nx * (y + ny * z);
        const bool solid = random.chance(0.5);
        if (map.at(x, y, z) != solid) bits[i / 64] ^= std::uint64_t{1} << i % 64;
        map.set(x, y, z, solid);
    }
    static Vec3 extent() { return {nx * 0.75f, ny * 0.5f, nz * 0.6f}; }

    std::vector<std::uint64_t> bits = std::vector<std::uint64_t>((size + 63) / 64);
};

/// A compound, and the children that it should have.
template <int Dimension>
struct ChangingChildren {
    using Level = Compound<Dimension>;
    static constexpr int D = Dimension;

    ChangingChildren() {
        Random random(seed);
        for (int i = 0; i < 30; ++i) children.push_back(child(random));
    }
    /// Where a child was removed, the compound is built with another one, which is removed.
    Level build() const {
        std::vector<AnyShape<D>> all;
        for (const auto& each : children) all.push_back(each.value_or(AnyShape<D>(Ball<D>{Vec<D>(0.0f), 1})));
        Level result = *Level::build(all);
        for (std::uint32_t i = 0; i < children.size(); ++i)
            if (!children[i]) result.remove(i);
        return result;
    }
    void change(Random& random, Level& level) {
        const std::uint32_t some = random.below(static_cast<std::uint32_t>(children.size()));
        const AnyShape<D> shape = child(random);
        if (children[some] && random.chance(0.5)) {
            level.remove(some);
            children[some].reset();
        } else if (children[some]) {
            EXPECT_FALSE(level.set(some, shape));
            children[some] = shape;
        } else {
            const std::uint32_t index = *level.add(shape);
            if (index == children.size()) children.emplace_back();
            children[index] = shape;
        }
    }
    static Vec<D> extent() { return Vec<D>(8.0f); }

    static AnyShape<D> child(Random& random) {
        const Vec<D> place = detail::to_float((random.in_cube<D>() + detail::DVec<D>(1.0)) * 4.0);
        if (random.chance(0.3)) return Ball<D>{place, random.uniform_float(0.2, 1)};
        return Box<D>{place, Vec<D>(random.uniform_float(0.2, 1)), random.rotation<D>()};
    }

    std::vector<std::optional<AnyShape<D>>> children;
};

template <class Changing>
Vec<Changing::D> point_in(Random& random) {
    Vec<Changing::D> point;
    for (int i = 0; i < Changing::D; ++i) point[i] = random.uniform_float(-0.5, Changing::extent()[i] + 0.5);
    return point;
}

/// The number of sides of a part.
template <class Level>
constexpr std::uint32_t sides = std::is_same_v<Level, TileMap>    ? 4
                                : std::is_same_v<Level, VoxelMap> ? 6
                                                                  : 3;

/// The parts, neighbours and bounds of a level.
template <class Level>
Bits parts_of(const Level& level) {
    Bits bits;
    bits.put(bounds(level).min);
    bits.put(bounds(level).max);
    // The order is that of the tree.
    std::vector<std::uint32_t> parts;
    each_part(level, bounds(level), [&](const auto&, std::uint32_t index) {
        parts.push_back(index);
        return true;
    });
    std::ranges::sort(parts);
    bits.put(parts);
    if constexpr (requires { part_neighbour(level, 0u, 0u); })
        for (const std::uint32_t part : parts)
            for (std::uint32_t side = 0; side < sides<Level>; ++side) bits.put(part_neighbour(level, part, side));
    return bits;
}

template <class Changing>
class EditShape : public testing::Test {};
using Kinds = testing::Types<ChangingTiles, ChangingHeights, ChangingVoxels, ChangingChildren<2>, ChangingChildren<3>>;
TYPED_TEST_SUITE(EditShape, Kinds);

TYPED_TEST(EditShape, OfALevelIsLikeBuildingIt) {
    constexpr int D = TypeParam::D;
    Random random(seed);
    TypeParam changing;
    auto level = changing.build();
    for (int step = 0; step < 300; ++step) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
        const auto before = level;
        const Bits old = parts_of(before);
        changing.change(random, level);
        ASSERT_EQ(parts_of(before), old) << "a copy changes too";
        const auto built = changing.build();
        ASSERT_EQ(parts_of(level), parts_of(built));
        const Vec<D> from = point_in<TypeParam>(random), to = point_in<TypeParam>(random);
        const auto ray = Ray<D>::between(from, to);
        ASSERT_EQ(Bits(raycast(ray, level)), Bits(raycast(ray, built)));
        const Box<D> box{from, Vec<D>(0.3f)};
        ASSERT_EQ(Bits(closest(box, level)), Bits(closest(box, built)));
        ASSERT_EQ(Bits(sweep(box, to - from, level)), Bits(sweep(box, to - from, built)));
    }
}

TYPED_TEST(EditShape, InAWorldIsLikeSettingTheShape) {
    constexpr int D = TypeParam::D;
    using Level = typename TypeParam::Level;
    Random random(seed);
    TypeParam changing;
    World<D> edited, set;
    const auto add = [&](const auto& shape, const ItemOptions<D>& options) {
        const Id id = edited.add(shape, options);
        EXPECT_EQ(set.add(shape, options), id);
        return id;
    };
    const Id level = add(changing.build(), {.fixed = true});
    std::vector<Id> crates;
    for (int i = 0; i < 40; ++i)
        crates.push_back(add(Box<D>{Vec<D>(0.0f), Vec<D>(0.4f)}, {.pose = {.position = point_in<TypeParam>(random)}}));
    std::size_t contacts = 0;
    for (int step = 0; step < 200; ++step) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
        // The world's own shape is not shared any more, so that it changes in place.
        ASSERT_TRUE(edited.template edit_shape<Level>(level, [&](Level& own) { changing.change(random, own); }));
        set.set_shape(level, changing.build());
        for (int i = 0; i < 3; ++i) {
            const Id crate = crates[static_cast<std::size_t>(random.uniform_float(0, 39.99))];
            const Pose<D> pose{.position = point_in<TypeParam>(random), .rotation = random.template rotation<D>()};
            edited.move(crate, pose);
            set.move(crate, pose);
        }
        const auto ray = Ray<D>::between(point_in<TypeParam>(random), point_in<TypeParam>(random));
        ASSERT_EQ(Bits(edited.raycast(ray)), Bits(set.raycast(ray)));
        const Events of_edited = edited.update(), of_set = set.update();
        ASSERT_EQ(Bits(of_edited.began, of_edited.stayed, of_edited.ended),
                  Bits(of_set.began, of_set.stayed, of_set.ended));
        ASSERT_EQ(Bits(edited.contacts()), Bits(set.contacts()));
        ASSERT_EQ(edited.save(), set.save());
        contacts += edited.contacts().size();
    }
    EXPECT_GT(contacts, 1000u);
}

TYPED_TEST(EditShape, LeavesCopiesAndSnapshotsAsTheyWere) {
    constexpr int D = TypeParam::D;
    using Level = typename TypeParam::Level;
    Random random(seed);
    TypeParam changing;
    const Level own = changing.build();
    World<D> world;
    const Id level = world.add(own, {.fixed = true});
    const AnyShape<D> shape = world.any_shape(level);
    const World<D> copy = world;
    const std::vector<std::byte> bytes = world.save();
    const auto hits = [](const auto& hit_of) {
        Random rays(seed);
        Bits bits;
        for (int i = 0; i < 50; ++i)
            bits.put(hit_of(Ray<D>::between(point_in<TypeParam>(rays), point_in<TypeParam>(rays))));
        return bits;
    };
    const auto in = [](const World<D>& in_world) { return [&](const Ray<D>& ray) { return in_world.raycast(ray); }; };
    const Bits old = hits(in(world));
    const Bits parts = parts_of(own);
    world.template edit_shape<Level>(level, [&](Level& changed) {
        for (int i = 0; i < 400; ++i) changing.change(random, changed);
    });
    EXPECT_NE(hits(in(world)), old);
    EXPECT_EQ(hits(in(copy)), old);
    EXPECT_EQ(parts_of(own), parts);
    EXPECT_EQ(hits([&](const Ray<D>& ray) { return raycast(ray, shape); }),
              hits([&](const Ray<D>& ray) { return raycast(ray, own); }));
    ASSERT_FALSE(world.restore(bytes));
    EXPECT_EQ(hits(in(world)), old);
}

TEST(EditShapeOfAWorld, NeedsTheShapesType) {
    World2 world;
    const Id box = world.add(Box2{{0, 0}, {1, 1}});
    bool is_called = false;
    EXPECT_FALSE(world.edit_shape<TileMap>(box, [&](TileMap&) { is_called = true; }));
    EXPECT_FALSE(is_called);
    EXPECT_TRUE(world.edit_shape<Box2>(box, [](Box2& own) { own.half = {3, 3}; }));
    EXPECT_EQ(world.containing({2.5f, 0}), std::vector<Id>{box});
}

/// A crate slides over a floor from which a tile is taken and into which it is put back.
TEST(EditShapeOfAWorld, MakesAndClosesSeams) {
    World2 world;
    const Id floor = world.add(*TileMap::build(std::vector<Tile>(10, Tile::full), 10, 1.f), {.fixed = true});
    const Id crate = world.add(Box2{{0, 0}, {0.5f, 0.5f}}, {.pose = {.position = {5.0f, 1.49f}}});
    const auto set = [&](Tile tile) { world.edit_shape<TileMap>(floor, [&](TileMap& map) { map.set(5, tile); }); };
    world.update();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_EQ(world.contacts()[0].contact.normal, Vec2(0, 1));
    EXPECT_NEAR(
        std::abs(world.contacts()[0].contact.points[0].position.x - world.contacts()[0].contact.points[1].position.x),
        1, 1e-5);
    // Now the right half of the crate is over a gap.
    set(Tile::empty);
    world.update();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_NEAR(
        std::abs(world.contacts()[0].contact.points[0].position.x - world.contacts()[0].contact.points[1].position.x),
        0.5, 1e-5);
    // The crate sinks into the gap: now the sides of the tiles around it are no internal edges.
    world.move(crate, {.position = {5.51f, 0.9f}});
    world.update();
    ASSERT_GE(world.contacts().size(), 1u);
    for (const auto& contact : world.contacts()) EXPECT_EQ(std::abs(contact.contact.normal.x), 1);
    set(Tile::full);
    world.move(crate, {.position = {5.5f, 1.49f}});
    world.update();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_EQ(world.contacts()[0].contact.normal, Vec2(0, 1));
}

/// Twenty crates on a floor of tiles. Pairs are tested again where the floor has changed, and all if it was replaced.
TEST(EditShapeOfAWorld, TestsAgainWhatIsNear) {
    const TileMap flat = *TileMap::build(std::vector<Tile>(100, Tile::full), 100, 1.f);
    World2 world;
    const Id floor = world.add(flat, {.fixed = true});
    for (int i = 0; i < 20; ++i) world.add(Box2{{5.0f * static_cast<float>(i) + 2.3f, 1.49f}, {0.5f, 0.5f}});
    world.update();
    const auto tested_after = [&](const auto& edit) {
        EXPECT_TRUE(world.edit_shape<TileMap>(floor, edit));
        world.update();
        EXPECT_EQ(world.counts().near, 20u);
        return world.counts().tested;
    };
    EXPECT_EQ(tested_after([](TileMap&) {}), 0u);
    EXPECT_EQ(tested_after([](TileMap& map) { map.set(12, Tile::empty); }), 1u);  // crate 2 is above
    EXPECT_EQ(tested_after([](TileMap& map) { map.set(15, Tile::empty); }), 0u);
    EXPECT_EQ(tested_after([](TileMap& map) {
                  map.set(12, Tile::full);
                  map.set(22, Tile::empty);
              }),
              3u);  // the box of both changes
    EXPECT_EQ(tested_after([&](TileMap& map) { map = flat; }), 20u);
    world.edit_shape<TileMap>(floor, [](TileMap& map) { map.set(12, Tile::empty); });
    EXPECT_EQ(tested_after([](TileMap& map) { map.set(17, Tile::empty); }), 2u);
    EXPECT_EQ(world.contacts().size(), 20u);
    // A change of its extent tests all again, and so does a motion.
    EXPECT_EQ(tested_after([](TileMap& map) { map.set(99, Tile::empty); }), 20u);
    world.edit_shape<TileMap>(floor, [](TileMap& map) { map.set(12, Tile::full); });
    world.move(floor, {.position = {0, 0.001f}});
    world.update();
    EXPECT_EQ(world.counts().tested, 20u);
}

/// The parts of a mesh as children: a crate on the seam between two of them, of which one is switched off and moved.
TEST(EditShapeOfAWorld, SwitchesTheMeshesOfACompound) {
    const Mesh square = *Mesh::build(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                                     std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
    const Pose3 beside{.position = {4, 0, 0}};
    World3 world;
    const Id floor = world.add(*Compound3::build({square, at(square, beside)}), {.fixed = true});
    world.add(Box3{{0, 0, 0}, Vec3(0.5f)}, {.pose = {.position = {4, 2, 0.49f}}});
    const auto expect_width = [&](float width) {
        world.update();
        ASSERT_EQ(world.contacts().size(), 1u);
        const Contact<3>& contact = world.contacts()[0].contact;
        EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
        ASSERT_EQ(contact.points.size(), 4u);
        float low = 100, high = -100;
        for (const auto& point : contact.points) {
            low = std::min(low, point.position.x);
            high = std::max(high, point.position.x);
        }
        EXPECT_NEAR(high - low, width, 1e-5);
    };
    const auto edit = [&](const auto& change) { ASSERT_TRUE(world.edit_shape<Compound3>(floor, change)); };
    expect_width(1);
    edit([](Compound3& level) { level.remove(1); });
    expect_width(0.5f);
    edit([&](Compound3& level) { EXPECT_FALSE(level.set(1, square, beside)); });
    expect_width(1);
    edit([](Compound3& level) { EXPECT_FALSE(level.move(1, {.position = {4.25f, 0, 0}})); });
    expect_width(1);  // a slit
    edit([](Compound3& level) { EXPECT_FALSE(level.move(1, {.position = {4, 0, -1}})); });
    expect_width(0.5f);
    edit([&](Compound3& level) { EXPECT_FALSE(level.move(1, beside)); });
    expect_width(1);
}

TEST(HeightField, SetTellsWhatIsWrong) {
    HeightField field = *HeightField::build(std::vector<float>(12, 1), 4, 1.f);
    const std::vector<float> six(6, 0);
    EXPECT_EQ(field.set(0, 0, 4, six)->code, ProblemCode::bad_argument);
    EXPECT_EQ(field.set(0, 0, 0, six)->code, ProblemCode::bad_argument);
    EXPECT_EQ(field.set(2, 0, 3, six)->code, ProblemCode::index_out_of_range);
    EXPECT_EQ(field.set(0, 2, 3, six)->code, ProblemCode::index_out_of_range);
    EXPECT_EQ(field.set(4'000'000'000, 0, 3, six)->code, ProblemCode::index_out_of_range);
    std::vector<float> wrong = six;
    wrong[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(field.set(0, 0, 3, wrong)->code, ProblemCode::not_finite);
    EXPECT_EQ(field.set(0, 0, 3, wrong)->index, 4u);
    EXPECT_EQ(field.heights()[0], 1);
    EXPECT_FALSE(field.set(1, 1, 3, six));
    EXPECT_EQ(field.heights()[5], 0);
    EXPECT_FALSE(field.set(0, 0, 3, {}));
}

}  // namespace

}  // namespace abut::test
