#pragma once

// Checks and helpers for the input of hulls in 2D and 3D.

#include <abut/math/dvec.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::detail {

/// Nothing if the hull of the points can be built. Otherwise the problem, with the number of the first bad point.
template <int D>
std::optional<Problem> problem_with(std::span<const glm::vec<D, float>> points) {
    if (points.empty()) return Problem{ProblemCode::empty_input, "there are no points to build from", 0};
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite<D>(points[i]))
            return Problem{ProblemCode::not_finite, "point " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

/// The lexicographical order.
template <int D>
bool less(const glm::vec<D, float>& a, const glm::vec<D, float>& b) {
    for (int i = 0; i < D - 1; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return a[D - 1] < b[D - 1];
}

/// The same point, with 0 for -0: two that compare equal then have equal bits.
template <int D>
glm::vec<D, float> without_negative_zero(const glm::vec<D, float>& point) {
    return point + glm::vec<D, float>(0.0f);
}

/// The points in lexicographical order, each once, with 0 for -0.
inline std::vector<Vec3> sorted_without_copies(std::vector<Vec3> points) {
    for (Vec3& point : points) point = without_negative_zero(point);
    std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// The longest side of the bounding box.
template <int D>
double extent(std::span<const Vec<D>> points) {
    return largest(min_max<D>(points).sides());
}

}  // namespace abut::detail
