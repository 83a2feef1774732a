#pragma once

// An outline and its holes, given as rings of one array of points. For .cpp files.

#include <abut/c/detail/fault.hpp>
#include <abut/math/vec.hpp>

#include <vector>

namespace abut::detail {

/// The ends of rings ascend up to the number of points.
inline Fault fault_of_ends(const std::uint32_t* ends, std::uint32_t ring_count, std::uint32_t point_count) {
    if (ring_count == 0) return {ABUT_EMPTY_INPUT, "ends", "has no ring"};
    if (ends == nullptr) return {ABUT_NULL_ARGUMENT, "ends", "is null"};
    std::uint32_t begin = 0;
    for (std::uint32_t i = 0; i < ring_count; begin = ends[i], ++i)
        if (ends[i] < begin || ends[i] > point_count)
            return {ABUT_INDEX_OUT_OF_RANGE, "ends", "does not ascend up to the number of points", i};
    return {};
}

/// The rings; the first is the outline.
inline std::vector<std::vector<Vec2>> rings_of(const Strided<abut_vec2>& points, const std::uint32_t* ends,
                                               std::uint32_t ring_count) {
    std::vector<std::vector<Vec2>> rings(ring_count);
    std::uint32_t begin = 0;
    for (std::uint32_t k = 0; k < ring_count; begin = ends[k], ++k)
        for (std::uint32_t i = begin; i < ends[k]; ++i) rings[k].push_back(same_bytes<Vec2>(points[i]));
    return rings;
}

}  // namespace abut::detail
