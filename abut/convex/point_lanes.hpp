#pragma once

// Many points of space as vector units like to read them: all x, then all y, then all z.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>

namespace abut {

/// Refers to memory kept elsewhere.
struct PointLanes {
    const float* x = nullptr;  ///< y begins `stride` floats later, and z another `stride`
    std::uint32_t stride = 0;  ///< a multiple of `at_once`; up to there the last point is repeated
    std::uint32_t count = 0;
    Vec3 reach{0.0f};   ///< the largest absolute coordinates
    Vec3 middle{0.0f};  ///< of their box

    /// The most that a vector unit looks at in one go.
    static constexpr std::uint32_t at_once = 16;
    /// The sums of coordinates beyond this may not be floats.
    static constexpr float most = 0x1p120f;

    Vec3 point(std::uint32_t i) const { return {x[i], x[stride + i], x[2 * stride + i]}; }
};

/// Whether `farthest_point` takes them.
inline bool fits_lanes(const PointLanes& points) {
    return points.reach.x <= PointLanes::most && points.reach.y <= PointLanes::most &&
           points.reach.z <= PointLanes::most;
}

/// The lanes of some points in `memory`, which holds 3 * padded_count(points.size()) floats.
PointLanes lay_out(std::span<const Vec3> points, float* memory);

constexpr std::size_t padded_count(std::size_t count) {
    return (count + PointLanes::at_once - 1) / PointLanes::at_once * PointLanes::at_once;
}

/// The index of the point with the largest dot product, worked out in double as x + y + z; of several the lowest. First
/// in float, as many at a time as the machine's vectors hold, and then in double those that may be it: the same answer
/// whatever the machine. The direction has any length but zero.
std::uint32_t farthest_point(const PointLanes& points, const DVec<3>& direction);

}  // namespace abut
