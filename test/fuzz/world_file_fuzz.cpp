// Loads a world from any bytes: the load refuses them, or the world is saved and loaded again as it was, and can be
// used.

#include "bytes.hpp"
#include "with_checksum.hpp"
#include <abut/world/file.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

template <int D>
void check(std::span<const std::byte> bytes) {
    Result<World<D>> world = load_world<D>(bytes);
    if (!world) {
        require(!world.problem().message.empty());
        return;
    }
    const Result<std::vector<std::byte>> again = save_with_shapes(*world);
    require(static_cast<bool>(again));
    Result<World<D>> loaded = load_world<D>(*again);
    require(loaded && loaded->save() == world->save());
    world->update();
    loaded->update();
    require(loaded->save() == world->save());
    world->raycast_any(Ray<D>::between(Vec<D>(-9.0f), Vec<D>(9.0f)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    abut::fuzz::check_with_checksum(
        data, size,
        [](std::span<const std::byte> bytes) {
            check<2>(bytes);
            check<3>(bytes);
        },
        8);
    return 0;
}
