// Ghost collisions on floors of separate items: no sliding item gets a sideways contact normal at an internal edge, and
// walls, steps and ends of the floor do give one.

#include "../oracle/random.hpp"
#include "support/bits.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::Random;

constexpr std::uint64_t seed = 20261122;
constexpr int side = 16;  // floors extend from -8 to 8 along each axis; their surface is at height 0

float about(float number, Random* random) {
    return random != nullptr ? number + random->uniform_float(-1e-6, 1e-6) : number;
}

template <int D>
using AddFloor = std::function<void(World<D>&, Random*, const Pose<D>&)>;

/// A floor of which every piece is an item.
void add_boxes(World3& world, Random* random, const Pose3& pose) {
    for (int z = -8; z < 8; ++z)
        for (int x = -8; x < 8; ++x)
            world.add(Box3{{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random),
                            about(static_cast<float>(z) + 0.5f, random)},
                           {0.5f, 0.5f, 0.5f}},
                      {.pose = pose, .fixed = true});
}
void add_triangles(World3& world, Random* random, const Pose3& pose) {
    for (int z = -8; z < 8; ++z)
        for (int x = -8; x < 8; ++x) {
            const auto corner = [&](int i, int k) {
                return Vec3(about(static_cast<float>(x + i), random), about(0, random),
                            about(static_cast<float>(z + k), random));
            };
            world.add(Triangle3{corner(0, 0), corner(0, 1), corner(1, 0)}, {.pose = pose, .fixed = true});
            world.add(Triangle3{corner(1, 0), corner(0, 1), corner(1, 1)}, {.pose = pose, .fixed = true});
        }
}
/// A floor of which every piece is a mesh of two triangles.
void add_meshes(World3& world, Random* random, const Pose3& pose) {
    for (int z = -8; z < 8; ++z)
        for (int x = -8; x < 8; ++x) {
            const Vec3 low(static_cast<float>(x), about(0, random), static_cast<float>(z));
            const std::vector<Vec3> points{low, low + Vec3(1, 0, 0), low + Vec3(1, 0, 1), low + Vec3(0, 0, 1)};
            world.add(*Mesh::build(points, std::vector<glm::uvec3>{{0, 3, 1}, {1, 3, 2}}),
                      {.pose = pose, .fixed = true});
        }
}
void add_boxes(World2& world, Random* random, const Pose2& pose) {
    for (int x = -8; x < 8; ++x)
        world.add(Box2{{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random)}, {0.5f, 0.5f}},
                  {.pose = pose, .fixed = true});
}
void add_segments(World2& world, Random* random, const Pose2& pose) {
    std::vector<Vec2> points;
    for (int x = -8; x <= 8; ++x) points.push_back({x, about(0, random)});
    for (std::size_t x = 0; x < side; ++x) world.add(Segment2{points[x], points[x + 1]}, {.pose = pose, .fixed = true});
}
void add_tile_maps(World2& world, Random* random, const Pose2& pose) {
    for (int x = -8; x < 8; x += 2) {
        const Pose2 here{{static_cast<float>(x), about(-1, random)}};
        world.add(at(*TileMap::build(std::vector{Tile::full, Tile::full}, 2, 1), here), {.pose = pose, .fixed = true});
    }
}

struct SlideCounts {
    double most_aside = 0, most_wrong_depth = 0;
    int frames = 0, contacts = 0, alone_aside = 0;
};

