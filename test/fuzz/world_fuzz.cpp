// Programs of operations on a world: changes, updates by one and two threads, questions, snapshots, copies and the
// past. Each answer is that of a reference world, which tests every pair.

#include "../world/support/game.hpp"

#include <cstddef>
#include <cstdint>

namespace {

using namespace abut;

constexpr std::size_t bytes_per_operation = 2, max_operations = 300;

template <int D>
void play(const test::Scene& scene, const std::uint8_t* data, std::size_t size) {
    static ThreadPool pool(2);
    test::Seen seen;
    test::Game<D> game(scene, pool, seen);
    for (std::size_t i = 0; i + bytes_per_operation <= size && i < bytes_per_operation * max_operations;
         i += bytes_per_operation)
        game.step(std::uint64_t{data[i]} << 8 | data[i + 1]);
}

}  // namespace

/// The first byte selects the kind of game, each two bytes more are the seed of an operation.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    GTEST_FLAG_SET(break_on_failure, true);
    const test::Scene scene{data[0], 4 + data[0] % 32, (data[0] & 2u) != 0, (data[0] & 4u) != 0 ? 0.3 : 0};
    if ((data[0] & 1u) != 0)
        play<3>(scene, data + 1, size - 1);
    else
        play<2>(scene, data + 1, size - 1);
    return 0;
}
