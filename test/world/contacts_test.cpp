// Contacts of a world as whole manifolds, and those of a query shape.

#include "../oracle/random.hpp"
#include "support/bits.hpp"
#include "support/random_shapes.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TileMap row_of_tiles(std::uint32_t count) {
    return *TileMap::build(std::vector<Tile>(count, Tile::full), count, 1.0f);
}

template <int D>
double extent(const Contact<D>& contact) {
    double result = 0;
    for (const ContactPoint<D>& a : contact.points)
        for (const ContactPoint<D>& b : contact.points)
            result = std::max(result, static_cast<double>(glm::distance(a.position, b.position)));
    return result;
}

/// Regression: 77 of 81 crates lost the support on one side of the seam, and a plank over six tiles had two points 0.2
/// apart.
TEST(WorldContacts, CarryACrateOverASeamAtAnyTilt) {
    const TileMap floor = row_of_tiles(10);
    for (int i = -38; i <= 38; ++i) {
        SCOPED_TRACE(i);
        const Box2 crate{{5.07f, 1.49f}, {0.5f, 0.5f}, Turn::by(0.0005f * static_cast<float>(i))};
        World2 world;
        world.add(floor, {.fixed = true});
        world.add(crate);
        world.update();
        ASSERT_EQ(world.contacts().size(), 1u);
        EXPECT_NEAR(extent(world.contacts()[0].contact), 1, 1e-3);
        EXPECT_NEAR(extent(contact(crate, floor)), 1, 1e-3);
        EXPECT_NEAR(world.contacts()[0].contact.normal.y, 1, 1e-6);
    }
    const Box2 plank{{5.2f, 1.09f}, {2.2f, 0.1f}};
    EXPECT_NEAR(extent(contact(plank, floor)), 4.4, 1e-5);
}

TEST(WorldContacts, KeepTheFeaturesOfACrateThatMovesOverSeams) {
    const TileMap floor = row_of_tiles(10);
    std::vector<std::uint32_t> features;
    for (int i = 0; i < 100; ++i) {
        const Contact<2> found = contact(Box2{{3 + 0.031f * static_cast<float>(i), 1.49f}, {0.5f, 0.5f}}, floor);
        std::vector<std::uint32_t> here;
        for (const ContactPoint<2>& point : found.points) here.push_back(point.feature);
        std::sort(here.begin(), here.end());
        ASSERT_EQ(here.size(), 2u);
        if (i > 0) {
            EXPECT_EQ(here, features) << i;
        }
        features = here;
    }
}

/// A crate in the corner of floor and wall of one tile map has a contact with each, the deepest first.
TEST(WorldContacts, OfAPairWithSeveralSurfacesAreSeveral) {
    std::vector<Tile> tiles(10, Tile::full);
    tiles.resize(30, Tile::empty);
    tiles[19] = tiles[29] = Tile::full;
    World2 world;
    const Id level = world.add(*TileMap::build(tiles, 10, 1.0f), {.fixed = true}),
             crate = world.add(Box2{{8.52f, 1.49f}, {0.5f, 0.5f}});
    for (int update = 0; update < 2; ++update) {
        EXPECT_EQ(world.update().began.size(), update == 0 ? 1u : 0u);
        ASSERT_EQ(world.contacts().size(), 2u);
        for (const WorldContact<2>& found : world.contacts()) {
            EXPECT_EQ(found.a, level);
            EXPECT_EQ(found.b, crate);
        }
        EXPECT_NEAR(world.contacts()[0].contact.normal.x, -1, 1e-6);
        EXPECT_NEAR(world.contacts()[0].contact.depth, 0.02, 1e-5);
        EXPECT_NEAR(world.contacts()[1].contact.normal.y, 1, 1e-6);
        EXPECT_NEAR(world.contacts()[1].contact.depth, 0.01, 1e-5);
        EXPECT_EQ(world.contact({level, crate}).depth, world.contacts()[0].contact.depth);
    }
}