/// Slides a shape through the middle of the floor, `depth` deep. Its lowest point is `reach` below its position.
template <int D, class S>
void slide(const AddFloor<D>& add_floor, const S& shape, float reach, bool turned, Random* noise, SlideCounts& seen) {
    Random random(seed);
    Pose<D> pose{};
    if (turned) {
        pose.position = to_float(random.in_cube<D>() * 5.0);
        pose.rotation = random.rotation<D>();
    }
    World<D> world;
    add_floor(world, noise, pose);
    const Affine<D> out = affine(pose);
    const DVec<D> up = out.vector(axis<D>(1, 1));
    const Id id = world.add(shape, {.pose = pose});
    for (int run = 0; run < 24; ++run) {
        const float speed = std::array{0.003f, 0.02f, 0.11f, 0.7f}[static_cast<std::size_t>(run % 4)];
        const double depth = std::array{1e-4, 0.01, 0.04}[static_cast<std::size_t>(run % 3)];
        Vec<D> direction(0.0f), place(0.0f);
        direction[0] = run % 2 == 0 ? 1.0f : -1.0f;
        if constexpr (D == 3) {
            const double angle = random.chance(0.3) ? 0.7853981633974483 * random.below(8) : random.uniform(0, 6.28);
            direction = {static_cast<float>(std::cos(angle)), 0, static_cast<float>(std::sin(angle))};
            place[2] = random.chance(0.5) ? 0.0f : random.uniform_float(-1, 1);
        }
        // The shape moves slowly around one internal edge, or fast over many.
        place -= direction * std::min(20 * speed, 5.0f);
        place[1] = reach - static_cast<float>(depth);
        for (int frame = 0; frame < 40; ++frame, place += direction * speed) {
            if (std::abs(place[0]) > 6 || std::abs(place[D - 1]) > 6) break;
            Pose<D> there{to_float(out.point(DVec<D>(place))), pose.rotation};
            world.move(id, there);
            world.update();
            ++seen.frames;
            double deepest = -1;
            for (const WorldContact<D>& contact : world.contacts()) {
                const DVec<D> normal(contact.contact.normal);  // it points into the floor or out of it
                const double level = dot(normal, up) * (contact.b == id ? 1 : -1);
                seen.most_aside = std::max(seen.most_aside, level < 0 ? 1 : length(normal - up * dot(normal, up)));
                deepest = std::max(deepest, static_cast<double>(contact.contact.depth));
                ++seen.contacts;
            }
            seen.most_wrong_depth = std::max(seen.most_wrong_depth, std::abs(deepest - depth));
            // The contact of each pair alone, without the neighbours.
            bool aside = false;
            world.each_in_box(grown(bounds(world.shape(id)), 1e-3f), [&](Id other, const View<D>& piece) {
                const Contact<D> alone = other != id ? contact(piece, world.shape(id)) : Contact<D>();
                aside = aside || (alone && dot(DVec<D>(alone.normal), up) < 0.99);
            });
            seen.alone_aside += aside ? 1 : 0;
        }
    }
}

template <int D, class S>
void expect_no_catch(const char* name, const AddFloor<D>& add_floor, const S& shape, float reach, bool has_ghosts) {
    Random noise(seed);
    for (const bool turned : {false, true})
        for (Random* random : {static_cast<Random*>(nullptr), &noise}) {
            SCOPED_TRACE(std::string(name) + (turned ? ", turned" : "") + (random != nullptr ? ", with noise" : ""));
            SlideCounts seen;
            slide<D>(add_floor, shape, reach, turned, random, seen);
            const bool exact = !turned && random == nullptr;
            EXPECT_LT(seen.most_aside, exact ? 1e-5 : 1e-3);
            EXPECT_LT(seen.most_wrong_depth, exact ? 1e-6 : 1e-5);
            EXPECT_GT(seen.contacts, seen.frames);
            if (has_ghosts) {
                EXPECT_GT(seen.alone_aside, 10);
            }
        }
}

template <class F>
void with_shapes_in_space(F&& expect) {
    expect("box", Box3{{0, 0, 0}, {0.4f, 0.3f, 0.6f}}, 0.3f, true);
    expect("small box", Box3{{0, 0, 0}, {0.1f, 0.3f, 0.1f}}, 0.3f, true);
    expect("ball", Sphere{{0, 0, 0}, 0.3f}, 0.3f, true);
    expect("standing capsule", Capsule3{{0, -0.2f, 0}, {0, 0.2f, 0}, 0.3f}, 0.5f, true);
    expect("lying capsule", Capsule3{{-0.5f, 0, 0}, {0.5f, 0, 0}, 0.3f}, 0.3f, true);
    expect("cylinder", Cylinder{{0, -0.3f, 0}, {0, 0.3f, 0}, 0.4f}, 0.3f, true);
}

TEST(Seams, OfBoxesInSpaceGiveNoContact) {
    with_shapes_in_space([](const char* name, const auto& shape, float reach, bool ghosts) {
        expect_no_catch<3>(name, static_cast<void (*)(World3&, Random*, const Pose3&)>(add_boxes), shape, reach,
                           ghosts);
    });
}
TEST(Seams, OfTrianglesGiveNoContact) {
    with_shapes_in_space([](const char* name, const auto& shape, float reach, bool ghosts) {
        expect_no_catch<3>(name, add_triangles, shape, reach, ghosts);
    });
}
TEST(Seams, OfMeshesGiveNoContact) {
    with_shapes_in_space([](const char* name, const auto& shape, float reach, bool ghosts) {
        expect_no_catch<3>(name, add_meshes, shape, reach, ghosts);
    });
}
TEST(Seams, OfThePlaneGiveNoContact) {
    for (const AddFloor<2>& floor : {AddFloor<2>(static_cast<void (*)(World2&, Random*, const Pose2&)>(add_boxes)),
                                     AddFloor<2>(add_segments), AddFloor<2>(add_tile_maps)}) {
        expect_no_catch<2>("box", floor, Box2{{0, 0}, {0.4f, 0.3f}}, 0.3f, true);
        expect_no_catch<2>("small box", floor, Box2{{0, 0}, {0.1f, 0.3f}}, 0.3f, true);
        expect_no_catch<2>("ball", floor, Circle{{0, 0}, 0.3f}, 0.3f, true);
        expect_no_catch<2>("capsule", floor, Capsule2{{-0.5f, 0}, {0.5f, 0}, 0.3f}, 0.3f, true);
    }
}

