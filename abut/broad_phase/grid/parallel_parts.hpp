#pragma once

// The division of a Grid's work into parts for several threads. For .cpp files.

#include <abut/math/executor.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut::detail {

/// The number of parts doesn't depend on the number of threads, so that sums over the parts are always the same.
inline constexpr std::uint32_t part_count = 32;

/// The range of a part among `count` elements.
inline std::pair<std::size_t, std::size_t> range_of_part(std::size_t count, std::uint32_t part) {
    return {count * part / part_count, count * (part + 1) / part_count};
}

/// With fewer boxes, starting a thread costs more than it saves.
inline constexpr std::size_t grid_min_parallel_count = 4096;

/// Calls run(part) for all parts: by the executor if there is one and the boxes are many, else in order.
template <class Part>
void run_parts(Executor* executor, std::size_t boxes, Part part) {
    if (executor != nullptr && boxes >= grid_min_parallel_count) return executor->run(part_count, part);
    for (std::uint32_t i = 0; i < part_count; ++i) part(i);
}

}  // namespace abut::detail
