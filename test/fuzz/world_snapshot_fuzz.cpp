// Restores a world from any bytes: the world refuses them and stays as it was, or it saves the same bytes again and can
// be used.

#include "bytes.hpp"
#include "with_checksum.hpp"
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

/// Some items that touch, one that moved since the update, a bullet, and a free slot.
World3 example() {
    World3 world;
    world.add(Box3{{0, 0, 0}, {5, 1, 5}}, {.fixed = true});
    const Id crate = world.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, {.pose = {{0, 1.5f, 0}}, .user = 3});
    world.add(Capsule3{{0, 0, 0}, {0, 1, 0}, 0.25f}, {.pose = {{2, 1.25f, 0}}, .sensor = true});
    const Id bullet = world.add(Sphere{{0, 0, 0}, 0.1f}, {.pose = {{-3, 4, 0}}, .continuous = true});
    const Id removed = world.add(Sphere{{0, 0, 0}, 0.2f}, {.pose = {{0, 2, 0}}});
    world.update();
    world.move(crate, {{0.5f, 1.4f, 0}});
    world.move(bullet, {{3, 4, 0}});
    world.remove(removed);
    return world;
}

void check(std::span<const std::byte> bytes) {
    World3 world = example();
    const std::vector<std::byte> before = world.save();
    if (const std::optional<Problem> problem = world.restore(bytes)) {
        require(!problem->message.empty() && world.save() == before);
        return;
    }
    const std::vector<std::byte> again = world.save();
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
    World3 copy = world;
    for (World3* each : {&world, &copy}) {
        const Events events = each->update();
        require(events.began.size() + events.stayed.size() >= each->contacts().size() / 8);
        each->raycast_any({{0, 9, 0}, {0, -1, 0}});
        each->add(Sphere{{0, 0, 0}, 1});
        each->each_item([&](Id id) { each->remove(id); });
        each->update();
        require(each->size() == 0);
    }
    require(world.save() == copy.save());
    require(!world.restore(before) && world.save() == before);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    abut::fuzz::check_with_checksum(data, size, check, 4);
    return 0;
}