/// The normals of all contacts of an item, away from it.
std::vector<Vec2> normals_of(const World2& world, Id id) {
    std::vector<Vec2> result;
    for (const WorldContact<2>& contact : world.contacts()) {
        if (contact.a == id) result.push_back(contact.contact.normal);
        if (contact.b == id) result.push_back(-contact.contact.normal);
    }
    return result;
}
int count_near(const std::vector<Vec2>& normals, const Vec2& normal) {
    return static_cast<int>(std::count_if(normals.begin(), normals.end(),
                                          [&](const Vec2& each) { return glm::dot(each, normal) > 0.9999f; }));
}

TEST(Seams, WallsStepsAndEndsGiveContacts) {
    for (const float depth : {1e-4f, 0.01f, 0.05f}) {
        SCOPED_TRACE(depth);
        World2 world;
        add_boxes(world, nullptr, Pose2{});
        for (int y = 0; y < 4; ++y)
            world.add(Box2{{4.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f}}, {.fixed = true});
        const Id low = world.add(Box2{{0.5f, -0.48f}, {0.5f, 0.5f}}, {.fixed = true});
        // The corner of wall and floor; a step of 1/50; the end of the floor.
        const Id wedged = world.add(Box2{{3.5f + depth, 1 - depth}, {0.5f, 1}}),
                 stepping = world.add(Box2{{-0.5f + 0.001f, 0.3f - 0.001f}, {0.5f, 0.3f}}),
                 hanging = world.add(Circle{{-8.3f, 0.4f - depth}, 0.5f});
        world.update();
        EXPECT_GT(count_near(normals_of(world, wedged), {1, 0}), 0);
        EXPECT_GT(count_near(normals_of(world, wedged), {0, -1}), 0);
        for (const Vec2& normal : normals_of(world, wedged))
            EXPECT_TRUE(normal.x > 0.9999f || normal.y < -0.9999f) << normal.x << ' ' << normal.y;
        EXPECT_EQ(count_near(normals_of(world, stepping), {1, 0}), 1);
        EXPECT_GT(count_near(normals_of(world, stepping), {0, -1}), 0);
        ASSERT_EQ(normals_of(world, hanging).size(), 1u);
        EXPECT_GT(normals_of(world, hanging)[0].x, 0.5f);
        (void)low;
    }
}

/// Crates in a stack, and in a row on a floor of boxes, have contacts with all that supports them.
TEST(Seams, StacksAndRowsHold) {
    for (const float depth : {1e-5f, 1e-3f, 0.01f}) {
        SCOPED_TRACE(depth);
        World2 world;
        add_boxes(world, nullptr, Pose2{});
        // A row of four, three above their seams, and one on top; each overlaps its neighbours by `depth`.
        std::vector<std::vector<Id>> rows;
        const float step = 0.8f - depth;
        const auto add_row = [&](int count, float from, float height) {
            std::vector<Id>& row = rows.emplace_back();
            for (int i = 0; i < count; ++i)
                row.push_back(
                    world.add(Box2{{0, 0}, {0.4f, 0.4f}}, {.pose = {{from + step * static_cast<float>(i), height}}}));
        };
        add_row(4, -1.3f, 0.4f - depth);
        add_row(3, -1.3f + 0.5f * step, 0.4f - depth + step);
        add_row(1, -1.3f + step, 0.4f - depth + 2 * step);
        world.update();
        std::vector<IdPair> pairs;
        for (const WorldContact<2>& contact : world.contacts()) {
            pairs.push_back({contact.a, contact.b});
            const Vec2 normal = glm::abs(contact.contact.normal);
            EXPECT_GT(std::max(normal.x, normal.y), 0.9999f);
            EXPECT_NEAR(contact.contact.depth, depth, 1e-6);
        }
        const auto expect = [&](Id a, Id b, const Vec2& normal) {
            const Id low = std::min(a, b), high = std::max(a, b);
            int found = 0;
            for (const WorldContact<2>& contact : world.contacts())
                if (contact.a == low && contact.b == high)
                    found += glm::dot(contact.contact.normal, a == low ? normal : -normal) > 0.9999f ? 1 : 0;
            EXPECT_EQ(found, 1) << a.index << ' ' << b.index;
        };
        for (const auto& row : rows)
            for (std::size_t i = 0; i + 1 < row.size(); ++i) expect(row[i], row[i + 1], {1, 0});
        for (std::size_t i = 0; i < 3; ++i) {
            expect(rows[0][i], rows[1][i], {0, 1});
            expect(rows[0][i + 1], rows[1][i], {0, 1});
        }
        expect(rows[1][0], rows[2][0], {0, 1});
        expect(rows[1][1], rows[2][0], {0, 1});
        for (const Id id : rows[0]) EXPECT_GT(count_near(normals_of(world, id), {0, -1}), 0);
    }
}

