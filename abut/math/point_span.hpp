#pragma once

// Views of the vertex and index buffers of a game, for the functions that build shapes.

#include <abut/math/assert.hpp>
#include <abut/math/vec.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {
namespace detail {

/// A class whose members x, y (and z, in 3D) are adjacent floats.
template <class T, int D>
constexpr bool has_adjacent_floats() {
    if constexpr (!std::is_standard_layout_v<T>) {
        return false;
    } else if constexpr (requires {
                             requires std::same_as<decltype(T::x), float> && std::same_as<decltype(T::y), float>;
                         }) {
        constexpr bool has_z = requires {
            T::z;
        };
        if constexpr (offsetof(T, y) != offsetof(T, x) + sizeof(float) || has_z != (D == 3)) {
            return false;
        } else if constexpr (D == 3) {
            if constexpr (std::same_as<decltype(T::z), float>) return offsetof(T, z) == offsetof(T, y) + sizeof(float);
            return false;
        } else {
            return true;
        }
    } else {
        return false;
    }
}

template <class R, int D>
concept RangeOfOwnPoints = requires(const R& range) {
    { std::size(range) } -> std::convertible_to<std::size_t>;
    requires std::is_pointer_v<decltype(std::data(range))>;
    requires has_adjacent_floats<std::remove_cvref_t<decltype(*std::data(range))>, D>();
};

template <int D>
class PackedPoints;

}  // namespace detail

/// A view of points that lie at equal distances in memory, such as the positions of a vertex buffer. Functions that
/// take one also take whatever converts to a std::span<const Vec<D>>.
template <int D>
class PointSpan {
public:
    PointSpan() = default;

    PointSpan(std::span<const Vec<D>> points) : vectors_(points.data()), count_(points.size()) {}
    template <class R>
    requires std::constructible_from<std::span<const Vec<D>>, R> PointSpan(R&& points)
        : PointSpan(std::span<const Vec<D>>(std::forward<R>(points))) {}
    PointSpan(const Vec<D>* first, std::size_t count) : vectors_(first), count_(count) {}
    template <class It, class End>
    requires(!std::integral<End> && std::constructible_from<std::span<const Vec<D>>, It, End>)
        PointSpan(It first, End last)
        : PointSpan(std::span<const Vec<D>>(first, last)) {}

    /// A std::vector, std::span or array of a game's own points, whose members x, y (and z, in 3D) are adjacent floats.
    template <class R>
    requires(!std::constructible_from<std::span<const Vec<D>>, const R&> && detail::RangeOfOwnPoints<R, D>)
        PointSpan(const R& points)
        : count_(std::size(points)), stride_(sizeof(*std::data(points))) {
        using Point = std::remove_cvref_t<decltype(*std::data(points))>;
        if (count_ > 0) first_ = reinterpret_cast<const std::byte*>(std::data(points)) + offsetof(Point, x);
    }

    /// `count` points of D floats each. `stride` is the distance of two points in bytes, at least the size of one.
    PointSpan(const float* first, std::size_t count, std::size_t stride = sizeof(Vec<D>))
        : first_(reinterpret_cast<const std::byte*>(first)), count_(count), stride_(stride) {
        ABUT_ASSERT((first != nullptr || count == 0) && stride >= sizeof(Vec<D>));
    }

    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    Vec<D> operator[](std::size_t i) const {
        if (vectors_ != nullptr) return vectors_[i];
        Vec<D> point;
        std::memcpy(&point, first_ + i * stride_, sizeof(point));
        return point;
    }

private:
    friend detail::PackedPoints<D>;

    const Vec<D>* vectors_ = nullptr;  // either this or the next
    const std::byte* first_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
};

/// The triangles of a flat index buffer, read in place: corners 0, 1 and 2 are the first triangle. Misuse if the count
/// isn't a multiple of 3; a release build leaves the rest out.
inline std::span<const glm::uvec3> as_triangles(std::span<const std::uint32_t> indices) {
    ABUT_ASSERT(indices.size() % 3 == 0);
    return {reinterpret_cast<const glm::uvec3*>(indices.data()), indices.size() / 3};
}

namespace detail {

/// The points of a PointSpan as an array: vectors of glm in place, others as a copy.
template <int D>
class PackedPoints {
public:
    explicit PackedPoints(const PointSpan<D>& points) {
        if (points.vectors_ != nullptr) {
            points_ = {points.vectors_, points.count_};
        } else {
            copied_.reserve(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) copied_.push_back(points[i]);
            points_ = copied_;
        }
    }
    PackedPoints(const PackedPoints&) = delete;
    PackedPoints& operator=(const PackedPoints&) = delete;

    std::span<const Vec<D>> points() const { return points_; }

private:
    std::vector<Vec<D>> copied_;
    std::span<const Vec<D>> points_;
};

}  // namespace detail
}  // namespace abut
