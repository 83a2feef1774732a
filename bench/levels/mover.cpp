// Characters that walk over rough terrain: the cost of one step of a Mover.

#include "../../scenes/terrain.hpp"
#include "../bench.hpp"
#include <abut/motion/mover.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/segment.hpp>

#include <memory>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t walker_count = 256;
constexpr std::uint64_t seed = 1;
constexpr std::uint32_t columns = 224;  // squares per side, of two triangles each: 100,352
constexpr int segment_count = 100000;

/// Frames of 1/60 s: a fast walk in circles, with the downward motion of the first frame's fall.
constexpr float stride = 0.06f, fall = 0.02f;
constexpr int frames_around = 600;

template <int D>
struct Walkers {
    World<D> world;
    std::vector<Mover<D>> movers;
    std::vector<Vec<D>> positions;
    std::vector<int> started;  ///< frame of its circle in which it starts
    int frame = 0;

    /// This many walkers above ground that extends this far from the middle.
    void place(oracle::Random& random, double reach) {
        for (std::size_t i = 0; i < walker_count; ++i) {
            movers.emplace_back();
            Vec<D> position(0.0f);
            for (int axis = 0; axis < D; ++axis) position[axis] = random.uniform_float(-reach, reach);
            position[1] = 1.5f;
            positions.push_back(position);
            started.push_back(static_cast<int>(random.below(frames_around)));
        }
        // Runs until they walk on the ground.
        std::vector<double> grounded(walker_count);
        for (int i = 0; i < 200; ++i) step(grounded);
    }

    /// Writes each walker's height above the lowest ground.
    void step(std::span<double> values) {
        Vec<D> a(0.0f), b(0.0f);
        a[1] = -0.5f;
        b[1] = 0.5f;
        const Capsule<D> hero{a, b, 0.4f};
        for (std::size_t i = 0; i < walker_count; ++i) {
            const float angle = 6.2831853f * static_cast<float>((frame + started[i]) % frames_around) / frames_around;
            const Turn turn = Turn::by(angle);
            Vec<D> motion(0.0f);
            motion[0] = stride * turn.cos;
            if constexpr (D == 3) motion[2] = stride * turn.sin;
            motion[1] = -fall;
            const Moved<D> moved = movers[i].move(world, hero, positions[i], motion);
            positions[i] = moved.position;
            values[i] = static_cast<double>(moved.position[1]);
        }
        ++frame;
    }
};

std::shared_ptr<Walkers<3>> walkers_in_space() {
    oracle::Random random(seed);
    const scenes::Terrain ground = scenes::random_terrain(columns, random);
    auto result = std::make_shared<Walkers<3>>();
    result->world.add(*Mesh::build(ground.points, ground.triangles), {.fixed = true});
    result->world.update();
    result->place(random, 0.5 * columns - 10);
    return result;
}

std::shared_ptr<Walkers<2>> walkers_in_the_plane() {
    oracle::Random random(seed);
    auto result = std::make_shared<Walkers<2>>();
    constexpr int half = segment_count / 2;
    Vec2 last{-half, 0};
    for (int i = 1 - half; i <= half; ++i) {
        const Vec2 next{i, random.uniform_float(-0.5, 0.5)};
        result->world.add(Segment2{last, next}, {.fixed = true});
        last = next;
    }
    result->world.update();
    result->place(random, half - 10);
    return result;
}

template <int D>
Job walk(std::shared_ptr<Walkers<D>> walkers) {
    Side side{"abut", [walkers = std::move(walkers)](std::span<double> values) { walkers->step(values); }};
    return {.items = walker_count, .values = walker_count, .sides = {std::move(side)}};
}

}  // namespace

std::vector<Bench> levels_mover_benches() {
    return {
        {"levels/mover/2d", [] { return walk<2>(walkers_in_the_plane()); }},
        {"levels/mover/3d", [] { return walk<3>(walkers_in_space()); }},
    };
}

}  // namespace abut::bench
