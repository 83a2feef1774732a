#pragma once

// In which order things can be taken away, one at a time and all in one direction.

#include <abut/shape/view.hpp>

#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace abut {

struct RemovalOrder {
    /// Indices of shapes: the first leaves first. All of them; or those that can leave before the others block one
    /// another.
    std::vector<std::uint32_t> order;
    /// Empty where all can leave. Else each of these shapes is blocked by the one after it, and the last by the first.
    std::vector<std::uint32_t> cycle;

    explicit operator bool() const { return cycle.empty(); }
};

/// An order in which the shapes can be moved away along `direction` (of any length but zero), each as far as one likes,
/// without running into those that are still there. To slide along another is no obstacle, and neither is one that is
/// met by no more than the margin of doubt to the side. Of several that could leave next it is the lowest index.
///
/// In 2D there always is one, for shapes that overlap by no more than that margin (Guibas, Yao, "On translating a set
/// of rectangles", 1980): O(n log n). In 3D there always is one for balls, and for axis-aligned boxes along an axis;
/// other shapes may block one another, as three sticks can: then a cycle of them is named. O(n log n) and a look at
/// each pair of which one's box passes the other's.
///
/// NaN and infinity trip ABUT_ASSERT; in release a shape with one blocks nothing and is blocked by nothing, and along a
/// direction with one, or of no length, nothing is blocked.
template <int D>
RemovalOrder removal_order(std::span<const Convex<D>> shapes, const Vec<D>& direction);

namespace detail {

template <class Shapes>
using ElementOf = std::remove_cvref_t<decltype(*std::begin(std::declval<const Shapes&>()))>;

}  // namespace detail

/// Many convex shapes of one type, such as a std::vector<Polygon>.
template <class Shapes>
concept ConvexShapes =
    Shape<detail::ElementOf<Shapes>> && detail::is_convex_view<detail::ViewOf<detail::ElementOf<Shapes>>>;

template <ConvexShapes Shapes>
RemovalOrder removal_order(const Shapes& shapes, const Vec<dimension<detail::ElementOf<Shapes>>>& direction) {
    constexpr int D = dimension<detail::ElementOf<Shapes>>;
    std::vector<Convex<D>> views;
    for (const auto& shape : shapes) views.push_back(view(shape));
    return removal_order(std::span<const Convex<D>>(views), direction);
}

}  // namespace abut
