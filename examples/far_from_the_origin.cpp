// Two ships dock a light minute from the origin, where a float can't tell a metre from a mile.

#include <abut/world/large_world.hpp>

#include <cmath>
#include <cstdio>

int main() {
    using namespace abut;

    const glm::dvec3 station(1.8e10, -4e9, 7e9);
    LargeWorld3 world;
    const Id port = world.add(Box3{{0, 0, 0}, {10, 10, 10}}, {station}, {.fixed = true});
    const Id ship = world.add(Sphere{{0, 0, 0}, 2}, {station + glm::dvec3(20, 0, 0)});

    for (int frame = 0; frame < 40; ++frame) {
        world.move(ship, {world.pose(ship).position - glm::dvec3(0.25, 0, 0)});
        if (world.update().began.empty()) continue;
        const WorldContact<3>& touch = world.contacts().front();
        const glm::dvec3 place = world.in_world(touch.a, touch.contact.points[0].position) - station;
        std::printf("frame %d: item %u touches item %u, %.3f m from the middle of the port\n", frame, touch.b.index,
                    touch.a.index, place.x);
        const auto below = world.raycast({world.pose(ship).position, {-1, 0, 0}, 100}, {.ignore = ship});
        std::printf("the port is %.3f m from the middle of the ship\n", below ? below->hit.distance : -1);
        const bool is_right = touch.a == port && touch.b == ship && frame == 31 && std::abs(place.x - 10) < 1e-5 &&
                              below && below->hit.distance == 2;
        return is_right ? 0 : 1;
    }
    return 1;
}
