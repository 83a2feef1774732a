// Characters, lasers, depenetration, and orders in which shapes can be removed or moved.

#include "../../scenes/terrain.hpp"
#include "../world/support/random_shapes.hpp"
#include "sections.hpp"
#include <abut/motion/depenetrate.hpp>
#include <abut/motion/laser.hpp>
#include <abut/motion/mover.hpp>
#include <abut/motion/rearrange.hpp>
#include <abut/shape/tile_map.hpp>

namespace abut::everywhere {
namespace {

using detail::to_float;

/// A level with hills or platforms, and boxes on it.
template <int D>
World<D> level(oracle::Random& random) {
    World<D> world;
    if constexpr (D == 2) {
        std::vector<Tile> tiles;
        for (int i = 0; i < 16 * 8; ++i)
            tiles.push_back(i < 16 || random.chance(0.2) ? static_cast<Tile>(1 + random.below(13)) : Tile::empty);
        world.add(*TileMap::build(tiles, 16, 1), {.fixed = true});
    } else {
        const scenes::Terrain ground = scenes::random_terrain(16, random);
        world.add(*Mesh::build(ground.points, ground.triangles), {.fixed = true});
    }
    for (int i = 0; i < 30; ++i) {
        Pose<D> pose = test::random_pose<D>(random, 6);
        if constexpr (D == 2) pose.position += Vec2(8, 4);
        world.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.4f)}, {.pose = pose, .fixed = i % 2 == 0});
    }
    return world;
}

template <int D>
void add_touch(Hash& hash, const MoverTouch<D>& touch) {
    hash.add(std::uint64_t{touch.id.index});
    hash.add(touch.feature);
    hash.add<D>(touch.point);
    hash.add<D>(touch.normal);
    hash.add(std::uint64_t{touch.is_ground});
}

template <int D>
void add_mover(Hash& hash, const World<D>& world, oracle::Random& random) {
    Mover<D> mover;
    Vec<D> position(D == 2 ? 8.0f : 0.0f);
    position[1] = 5;
    const Capsule<D> shape{Vec<D>(0.0f), mover.options().up, 0.3f};
    Vec<D> direction(0.0f);
    for (int i = 0; i < 300; ++i) {
        if (i % 20 == 0) direction = to_float(random.in_cube<D>() * 0.2);
        direction[1] = -0.1f;
        const Moved<D> moved = mover.move(world, shape, position, direction);
        position = moved.position;
        hash.add<D>(moved.position);
        hash.add<D>(moved.motion);
        hash.add<D>(moved.pushed);
        hash.add(std::uint64_t{moved.grounded} << 1 | std::uint64_t{moved.crushed});
        for (const MoverTouch<D>& touch : moved.touches) add_touch(hash, touch);
    }
}

template <int D>
void add_laser(Hash& hash, const World<D>& world, oracle::Random& random) {
    const auto place = [&] { return to_float(random.in_cube<D>() * 6.0) + Vec<D>(D == 2 ? 6.0f : 0.0f); };
    for (int i = 0; i < 40; ++i) {
        const Vec<D> from = place(), to = place();
        int bounces = 0;
        const Ray<D> last = follow_laser(world, Ray<D>::between(from, to), [&](const Ray<D>&, const WorldHit<D>& hit) {
            add_hit(hash, std::optional(hit.hit));
            return ++bounces < 6;
        });
        hash.add<D>(last.origin);
        hash.add<D>(last.direction);
        const Depenetration<D> out = depenetrate(Ball<D>{from, 0.5f}, world);
        hash.add<D>(out.push);
        hash.add(out.depth);
    }
}

template <int D>
void add_orders(Hash& hash, oracle::Random& random) {
    std::vector<Ball<D>> balls;
    std::vector<Box<D>> boxes;
    std::vector<Pose<D>> from, to;
    for (int i = 0; i < 24; ++i) {
        const Vec<D> center = to_float(random.in_cube<D>() * 4.0);
        balls.push_back({center, 0.5f});
        boxes.push_back({Vec<D>(0.0f), Vec<D>(0.2f), random.rotation<D>()});
        Vec<D> place(0.0f);
        place[0] = static_cast<float>(i);
        from.push_back({place});
        place[1] = static_cast<float>((i * 7) % 24);
        to.push_back({place});
    }
    Vec<D> direction(0.0f);
    direction[0] = 1;
    const RemovalOrder order = removal_order(balls, direction);
    for (const std::uint32_t item : order.order) hash.add(std::uint64_t{item});
    for (const std::uint32_t item : order.cycle) hash.add(std::uint64_t{item});
    for (const Move<D>& move : rearrange(boxes, from, to).moves) {
        hash.add(std::uint64_t{move.shape});
        hash.add<D>(move.to.position);
    }
}

template <int D>
void add_all(Hash& hash) {
    oracle::Random random(D);
    for (int i = 0; i < 3; ++i) {
        const World<D> world = level<D>(random);
        add_mover(hash, world, random);
        add_laser(hash, world, random);
        add_orders<D>(hash, random);
    }
}

}  // namespace

void add_motions(Hash& hash) {
    add_all<2>(hash);
    add_all<3>(hash);
}

}  // namespace abut::everywhere
