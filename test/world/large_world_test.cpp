// A world of double positions answers far away what it answers at the origin, bit by bit.

#include "support/bits.hpp"
#include "support/random_shapes.hpp"
#include <abut/math/thread_pool.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/world/detail/double_positions.hpp>
#include <abut/world/large_world.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using detail::DVec;

namespace {

/// A game in a large world around a place. All positions are multiples of 2^-10 from it, so that those around another
/// place differ by one offset, exactly. The boxes of the broad phases are about another point, so that their rounding
/// differs.
template <int D>
class Journey {
public:
    Journey(std::uint64_t seed, const DVec<D>& place, double to_origin) : random_(seed), place_(place) {
        world.remove(world.add(Ball<D>{}, {place + DVec<D>(to_origin)}));
        add_ground();
        for (int i = 0; i < 40; ++i) add();
    }

    /// Changes the world at random, updates it and queries it; records all answers.
    void frame(Bits& bits, Executor* executor = nullptr) {
        for (const Id id : ids_) {
            if (random_.chance(0.6)) world.move(id, step(world.pose(id)));
            if (random_.chance(0.02)) world.move(id, any_pose());
            if (random_.chance(0.02)) world.set_enabled(id, !world.is_enabled(id));
        }
        if (random_.chance(0.3)) {
            const std::size_t last = random_.below(static_cast<std::uint32_t>(ids_.size()));
            world.remove(ids_[last]);
            ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(last));
            add();
        }
        const Events events = executor != nullptr ? world.update(*executor) : world.update();
        bits.put(events.began);
        bits.put(events.stayed);
        bits.put(events.ended);
        bits.put(events.fractions);
        bits.put(world.contacts());
        bits.put(world.impacts());
        for (const auto& contact : world.contacts())
            EXPECT_EQ(world.in_world(contact.a, Vec<D>(0.0f)), world.pose(contact.a).position);
        contacts += world.contacts().size();
        impacts += world.impacts().size();
        if (random_.chance(0.5)) world.move(ids_.front(), any_pose());  // queries see it before the update
        query(bits);
    }

    LargeWorld<D> world;
    std::size_t contacts = 0, impacts = 0, hits = 0, found = 0;

private:
    DVec<D> lattice_point(double extent) {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = std::floor(random_.uniform(-extent, extent) * 0x1p10) * 0x1p-10;
        return result;
    }
    PoseD<D> any_pose() { return {place_ + lattice_point(3), random_.rotation<D>()}; }
    PoseD<D> step(const PoseD<D>& pose) {
        return {pose.position + lattice_point(0.2),
                moved_a_little<D>(random_, {Vec<D>(0.0f), pose.rotation}, 0).rotation};
    }
    void add() {
        const PoseD<D> pose = any_pose();
        const ItemOptions<D> options{
            .fixed = random_.chance(0.2), .sensor = random_.chance(0.1), .continuous = random_.chance(0.2)};
        with_random_shape<D>(random_, random_kind<D>(random_),
                             [&](const auto& shape) { ids_.push_back(world.add(shape, pose, options)); });
    }
    /// Levels with internal edges.
    void add_ground() {
        PoseD<D> below{place_};
        below.position[1] -= 2;
        below.position[0] -= 4;
        if constexpr (D == 2) {
            world.add(*TileMap::build(std::vector<Tile>(16, Tile::full), 16, 0.5f), below, {.fixed = true});
        } else {
            below.position[2] -= 4;
            world.add(*HeightField::build(std::vector<float>(81, 0.25f), 9, 1.0f), below, {.fixed = true});
        }
        std::vector<AnyShape<D>> boxes;
        for (int i = 0; i < 6; ++i) {
            Vec<D> center(0.0f);
            center[0] = static_cast<float>(i);
            boxes.push_back(Box<D>{center, Vec<D>(0.5f)});
        }
        below.position[1] += 1.5;
        world.add(*Compound<D>::build(boxes), below);
    }
    void query(Bits& bits) {
        const DVec<D> from = place_ + lattice_point(4), to = place_ + lattice_point(4);
        const Filter filter{.sensors = random_.chance(0.5)};
        const RayD<D> ray = RayD<D>::between(from, to);
        const auto hit = world.raycast(ray, filter);
        bits.put(hit);
        bits.put(world.raycast_any(ray, filter));
        bits.put(world.raycast_all(ray, filter));
        bits.put(world.closest(from, filter));
        bits.put(world.containing(to, filter));
        hits += hit.has_value();
        const auto with_shape = [&](const auto& shape) {
            const PoseD<D> pose{from, random_.rotation<D>()}, end{to, random_.rotation<D>()};
            const auto swept = world.sweep(shape, pose, Vec<D>(to - from), filter);
            bits.put(swept);
            bits.put(world.sweep(shape, pose, end, filter));
            bits.put(world.closest(shape, pose, filter));
            bits.put(world.overlapping(shape, pose, filter));
            std::vector<std::pair<Id, Contact<D>>> touched;  // in an unspecified order
            const auto add = [&](Id id, const Contact<D>& contact) { touched.emplace_back(id, contact); };
            world.each_contact(shape, pose, add, filter, {.margin = 0.05f});
            std::stable_sort(touched.begin(), touched.end(),
                             [](const auto& a, const auto& b) { return a.first < b.first; });
            for (const auto& [id, contact] : touched) {
                bits.put(id);
                bits.put(contact);
            }
            hits += swept.has_value();
        };
        with_random_shape<D>(random_, random_kind<D>(random_, 0), with_shape);
        std::vector<Id> in_box;
        world.each_in_box(from, {Vec<D>(-1.0f), Vec<D>(1.5f)}, [&](Id id, const View<D>& shape) {
            in_box.push_back(id);
            if (overlaps(shape, Ball<D>{Vec<D>(0.0f), 0.5f})) ++found;
        });
        std::sort(in_box.begin(), in_box.end());
        bits.put(in_box);
    }

