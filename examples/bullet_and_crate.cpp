// Continuous collision detection in a World: a bullet that passes a wall within one step, and a crate that is pushed
// over a floor.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    abut::World3 world;
    const abut::Id wall = world.add(abut::Box3{{50, 2, 0}, {0.001f, 2, 5}}, {.fixed = true});
    world.add(abut::Box3{{50, -0.5f, 0}, {60, 0.5f, 60}}, {.fixed = true});  // the floor
    const abut::Id bullet = world.add(abut::Sphere{{0, 0, 0}, 0.01f}, {.pose = {{0, 1, 0}}, .continuous = true});

    // A continuous item reports everything it touched since the last update, even if it is past it by now.
    int hits = 0;
    for (int frame = 0; frame < 5; ++frame) {
        const abut::Events events = world.update();
        for (std::size_t i = 0; i < events.began.size(); ++i) {
            if (events.began[i] != abut::IdPair{wall, bullet}) continue;
            const float at = 15 * (static_cast<float>(frame - 1) + events.fractions[i]);
            std::printf("frame %d: through the wall at x = %.3f\n", frame, static_cast<double>(at));
            ++hits;
        }
        world.move(bullet, {{15 * static_cast<float>(frame + 1), 1, 0}});
    }

    // A sweep before the move stops the crate in time. Resting contact with the floor doesn't block it.
    const abut::Box3 crate{{10, 1, 0}, {1, 1, 1}};
    const abut::Vec3 push{80, 0, 0};
    const auto hit = world.sweep(crate, push, {.ignore = bullet});
    if (hit) std::printf("the crate comes %.3f far, to the wall\n", static_cast<double>(hit->hit.distance));

    // A sweep with rotation: a plank that falls over.
    const abut::Box3 plank{{-0.05f, 3, 0}, {0.05f, 3, 0.5f}};  // about its lower end
    const abut::Motion3 fall{.from = {{45.5f, 0, 0}}, .turn = {0, 0, -1.5f}};
    const auto met = world.sweep(plank, fall, {.ignore = bullet});
    if (met) std::printf("the plank leans on the wall after %.2f rad\n", static_cast<double>(1.5f * met->hit.fraction));

    const bool right = hits == 1 && hit && hit->id == wall && met && met->id == wall;
    return right ? 0 : 1;
}
