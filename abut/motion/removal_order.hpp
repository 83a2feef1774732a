#pragma once

// Disassembly order: the order in which shapes can be removed, one at a time, along one direction.

#include <abut/shape/view/view.hpp>

#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace abut {

struct RemovalOrder {
    /// Indices of the shapes in order of removal. If the shapes block one another, only those that can be removed
    /// before.
    std::vector<std::uint32_t> order;
    /// Empty if all shapes can be removed. Else each of these shapes is blocked by the next one, and the last by the
    /// first.
    std::vector<std::uint32_t> cycle;

    explicit operator bool() const { return cycle.empty(); }
};

/// Finds an order in which the shapes can be translated along `direction` (of any length but zero) to infinity without
/// penetrating the remaining ones. Sliding along a shape doesn't block, and neither does an overlap of the projections
/// by no more than the tolerance. Of several removable shapes the lowest index goes first.
///
/// In 2D an order always exists for shapes that overlap by no more than the tolerance (Guibas, Yao, "On translating a
/// set of rectangles", 1980): O(n log n). In 3D it always exists for balls, and for axis-aligned boxes along an axis.
/// Other shapes may block one another, as three rods can; then the cycle is reported. 3D takes O(n log n) and a test of
/// each pair whose swept boxes overlap.
///
/// NaN and infinity trip ABUT_ASSERT. In release such a shape blocks nothing and isn't blocked; along an invalid
/// direction nothing is blocked.
template <int D>
RemovalOrder removal_order(std::span<const detail::Convex<D>> shapes, const Vec<D>& direction);

}  // namespace abut

namespace abut::detail {

template <class Shapes>
using ElementOf = std::remove_cvref_t<decltype(*std::begin(std::declval<const Shapes&>()))>;

/// A range of convex shapes of one type, such as a std::vector<Polygon>.
template <class Shapes>
concept ConvexShapes = Shape<ElementOf<Shapes>> && is_convex_view<ViewOf<ElementOf<Shapes>>>;

}  // namespace abut::detail

namespace abut {

template <detail::ConvexShapes Shapes>
RemovalOrder removal_order(const Shapes& shapes, const Vec<dimension<detail::ElementOf<Shapes>>>& direction) {
    constexpr int D = dimension<detail::ElementOf<Shapes>>;
    detail::clear_upper_halves();
    std::vector<detail::Convex<D>> views;
    for (const auto& shape : shapes) views.push_back(view(shape));
    return removal_order(std::span<const detail::Convex<D>>(views), direction);
}

}  // namespace abut
