// A 2D platformer character in 20 lines: walks up a step and a slope, jumps, and lands on a platform that carries it.
#include <abut/abut.hpp>

#include <algorithm>
#include <cstdio>

int main() {
    abut::World2 world;
    world.add(abut::Box2{{10, -1}, {20, 1}}, {.fixed = true});   // the floor
    world.add(abut::Box2{{6, 0}, {2, 0.25f}}, {.fixed = true});  // a step
    world.add(abut::Box2{{26, 4}, {1, 5}}, {.fixed = true});     // a wall
    const abut::Id lift = world.add(abut::Box2{{12, 1}, {2, 0.1f}});

    abut::Mover2 mover;
    const abut::Capsule2 hero{{0, -0.4f}, {0, 0.4f}, 0.4f};
    abut::Vec2 position{0, 1}, velocity{4, 0};
    float highest = 0, farthest = 0;
    bool rode = false;
    for (int frame = 0; frame < 600; ++frame) {
        const float dt = 1.0f / 60, time = static_cast<float>(frame) * dt;
        world.move(lift, {{0, 0.3f * time}});
        velocity.y -= 20 * dt;
        const auto moved = mover.move(world, hero, position, velocity * dt);
        position = moved.position;
        if (moved.grounded) velocity.y = position.x > 9 && position.x < 9.1f ? 9.0f : 0.0f;  // jumps onto the lift
        rode = rode || (moved.grounded && moved.ground.id == lift);
        highest = std::max(highest, position.y);
        farthest = std::max(farthest, position.x);
        if (moved.crushed) return 1;
    }
    std::printf("came as far as %.2f, as high as %.2f, and %s the lift\n", static_cast<double>(farthest),
                static_cast<double>(highest), rode ? "rode" : "missed");
    // The wall stops it at a distance of about the skin.
    return rode && farthest > 24.5f && farthest < 24.65f ? 0 : 1;
}
