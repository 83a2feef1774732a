#pragma once

// The contact of two shapes: where they touch, and the least move that separates them.

#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/constraints.hpp>

#include <array>
#include <cstddef>

namespace abut {

template <int D>
struct ContactPoint {
    Vec<D> position{};          ///< midway between the two surfaces along the normal; of a deep pair it may lie outside
    float depth = 0;            ///< penetration at this point along the normal; negative for a near miss
    std::uint32_t feature = 0;  ///< constant from frame to frame while the same corners and edges touch
};

/// The contact manifold, up to 2 points in 2D and 4 in 3D: the corners of the contact area.
template <int D>
class ContactPoints {
public:
    static constexpr std::size_t capacity = D == 2 ? 2 : 4;

    /// Empty, so that compilers fill the members one by one: clearing them all first is slow.
    ContactPoints() {}

    const ContactPoint<D>* begin() const { return points_.data(); }
    const ContactPoint<D>* end() const { return points_.data() + count_; }
    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    const ContactPoint<D>& operator[](std::size_t i) const { return points_[i]; }
    void clear() { count_ = 0; }
    void push_back(const ContactPoint<D>& point) {
        // Member by member: values just written one by one can't be loaded as a whole without a stall.
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
    Vec<D> normal{};          ///< unit vector from A to B: moving B by depth * normal separates them
    float depth = 0;          ///< of the deepest point
    ContactPoints<D> points;  ///< empty if the shapes don't touch
    Feature feature_a{};
    Feature feature_b{};

    explicit operator bool() const { return !points.empty(); }
};

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options = {});
template <int D>
Contact<D> contact(const detail::Convex<D>& a, const detail::Convex<D>& b, const QueryOptions<D>& options = {});
template <int D>
Contact<D> contact(const detail::ShapeRef<D>& a, const detail::ShapeRef<D>& b, const QueryOptions<D>& options = {});
template <>
Contact<2> contact(const detail::ShapeRef<2>& a, const detail::ShapeRef<2>& b, const QueryOptions<2>& options);
template <>
Contact<3> contact(const detail::ShapeRef<3>& a, const detail::ShapeRef<3>& b, const QueryOptions<3>& options);

/// The contact of two touching or overlapping shapes. Composite shapes return the deepest contact of each_contact: that
/// of the plane of their deepest pair of parts, unless that pair touches on an internal edge. Two meshes always return
/// that of the deepest pair, with the depth and the normal of `closest`; two solids that of the move that parts them.
/// With a margin, shapes up to that far apart count as well.
template <class A, class B>
requires Pair<A, B> Contact<dimension<A>> contact(const A& a, const B& b,
                                                  const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b, [&](const auto& x, const auto& y) { return contact(x, y, options); });
}
template <class A, class B, class Why = detail::WhyNoPair<A, B>>
auto contact(const A& a, const B& b, const QueryOptions<detail::dimension_or_3<A>>& options = {});

}  // namespace abut
