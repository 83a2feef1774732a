#pragma once

// Whether a shape contains a point.

#include <abut/shape/view/constraints.hpp>

namespace abut {

template <int D>
bool contains(const View<D>& shape, const Vec<D>& point);

/// True inside and on the surface. A closed Mesh or Chain and a SolidBsp are solid here. An open one, and any other
/// composite, contains the points of its parts.
template <Shape S>
bool contains(const S& shape, const Vec<dimension<S>>& point) {
    return detail::with_view(shape, [&](const View<dimension<S>>& shape_view) { return contains(shape_view, point); });
}
template <class S, int D, class Why = detail::WhyNotIn<D, S>>
auto contains(const S& shape, const glm::vec<D, float>& point);

}  // namespace abut
