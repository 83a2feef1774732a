#pragma once

// The check of numbers where a query enters the library. Functions inside rely on it. For .cpp files.

#include <abut/math/assert.hpp>
#include <abut/math/detail/rigid_path.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/ray.hpp>
#include <abut/query/hit.hpp>
#include <abut/shape/view/view.hpp>

#include <cmath>
#include <limits>

namespace abut::detail {

/// Its length may be infinite.
template <int D>
bool is_finite(const Ray<D>& ray) {
    // Sums of floats in double don't overflow.
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += static_cast<double>(ray.origin[i]) + static_cast<double>(ray.direction[i]);
    return std::abs(sum) <= std::numeric_limits<double>::max() && !std::isnan(ray.length);
}

template <int D>
bool is_finite(const Hit<D>& hit) {
    return is_finite(hit.point) && is_finite(hit.normal) && std::isfinite(hit.distance);
}

inline bool is_finite(const Pose2& pose) {
    return std::isfinite(pose.position.x + pose.position.y + (pose.rotation.cos + pose.rotation.sin));
}
inline bool is_finite(const Pose3& pose) {
    const glm::quat& q = pose.rotation;
    return std::isfinite(pose.position.x + pose.position.y + pose.position.z + (q.w + q.x + q.y + q.z));
}

inline bool is_finite(const Motion2& motion) {
    return is_finite(motion.from) && is_finite(motion.move) && std::isfinite(motion.turn);
}
inline bool is_finite(const Motion3& motion) {
    return is_finite(motion.from) && is_finite(motion.move) && is_finite(motion.turn);
}

template <int D>
bool is_finite(const RigidPath<D>& path) {
    double sum = angular_speed(path.angular_velocity);
    for (int i = 0; i < D; ++i) sum += path.start.offset[i] + path.move[i];
    for (const DVec<D>& column : path.start.column)
        for (int i = 0; i < D; ++i) sum += column[i];
    return std::isfinite(sum);
}

/// Whether all numbers of a query are finite; trips ABUT_ASSERT if not.
template <class... Inputs>
bool is_valid_query(const Inputs&... inputs) {
    const bool finite = (is_finite(inputs) && ...);
    ABUT_ASSERT(finite);
    return finite;
}

/// Like is_valid_query, for two shapes and more. Two half-spaces trip ABUT_ASSERT as well.
template <int D, class... Inputs>
bool is_valid_pair(const View<D>& a, const View<D>& b, const Inputs&... inputs) {
    const bool two_half_spaces =
        std::holds_alternative<HalfSpaceView<D>>(a) && std::holds_alternative<HalfSpaceView<D>>(b);
    ABUT_ASSERT(!two_half_spaces);
    return !two_half_spaces && is_valid_query(a, b, inputs...);
}
template <int D, class... Inputs>
bool is_valid_pair(const Convex<D>& a, const Convex<D>& b, const Inputs&... inputs) {
    return is_valid_query(a, b, inputs...);
}

}  // namespace abut::detail
