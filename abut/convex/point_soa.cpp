#include <abut/convex/point_soa.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

PointSoa make_soa(std::span<const Vec3> points, float* memory) {
    PointSoa lanes;
    lanes.x = memory;
    lanes.count = static_cast<std::uint32_t>(points.size());
    lanes.stride = static_cast<std::uint32_t>(padded_count(points.size()));
    for (int axis = 0; axis < 3; ++axis) {
        float* column = memory + static_cast<std::uint32_t>(axis) * lanes.stride;
        float low = points[0][axis], high = low;
        for (std::uint32_t i = 0; i < lanes.stride; ++i) {
            column[i] = points[std::min(i, lanes.count - 1)][axis];
            low = std::min(low, column[i]);
            high = std::max(high, column[i]);
        }
        lanes.reach[axis] = std::max(std::abs(low), std::abs(high));
        lanes.middle[axis] = 0.5f * low + 0.5f * high;
    }
    return lanes;
}

}  // namespace abut::detail
