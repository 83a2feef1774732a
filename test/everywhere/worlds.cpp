// Worlds, frame by frame: events, contacts, queries, snapshots, the past, and small physics on top of them.

#include "../../scenes/small_physics.hpp"
#include "../world/support/bits.hpp"
#include "../world/support/random_shapes.hpp"
#include "sections.hpp"
#include <abut/world/history.hpp>

namespace abut::everywhere {
namespace {

using detail::to_float;
using test::Bits;

void add_bytes(Hash& hash, std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) hash.add(std::to_integer<std::uint64_t>(byte));
}

/// What a world reports after an update, and its answers to a few questions.
template <int D>
void add_frame(Hash& hash, World<D>& world, oracle::Random& random, double extent) {
    Bits bits;
    const Events events = world.update();
    bits.put(events.began);
    bits.put(events.stayed);
    bits.put(events.ended);
    bits.put(events.fractions);
    bits.put(world.contacts());
    bits.put(world.impacts());
    const Vec<D> from = to_float(random.in_cube<D>() * extent), to = to_float(random.in_cube<D>() * extent);
    const Ray<D> ray = Ray<D>::between(from, to);
    const Pose<D> start{from}, end{to, random.rotation<D>()};
    const Box<D> box{Vec<D>(0.0f), Vec<D>(0.3f)};
    bits.put(world.raycast_all(ray));
    bits.put(world.closest(from));
    bits.put(world.sweep(box, to - from));
    bits.put(world.sweep(box, start, end));
    bits.put(world.overlapping(Ball<D>{to, 1}));
    bits.put(world.containing(from));
    hash.add(bits.hash());
}

/// Random shapes that move, change and go. One in `continuous` is continuous.
template <int D>
void add_game(Hash& hash, std::uint64_t seed, int items, double extent, std::uint32_t continuous) {
    oracle::Random random(seed);
    World<D> world;
    History<D> history(world, 8);
    std::vector<Id> ids;
    const auto add = [&] {
        const Pose<D> pose = test::random_pose<D>(random, extent);
        const ItemOptions<D> options{.pose = pose,
                                     .user = ids.size(),
                                     .fixed = random.chance(0.2),
                                     .sensor = random.chance(0.1),
                                     .continuous = continuous != 0 && random.below(continuous) == 0};
        test::with_random_shape<D>(random, test::random_kind<D>(random),
                                   [&](const auto& shape) { ids.push_back(world.add(shape, options)); });
    };
    for (int i = 0; i < items; ++i) add();
    std::vector<std::byte> snapshot;
    for (int frame = 0; frame < 200; ++frame) {
        add_frame(hash, world, random, extent);
        history.record();
        if (frame % 50 == 20) {
            snapshot = world.save();
            add_bytes(hash, snapshot);
        }
        if (frame % 50 == 25) hash.add(std::uint64_t{world.restore(snapshot).has_value()});
        if (frame % 50 == 30) {
            const World<D>& past = history.at(history.first_tick() + 2, 0.3f);
            hash.add(Bits(past.closest(Vec<D>(0.0f)), past.overlapping(Ball<D>{Vec<D>(0.0f), 2})).hash());
        }
        for (Id& id : ids) {
            if (!world.contains(id) || random.chance(0.6)) continue;
            world.move(id, test::moved_a_little(random, world.pose(id), 0.15));
            if (random.chance(0.01)) world.remove(id);
        }
        if (frame % 10 == 0) add();
    }
}

/// Boxes that fall on a floor and come to rest in heaps.
template <int D>
void add_heap(Hash& hash) {
    scenes::SmallPhysics<D> physics;
    Vec<D> half(20.0f), below(0.0f);
    half[1] = 1;
    below[1] = -1;
    physics.add_fixed(Box<D>{Vec<D>(0.0f), half}, {below});
    oracle::Random random(D);
    for (int i = 0; i < 30; ++i) {
        scenes::Real<D> position = random.in_cube<D>() * 1.5;
        position.y = 1 + 0.4 * i;
        const Rotation<D> rotation = random.rotation<D>();
        if constexpr (D == 2)
            physics.add_box(position, {rotation.cos, rotation.sin}, Vec2(0.3f, 0.2f));
        else
            physics.add_box(position, glm::dquat(rotation), Vec3(0.3f, 0.2f, 0.4f));
    }
    for (int frame = 0; frame < 200; ++frame) {
        physics.step(1.0 / 60);
        hash.add(Bits(physics.world.contacts()).hash());
    }
    for (const auto& body : physics.bodies()) hash.add<D>(body.pose().position);
}

template <int D>
void add_worlds(Hash& hash) {
    add_game<D>(hash, 1, 60, D == 2 ? 5 : 2.5, 0);
    add_game<D>(hash, 2, 30, D == 2 ? 4 : 2, 3);
    add_heap<D>(hash);
}

}  // namespace

void add_worlds_in_the_plane(Hash& hash) {
    add_worlds<2>(hash);
}
void add_worlds_in_space(Hash& hash) {
    add_worlds<3>(hash);
}

}  // namespace abut::everywhere