    oracle::Random random_;
    DVec<D> place_;
    std::vector<Id> ids_;
};

template <int D>
DVec<D> distant_place(const std::array<double, 3>& coordinates) {
    DVec<D> result;
    for (int i = 0; i < D; ++i) result[i] = coordinates[static_cast<std::size_t>(i)];
    return result;
}

constexpr std::array<std::array<double, 3>, 4> distant_places{
    {{1e7, -2e7, 5e6}, {-1e10, 3, 7e9}, {0.5, -0.25, 4096}, {0x1p40, 0, -0x1p40}}};

template <int D>
void expect_equal_everywhere(std::uint64_t seed, int frames) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Journey<D> here(seed, DVec<D>(0.0), 0);
    std::vector<Journey<D>> there;
    for (std::size_t i = 0; i < distant_places.size(); ++i)
        there.emplace_back(seed, distant_place<D>(distant_places[i]), std::array{0.0, 700.0, -3000.0, 8000.0}[i]);
    ThreadPool pool(2);
    for (int frame = 0; frame < frames; ++frame) {
        Bits expected;
        here.frame(expected);
        for (std::size_t i = 0; i < there.size(); ++i) {
            Bits bits;
            there[i].frame(bits, i % 2 == 0 ? nullptr : &pool);
            ASSERT_TRUE(bits == expected) << "frame " << frame << ", place " << i;
        }
    }
    EXPECT_GT(here.contacts, static_cast<std::size_t>(2 * frames));
    EXPECT_GT(here.impacts, static_cast<std::size_t>(frames / 10));
    EXPECT_GT(here.hits, static_cast<std::size_t>(frames / 2));
    EXPECT_GT(here.found, static_cast<std::size_t>(frames / 4));
}

TEST(LargeWorld, AnswersFarAwayAreThoseAtTheOrigin) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        expect_equal_everywhere<2>(seed, 40);
        expect_equal_everywhere<3>(seed, 40);
    }
}

/// The box of an item that isn't enabled had sides that are no numbers: infinity less infinity.
TEST(LargeWorld, TheBoxOfNothingIsEmpty) {
    detail::DoublePositions<2> positions;
    positions.set(0, {1e7, 3});
    const Aabb2 box = positions.item_box(0, Aabb2::empty());
    EXPECT_EQ(box, Aabb2::empty());
}

/// Two crates 0.1 deep in each other, and a laser that grazes one by 1e-4: floats step by 1 there.
TEST(LargeWorld, IsPreciseAMillionMilesAway) {
    LargeWorld3 world;
    const glm::dvec3 place(1.6e9, 0, -1.6e9);
    const Box3 crate{{0, 0, 0}, {0.5f, 0.5f, 0.5f}};
    const Id a = world.add(crate, {place}), b = world.add(crate, {place + glm::dvec3(0.875, 0, 0)});
    EXPECT_EQ(world.update().began.size(), 1u);
    ASSERT_EQ(world.contacts().size(), 1u);
    const WorldContact<3>& found = world.contacts().front();
    EXPECT_EQ(found.a, a);
    EXPECT_EQ(found.contact.depth, 0.125f);
    for (const auto& point : found.contact.points) EXPECT_EQ(world.in_world(a, point.position).x, place.x + 0.4375);

    const double above = 0.5 + 0x1p-13;
    EXPECT_FALSE(world.raycast({place + glm::dvec3(-5, above, 0), {1, 0, 0}, 20}));
    const auto hit = world.raycast({place + glm::dvec3(-5, 0.5 - 0x1p-13, 0), {1, 0, 0}, 20});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id, a);
    EXPECT_EQ(hit->in_world(hit->hit.point).x, place.x - 0.5);
    EXPECT_EQ(world.sweep(Sphere{{0, 0, 0}, 0.25f}, {place + glm::dvec3(10, 0, 0)}, Vec3{-20, 0, 0})->id, b);
    EXPECT_NEAR(world.closest(place + glm::dvec3(0, 2.5, 0))->closest.distance, 2, 1e-6);
}

