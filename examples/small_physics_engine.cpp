// A small physics engine: a stack of crates falls on a floor of tiles and comes to rest. The engine is
// scenes/small_physics.hpp: abut finds the contacts, and 200 lines turn them into impulses.
#include "../scenes/small_physics.hpp"
#include <abut/abut.hpp>

#include <cstdio>
#include <vector>

int main() {
    abut::scenes::SmallPhysics<2> physics;
    const std::vector<abut::Tile> row(20, abut::Tile::full);
    physics.add_fixed(*abut::TileMap::build(row, 20, 1.0f), {{-10, -1}});

    // The crates are tilted a little, to and fro, and stand above a seam between two tiles.
    constexpr int crates = 6;
    for (int i = 0; i < crates; ++i) {
        const double tilt = i % 2 == 0 ? 0.02 : -0.02;
        physics.add_box({0.1, 0.55 + 1.05 * i}, {std::cos(tilt), std::sin(tilt)}, {0.5f, 0.5f});
    }

    constexpr int steps_per_second = 240;
    for (int second = 1; second <= 5; ++second) {
        for (int i = 0; i < steps_per_second; ++i) physics.step(1.0 / steps_per_second);
        std::printf("after %d s: speed %.4f, %zu contact points, %zu of them as in the step before\n", second,
                    physics.speed(), physics.points(), physics.persistent_points());
    }
    const abut::scenes::Body<2>& top = physics.bodies().back();
    std::printf("the topmost crate stands at a height of %.2f\n", top.position.y);
    return physics.speed() < 0.02 && std::abs(top.position.y - (crates - 0.5)) < 0.1 ? 0 : 1;
}
