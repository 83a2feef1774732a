#pragma once

// Parts shared by all query visitors: ray against box, distance of a point from a box, and the k nearest boxes.

#include "../bench.hpp"
#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace abut::bench {

/// A side that answers each query by answer(query).
template <class Query, class Answer>
Side each_query(std::string who, std::span<const Query> queries, Answer answer) {
    return {std::move(who), [stored = std::vector<Query>(queries.begin(), queries.end()),
                             answer = std::move(answer)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = answer(stored[i]);
            }};
}

/// A ray prepared for many boxes.
struct RayToBox {
    RayToBox(const Ray3& ray) : origin(ray.origin), inverse(1.0f / ray.direction), length(ray.length) {}
    Vec3 origin, inverse;
    float length;
};

/// The distance along the ray to the box, 0 inside it; infinite for a miss.
inline float entry(const RayToBox& ray, const Aabb3& box) {
    const Vec3 first = (box.min - ray.origin) * ray.inverse, second = (box.max - ray.origin) * ray.inverse;
    const Vec3 low = glm::min(first, second), high = glm::max(first, second);
    const float enter = std::max({low.x, low.y, low.z, 0.0f}), leave = std::min({high.x, high.y, high.z, ray.length});
    return enter <= leave ? enter : std::numeric_limits<float>::infinity();
}

inline float squared_distance(const Vec3& point, const Aabb3& box) {
    const Vec3 gap = glm::max(glm::max(box.min - point, point - box.max), 0.0f);
    return glm::dot(gap, gap);
}

/// The k smallest squared distances.
class Nearest {
public:
    static constexpr std::size_t capacity = 16;

    explicit Nearest(std::size_t count) : count_(count) { std::fill_n(squares_, count, infinity); }

    void add(float square) {
        if (!(square < farthest())) return;
        std::size_t i = count_ - 1;
        for (; i > 0 && squares_[i - 1] > square; --i) squares_[i] = squares_[i - 1];
        squares_[i] = square;
    }
    /// Distances that are not smaller are ignored.
    float farthest() const { return squares_[count_ - 1]; }
    double sum_of_distances() const {
        double sum = 0;
        for (std::size_t i = 0; i < count_; ++i) sum += std::sqrt(static_cast<double>(squares_[i]));
        return sum;
    }

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    std::size_t count_;
    float squares_[capacity];
};

}  // namespace abut::bench
