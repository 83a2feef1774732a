#pragma once

// Where do two shapes touch, and how must they move to come apart?

#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/constraints.hpp>

#include <array>
#include <cstddef>

namespace abut {

template <int D>
struct ContactPoint {
    Vec<D> position{};          ///< midway between the two surfaces along the normal; may lie outside of a deep pair
    float depth = 0;            ///< of the surfaces in one another, here, along the normal; below zero for a near miss
    std::uint32_t feature = 0;  ///< the same from frame to frame while the same corners and edges meet
};

/// Up to 2 points in 2D, 4 in 3D: the corners of the area in which the shapes meet.
template <int D>
class ContactPoints {
public:
    static constexpr std::size_t capacity = D == 2 ? 2 : 4;

    /// Written out, so that compilers fill it member by member: to clear all of it first, as they do otherwise, is
    /// slow.
    ContactPoints() {}

    const ContactPoint<D>* begin() const { return points_.data(); }
    const ContactPoint<D>* end() const { return points_.data() + count_; }
    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    const ContactPoint<D>& operator[](std::size_t i) const { return points_[i]; }
    void clear() { count_ = 0; }
    void push_back(const ContactPoint<D>& point) {
        // Number by number: what was just written in parts can't be read as a whole at once.
        ContactPoint<D>& added = points_[count_++];
        for (int i = 0; i < D; ++i) added.position[i] = point.position[i];
        added.depth = point.depth;
        added.feature = point.feature;
    }

private:
    std::array<ContactPoint<D>, capacity> points_;
    std::size_t count_ = 0;
};

template <int D>
struct Contact {
    Vec<D> normal{};          ///< of length 1, from A to B: moving B by depth * normal parts them
    float depth = 0;          ///< of the deepest point
    ContactPoints<D> points;  ///< none: the shapes don't touch
    Feature feature_a{};
    Feature feature_b{};

    explicit operator bool() const { return !points.empty(); }
};

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options = {});
template <int D>
Contact<D> contact(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options = {});
template <int D>
Contact<D> contact(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options = {});
template <>
Contact<2> contact(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options);

/// The contact of two touching or overlapping shapes; of composite ones, of their deepest pair of parts, or, where that
/// isn't felt, the deepest that each_contact tells. With a margin, of shapes up to so far apart as well.
template <class A, class B>
requires Pair<A, B> Contact<dimension<A>> contact(const A& a, const B& b,
                                                  const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b, [&](const auto& x, const auto& y) { return contact(x, y, options); });
}
template <class A, class B, class Why = detail::WhyNoPair<A, B>>
auto contact(const A& a, const B& b, const QueryOptions<detail::dimension_or_3<A>>& options = {});

}  // namespace abut
