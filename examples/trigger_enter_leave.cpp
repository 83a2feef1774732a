// Trigger events: a door is open while the player is in front of it.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    abut::World3 world;
    const abut::Id player = world.add(abut::Capsule3{{0, 0.5f, 0}, {0, 1.5f, 0}, 0.4f});
    const abut::Id zone = world.add(abut::Box3{{10, 1, 0}, {2, 1, 2}}, {.fixed = true, .sensor = true});
    world.add(abut::HalfSpace3{{0, 1, 0}, 0.1f}, {.fixed = true});  // the floor: always touched, and filtered out

    const abut::IdPair at_door{player, zone};  // the lower id first
    int opened_at = -1, closed_at = -1;
    for (int frame = 0; frame < 60; ++frame) {
        world.move(player, {.position = {0.5f * static_cast<float>(frame), 0, 0}});
        const abut::Events events = world.update();

        for (const abut::IdPair& pair : events.began)
            if (pair == at_door) opened_at = frame;
        for (const abut::IdPair& pair : events.ended)
            if (pair == at_door) closed_at = frame;
    }

    std::printf("the door opened in frame %d and closed in frame %d\n", opened_at, closed_at);
    return opened_at == 16 && closed_at == 25 ? 0 : 1;
}
