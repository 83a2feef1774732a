// Memory from a game's own allocator. The library requests all its memory by operator new, so replacing that is enough.
#include <abut/abut.hpp>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

namespace game {
namespace {

std::atomic<long> blocks = 0, requests = 0;

// The pair of functions, here over malloc.
void* allocate(std::size_t size, std::size_t alignment) {
    ++requests;
    ++blocks;
    const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
    if (memory == nullptr) std::abort();
    return memory;
}
void release(void* memory) {
    if (memory != nullptr) --blocks;
    std::free(memory);
}

}  // namespace
}  // namespace game

void* operator new(std::size_t size) {
    return game::allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return game::allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    game::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    game::release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    game::release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    game::release(memory);
}

int main() {
    const long before = game::blocks;
    long in_world = 0, at_rest = 0;
    {
        abut::World3 world;
        std::vector<abut::Id> ids;
        for (int i = 0; i < 1000; ++i) {
            const auto x = static_cast<float>(i % 32), z = static_cast<float>(i / 32);
            ids.push_back(world.add(abut::Sphere{{1.5f * x, 0, 1.5f * z}, 1}));
        }
        world.update();
        in_world = game::blocks - before;

        // A world that has seen such a frame before requests nothing.
        for (int frame = 0; frame < 3; ++frame) {
            const long requests = game::requests;
            for (std::size_t i = 0; i < ids.size(); ++i)
                world.move(ids[i], {{0, 0.01f * static_cast<float>((static_cast<int>(i) + frame) % 3), 0}});
            world.update();
            at_rest = game::requests - requests;
        }
    }
    std::printf("a world of 1000 spheres: %ld blocks, %ld more in a later frame, %ld left at the end\n", in_world,
                at_rest, game::blocks - before);
    return in_world > 0 && at_rest == 0 && game::blocks == before ? 0 : 1;
}
