#pragma once

// Points in 3D as a structure of arrays (SoA) for SIMD: all x, then all y, then all z.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>

namespace abut::detail {

/// Refers to memory owned elsewhere.
struct PointSoa {
    const float* x = nullptr;  ///< y begins `stride` floats later, and z another `stride`
    std::uint32_t stride = 0;  ///< a multiple of `max_lanes`; the last point is repeated up to it
    std::uint32_t count = 0;
    Vec3 reach{0.0f};   ///< the largest absolute coordinates
    Vec3 middle{0.0f};  ///< of their bounding box

    /// The maximum number of lanes of a SIMD target.
    static constexpr std::uint32_t max_lanes = 16;
    /// Sums of larger coordinates may overflow a float.
    static constexpr float max_coordinate = 0x1p120f;

    Vec3 point(std::uint32_t i) const { return {x[i], x[stride + i], x[2 * stride + i]}; }
};

/// Whether `farthest_point` can evaluate the points in float.
inline bool fits_soa(const PointSoa& points) {
    return points.reach.x <= PointSoa::max_coordinate && points.reach.y <= PointSoa::max_coordinate &&
           points.reach.z <= PointSoa::max_coordinate;
}

/// The SoA of some points in `memory`, which has space for 3 * padded_count(points.size()) floats.
PointSoa make_soa(std::span<const Vec3> points, float* memory);

constexpr std::size_t padded_count(std::size_t count) {
    return (count + PointSoa::max_lanes - 1) / PointSoa::max_lanes * PointSoa::max_lanes;
}

/// The index of the point with the largest dot product, evaluated in double as x + y + z; of several the lowest. All
/// points are evaluated in float with SIMD, then the possible maxima in double: the result is the same on every target.
/// The direction has any nonzero length.
std::uint32_t farthest_point(const PointSoa& points, const DVec<3>& direction);

}  // namespace abut::detail