/// Moving items form a surface as well: planks side by side, with a box on them.
TEST(Seams, OfMovingItemsGiveNoContact) {
    World2 world;
    std::vector<Id> planks;
    for (int i = 0; i < 6; ++i) planks.push_back(world.add(Box2{{static_cast<float>(i) + 0.5f, -0.2f}, {0.5f, 0.2f}}));
    const Id box = world.add(Box2{{0, 0}, {0.6f, 0.3f}});
    for (int i = 0; i < 200; ++i) {
        world.move(box, {{1.5f + 0.0137f * static_cast<float>(i), 0.29f}});
        world.update();
        const std::vector<Vec2> normals = normals_of(world, box);
        EXPECT_GT(normals.size(), 0u);
        EXPECT_EQ(count_near(normals, {0, -1}), static_cast<int>(normals.size())) << i;
    }
}

/// A ghost has events, and becomes a contact when the item that covered it is removed, although the pair rests.
TEST(Seams, AreRealOnceTheNeighbourIsGone) {
    for (const int how : {0, 1, 2, 3}) {
        SCOPED_TRACE(how);
        World2 world;
        const Id left = world.add(Box2{{-0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true}),
                 right = world.add(Box2{{0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true}),
                 box = world.add(Box2{{0.399f, 0.29f}, {0.4f, 0.3f}});
        EXPECT_EQ(world.update().began.size(), 2u);
        ASSERT_EQ(world.contacts().size(), 1u);
        EXPECT_EQ(world.contacts()[0].a, right);
        EXPECT_EQ(world.update().stayed.size(), 2u);
        EXPECT_EQ(world.contacts().size(), 1u);
        if (how == 0) world.remove(right);
        if (how == 1) world.move(right, {{0, -3}});
        if (how == 2) world.set_filter(right, 2, 2);
        if (how == 3) world.set_shape(right, Box2{{0.5f, -1.5f}, {0.5f, 0.5f}});
        EXPECT_EQ(world.update().ended.size(), 1u);
        ASSERT_EQ(world.contacts().size(), 1u);
        EXPECT_EQ(world.contacts()[0].a, left);
        EXPECT_NEAR(world.contacts()[0].contact.normal.x, 1, 1e-6);
        if (how == 1) {
            world.move(right, {{0, 0}});
            world.update();
            ASSERT_EQ(world.contacts().size(), 1u);
            EXPECT_EQ(world.contacts()[0].a, right);
        }
        (void)box;
    }
}

TEST(Seams, OfItemsThatDoNotPairGiveContacts) {
    for (const bool sensor : {false, true}) {
        World2 world;
        const Id left = world.add(Box2{{-0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true});
        world.add(Box2{{0.5f, -0.5f}, {0.5f, 0.5f}},
                  {.layers = sensor ? 1u : 2u, .mask = sensor ? ~0u : 2u, .fixed = true, .sensor = sensor});
        world.add(Box2{{0.399f, 0.29f}, {0.4f, 0.3f}});
        world.update();
        ASSERT_EQ(world.contacts().size(), 1u);
        EXPECT_EQ(world.contacts()[0].a, left);
        EXPECT_NEAR(world.contacts()[0].contact.normal.x, 1, 1e-6);
    }
}

/// Without the filter each pair has its own contact, also one on an internal edge, and the same events.
TEST(Seams, GiveContactsWithoutTheFilter) {
    World2 filtered, world({.filter_edges = false});
    for (World2* each : {&filtered, &world}) {
        each->add(Box2{{-0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true});
        each->add(Box2{{0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true});
        each->add(Box2{{0.399f, 0.29f}, {0.4f, 0.3f}});
        EXPECT_EQ(each->update().began.size(), 2u);
    }
    EXPECT_EQ(filtered.contacts().size(), 1u);
    ASSERT_EQ(world.contacts().size(), 2u);
    for (const WorldContact<2>& found : world.contacts()) {
        const Contact<2> own = contact(world.shape(found.a), world.shape(found.b));
        EXPECT_EQ(found.contact.normal, own.normal);
        EXPECT_EQ(found.contact.depth, own.depth);
    }
}

/// A slab on the corners of two boxes that are nearly one: where they were 2e-6 to 1e-3 apart it was up to 1.6 deep
/// instead of 0.01, behind a plane through a corner.
TEST(Seams, RidgesOfTwoPiecesHold) {
    constexpr float eighth = 0.785398163f, diagonal = 0.707106781f;
    for (const float lower : {0.0f, 2e-5f, 1e-4f, 5e-4f, 9e-4f, 1.5e-3f})
        for (const float aside : {0.0f, 2e-6f, 1e-5f, 1e-4f, 1.4e-4f, 3e-4f, 6e-4f, 1e-3f, 2e-3f}) {
            SCOPED_TRACE(lower);
            SCOPED_TRACE(aside);
            World2 world;
            world.add(Box2{{0, 0}, {2, 1}}, {.pose = {{0.3f, 0.99f}}});
            for (const Vec2& corner : {Vec2(0, -lower), Vec2(aside, 0)})
                world.add(Box2{{0, 0}, {0.5f, 0.5f}},
                          {.pose = {corner - Vec2(0, diagonal), Turn::by(eighth)}, .fixed = true});
            world.update();
            EXPECT_GE(world.contacts().size(), 1u);
            for (const WorldContact<2>& found : world.contacts()) {
                EXPECT_NEAR(found.contact.normal.y, -1, 1e-6);
                EXPECT_NEAR(found.contact.depth, 0.01f, lower + 1e-6);
            }
        }
}

/// An item with so many neighbours that they are found through the broad phases.
TEST(Seams, OfManyPiecesGiveNoContact) {
    World2 world;
    constexpr int count = 300;
    for (int i = 0; i < count; ++i)
        world.add(Box2{{0.05f * static_cast<float>(i), -0.1f}, {0.025f, 0.1f}}, {.fixed = i % 2 == 0});
    const Id plank = world.add(Box2{{0, 0}, {5, 0.3f}});
    for (int i = 0; i < 40; ++i) {
        world.move(plank, {{6.5f + 0.0131f * static_cast<float>(i), 0.28f}});
        world.update();
        const std::vector<Vec2> normals = normals_of(world, plank);
        EXPECT_GT(normals.size(), 195u);
        EXPECT_EQ(count_near(normals, {0, -1}), static_cast<int>(normals.size())) << i;
    }
}

/// The contacts of a tilted crate that a floor of tiles and two neighbours hold, each `stride` slots after the last
/// one.
std::vector<Bits> contacts_of_a_crate(int stride) {
    World2 world;
    const auto add = [&](const Box2& box, const ItemOptions<2>& options) {
        const Id id = world.add(box, options);
        for (int i = 1; i < stride; ++i)
            world.add(Circle{{1000.0f + 3.0f * static_cast<float>(i), 1000}, 1}, {.fixed = true});
        return id;
    };
    const Id crate = add({{0, 0}, {1, 1}}, {});
    for (int i = 0; i < 6; ++i) add({{static_cast<float>(i), 0.5f}, {0.5f, 0.5f}}, {.fixed = i % 2 == 0});
    add({{3.6f, 1.9f}, {0.52f, 0.9f}}, {});
    std::vector<Bits> result;
    for (int i = 0; i < 40; ++i) {
        const float step = static_cast<float>(i);
        world.move(crate, {{1.5f + 0.03f * step, 1.99f - 0.01f * step}, Turn::by(0.004f * (step - 20))});
        world.update();
        for (const WorldContact<2>& found : world.contacts())
            if (found.a == crate || found.b == crate) result.emplace_back(found.contact);
    }
    return result;
}

/// The views of items whose slots differ by 1,024 share a place in the cache of an update.
TEST(Seams, DoNotDependOnTheSlots) {
    const std::vector<Bits> together = contacts_of_a_crate(1);
    EXPECT_GE(together.size(), 100u);
    EXPECT_EQ(together, contacts_of_a_crate(3));
    EXPECT_EQ(together, contacts_of_a_crate(1024));
}

}  // namespace
}  // namespace abut::test