struct Reported {
    Id id;
    Contact<3> contact;
};
std::vector<Reported> contacts_of(const World3& world, const Box3& box, float margin = 0) {
    std::vector<Reported> result;
    world.each_contact(box,
                       [&](Id id, const Contact<3>& contact) {
                           result.push_back({id, contact});
                       },
                       {}, {.margin = margin});
    std::sort(result.begin(), result.end(), [](const Reported& a, const Reported& b) { return a.id < b.id; });
    return result;
}

/// The contacts of a query shape are those that an item of this shape has after an update.
TEST(WorldContacts, OfAQueryShapeAreThoseOfAnItem) {
    int several = 0, compared = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        World3 world;
        for (int z = -3; z < 3; ++z)
            for (int x = -3; x < 3; ++x)
                world.add(Box3{{static_cast<float>(x) + 0.5f, -0.5f, static_cast<float>(z) + 0.5f}, Vec3(0.5f)},
                          {.fixed = true});
        const Box3 box{{random.uniform_float(-1.5, 1.5), 0.29f, random.uniform_float(-1.5, 1.5)},
                       {random.uniform_float(0.2, 1), 0.3f, random.uniform_float(0.2, 1)}};
        const std::vector<Reported> found = contacts_of(world, box);
        const Id id = world.add(box);
        world.update();
        ASSERT_EQ(found.size(), world.contacts().size());
        for (std::size_t i = 0; i < found.size(); ++i, ++compared) {
            EXPECT_EQ(found[i].id, world.contacts()[i].a);
            EXPECT_EQ(id, world.contacts()[i].b);
            EXPECT_NEAR(found[i].contact.normal.y, -1, 1e-6);
            EXPECT_NEAR(found[i].contact.depth, 0.01, 1e-5);
            EXPECT_NEAR(extent(found[i].contact), extent(world.contacts()[i].contact), 1e-4);
        }
        several += found.size() > 2 ? 1 : 0;
    }
    EXPECT_GT(several, 100);
    EXPECT_GT(compared, 600);
}

TEST(WorldContacts, OfAQueryShapeWithAMarginAreThoseNearToo) {
    World3 world;
    const Id floor = world.add(Box3{{0, -0.5f, 0}, {4, 0.5f, 4}}, {.fixed = true});
    const Box3 above{{0, 0.55f, 0}, {0.5f, 0.5f, 0.5f}};
    EXPECT_TRUE(contacts_of(world, above).empty());
    const std::vector<Reported> near = contacts_of(world, above, 0.1f);
    ASSERT_EQ(near.size(), 1u);
    EXPECT_EQ(near[0].id, floor);
    EXPECT_NEAR(near[0].contact.depth, -0.05, 1e-6);
    int visits = 0;
    world.each_contact(above, [&](Id, const Contact<3>&) { ++visits; }, {.ignore = floor}, {.margin = 0.1f});
    EXPECT_EQ(visits, 0);
}

/// A crate in a corner of tiles and a pillar beside it has three contacts, two of them with the tiles.
TEST(WorldContacts, OfAQueryShapeStopWhenTheVisitorSaysSo) {
    std::vector<Tile> tiles(10, Tile::full);
    tiles.resize(30, Tile::empty);
    tiles[19] = tiles[29] = Tile::full;
    World2 world;
    world.add(*TileMap::build(tiles, 10, 1.0f), {.fixed = true});
    world.add(Box2{{7.53f, 1.5f}, {0.5f, 0.4f}}, {.fixed = true});
    const Box2 crate{{8.52f, 1.49f}, {0.5f, 0.5f}};
    for (int limit = 1; limit <= 4; ++limit) {
        int visits = 0;
        world.each_contact(crate, [&](Id, const Contact<2>&) { return ++visits < limit; });
        EXPECT_EQ(visits, std::min(limit, 3));
    }
}

}  // namespace
}  // namespace abut::test
