// Lag compensation: a shooter sees the others where they were a moment ago, and his shot is judged by what he saw.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    constexpr std::uint64_t players = 2;  // the layer of all that is recorded
    abut::World3 world;
    world.add(abut::Box3{{20, 2, 3}, {0.5f, 2, 2}}, {.fixed = true});  // a wall
    const abut::Capsule3 body{{0, 0.4f, 0}, {0, 1.4f, 0}, 0.4f};
    const abut::Id shooter = world.add(body, {.layers = players});
    const abut::Id runner = world.add(body, {.pose = {{25, 0, -3}}, .layers = players});

    // The server: 64 ticks a second, and one second of the past. The runner runs behind the wall at 8 m/s.
    abut::History3 past(world, 64, {.layers = players});
    std::uint64_t now = 0;
    for (int tick = 0; tick < 32; ++tick) {
        world.move(runner, {{25, 0, -3 + 0.125f * static_cast<float>(tick)}});
        world.update();
        now = past.record();
    }

    // A shot arrives that was fired 150 ms ago, at where the shooter saw the runner: between two ticks.
    const double seen = static_cast<double>(now) - 0.15 * 64;
    const auto tick = static_cast<std::uint64_t>(seen);
    const auto fraction = static_cast<float>(seen - static_cast<double>(tick));
    const abut::World3& then = past.at(tick, fraction);
    const abut::Vec3 eye{0, 1.5f, 0}, aim = then.pose(runner).position + abut::Vec3(0, 1, 0);
    const abut::Ray3 shot{eye, glm::normalize(aim - eye), 100};

    const auto in_the_past = then.raycast(shot, {.ignore = shooter});
    const auto in_the_present = world.raycast(shot, {.ignore = shooter});
    const bool is_hit = in_the_past && in_the_past->id == runner;
    std::printf("tick %d + %.2f: the shot %s\n", static_cast<int>(tick), static_cast<double>(fraction),
                is_hit ? "hits the runner" : "misses");
    std::printf("tick %d: it would %s\n", static_cast<int>(now),
                in_the_present && in_the_present->id == runner ? "hit the runner" : "miss");
    return is_hit && (!in_the_present || in_the_present->id != runner) ? 0 : 1;
}
