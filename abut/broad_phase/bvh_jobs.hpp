#pragma once

// What several threads do, or one. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <cstdint>

namespace abut {

/// part(0) to part(count - 1), on threads where there are some.
template <class Part>
void run_side_by_side(Executor* executor, std::uint32_t count, Part&& part) {
    if (executor != nullptr && count > 1) return executor->run(count, part);
    for (std::uint32_t i = 0; i < count; ++i) part(i);
}

/// A bound so far out that sums of floats could overflow is none.
template <int D>
bool is_bounded(const Aabb<D>& box) {
    constexpr float far = 1e37f;
    for (int i = 0; i < D; ++i)
        if (box.min[i] < -far || box.max[i] > far) return false;
    return true;
}

}  // namespace abut
