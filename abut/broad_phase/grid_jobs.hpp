#pragma once

// How a Grid cuts its work for several threads. For .cpp files.

#include <abut/math/executor.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut {

/// In so many parts, whatever the number of threads: so sums of parts are the same.
inline constexpr std::uint32_t parts_of_job = 32;

/// From and to, of so many things.
inline std::pair<std::size_t, std::size_t> part_of(std::size_t count, std::uint32_t part) {
    return {count * part / parts_of_job, count * (part + 1) / parts_of_job};
}

/// Below that many boxes, starting a thread costs more than it saves.
inline constexpr std::size_t grid_few = 4096;

/// Calls run(part) for all parts; by the executor, where there is one and enough to do.
template <class Part>
void run_parts(Executor* executor, std::size_t boxes, Part part) {
    if (executor != nullptr && boxes >= grid_few) return executor->run(parts_of_job, part);
    for (std::uint32_t i = 0; i < parts_of_job; ++i) part(i);
}

}  // namespace abut