/// Two towns 10,000 km apart and a train between them: boxes are rounded to metres somewhere, and no answer changes.
TEST(LargeWorld, WhatIsFarApartChangesNothing) {
    const DVec<2> town(0.0), other(1e7, 3e6);
    Bits together, alone;
    LargeWorld2 both, first;
    const auto fill = [](LargeWorld2& world, const DVec<2>& place, std::uint64_t seed) {
        oracle::Random random(seed);
        for (int i = 0; i < 60; ++i)
            world.add(Box2{{0, 0}, {0.5f, 0.5f}}, {place + random.in_cube<2>() * 4.0, random.rotation<2>()});
    };
    fill(first, other, 5);
    fill(both, other, 5);
    fill(both, town, 6);
    const Id train = both.add(Ball<2>{{0, 0}, 1}, {town - DVec<2>(0, 100)});
    for (int step = 0; step <= 10; ++step) {
        both.move(train, {town + (other - town) * (0.1 * step) - DVec<2>(0, 100)});
        first.update();
        const Events events = both.update();
        std::size_t of_other = 0;
        for (const auto& contact : both.contacts())
            if (contact.b.index <= 60) {
                ASSERT_LT(of_other, first.contacts().size());
                EXPECT_TRUE(Bits(contact) == Bits(first.contacts()[of_other++]));
            }
        EXPECT_EQ(of_other, first.contacts().size());
        EXPECT_GT(events.stayed.size() + events.began.size(), 2 * of_other / 3);
    }
}

template <int D>
void expect_restored_far_away() {
    constexpr std::uint64_t seed = 11;
    const DVec<D> place = distant_place<D>(distant_places[0]);
    Journey<D> game(seed, place, 5000);
    Bits before;
    for (int frame = 0; frame < 10; ++frame) game.frame(before);
    const std::vector<std::byte> bytes = game.world.save();
    Journey<D> copy = game;
    Bits expected;
    for (int frame = 0; frame < 10; ++frame) copy.frame(expected);

    Journey<D> restored = game;
    Bits other;
    LargeWorld<D> changed = copy.world;
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 200) {
        const auto problem = changed.restore(std::span(bytes).first(size));
        ASSERT_TRUE(problem);
        EXPECT_EQ(problem->code, ProblemCode::bad_format);
    }
    for (std::size_t i = 0; i < bytes.size(); i += 1 + bytes.size() / 200) {
        std::vector<std::byte> damaged = bytes;
        damaged[i] ^= std::byte{4};
        ASSERT_TRUE(changed.restore(damaged)) << "byte " << i;
    }
    EXPECT_TRUE(changed.save() == copy.world.save()) << "a refused snapshot must change nothing";
    EXPECT_TRUE(World<D>().restore(bytes));
    EXPECT_TRUE(changed.restore(World<D>().save()));
    ASSERT_FALSE(changed.restore(bytes));
    EXPECT_TRUE(changed.save() == bytes);
    restored.world = std::move(changed);
    for (int frame = 0; frame < 10; ++frame) restored.frame(other);
    EXPECT_TRUE(other == expected);
}

/// The positions of slots that are gone since are no items'.
TEST(LargeWorld, MovesItsOriginAfterASnapshotOfFewerItems) {
    LargeWorld2 world;
    const Id id = world.add(Circle{{0, 0}, 1}, {DVec<2>(0.0)});
    const std::vector<std::byte> bytes = world.save();
    for (int i = 0; i < 1000; ++i) world.add(Circle{{0, 0}, 1}, {DVec<2>(i, 5)});
    ASSERT_FALSE(world.restore(bytes));
    world.move(id, {DVec<2>(1e9, 0)});
    EXPECT_TRUE(world.update().began.empty());
    EXPECT_EQ(world.overlapping(Circle{{0, 0}, 1}, {DVec<2>(1e9, 1.5)}), std::vector<Id>{id});
}

TEST(LargeWorld, GoesBackToASnapshot) {
    expect_restored_far_away<2>();
    expect_restored_far_away<3>();
}

}  // namespace
}  // namespace abut::test
