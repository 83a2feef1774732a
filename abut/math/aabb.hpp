#pragma once

// The axis-aligned bounding box (AABB), which the broad phases work on.

#include <abut/math/detail/next_float.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

/// An axis-aligned box. It is closed: touching counts as overlapping. An infinite coordinate means unbounded on that
/// side.
template <int D>
struct Aabb {
    Vec<D> min{};
    Vec<D> max{};

    /// The empty box. It overlaps nothing and is the neutral element of `merged`.
    static Aabb empty() {
        return {Vec<D>(std::numeric_limits<float>::infinity()), Vec<D>(-std::numeric_limits<float>::infinity())};
    }

    friend bool operator==(const Aabb&, const Aabb&) = default;
};
template <int D>
Aabb(glm::vec<D, float>, glm::vec<D, float>) -> Aabb<D>;

using Aabb2 = Aabb<2>;
using Aabb3 = Aabb<3>;

/// Also false if either box is empty or has a NaN coordinate.
template <int D>
bool overlaps(const Aabb<D>& a, const Aabb<D>& b) {
    bool result = true;
    for (int i = 0; i < D; ++i)
        result = result && a.min[i] <= b.max[i] && b.min[i] <= a.max[i] && a.min[i] <= a.max[i] && b.min[i] <= b.max[i];
    return result;
}

template <int D>
bool contains(const Aabb<D>& box, const Vec<D>& point) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && box.min[i] <= point[i] && point[i] <= box.max[i];
    return result;
}

/// True if a contains all of b.
template <int D>
bool contains(const Aabb<D>& a, const Aabb<D>& b) {
    return contains(a, b.min) && contains(a, b.max);
}

/// The smallest box that contains both.
template <int D>
Aabb<D> merged(const Aabb<D>& a, const Aabb<D>& b) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = std::min(a.min[i], b.min[i]);
        result.max[i] = std::max(a.max[i], b.max[i]);
    }
    return result;
}

/// The box extended by `distance` on every side, rounded outwards.
template <int D>
Aabb<D> grown(const Aabb<D>& box, float distance) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = detail::next_down(box.min[i] - distance);
        result.max[i] = detail::next_up(box.max[i] + distance);
    }
    return result;
}

/// The center; for an unbounded box some point in it.
template <int D>
Vec<D> center(const Aabb<D>& box) {
    Vec<D> result;
    constexpr float largest = std::numeric_limits<float>::max();
    for (int i = 0; i < D; ++i)
        result[i] = 0.5f * std::clamp(box.min[i], -largest, largest) + 0.5f * std::clamp(box.max[i], -largest, largest);
    return result;
}

}  // namespace abut
