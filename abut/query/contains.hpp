#pragma once

// Is a point in a shape?

#include <abut/shape/view/constraints.hpp>

namespace abut {

template <int D>
bool contains(const View<D>& shape, const Vec<D>& point);

/// True inside and on the surface. A closed Mesh or Chain and a SolidBsp are solid here; of open ones, and of other
/// composites, the points of the parts count.
template <Shape S>
bool contains(const S& shape, const Vec<dimension<S>>& point) {
    return detail::with_view(shape, [&](const View<dimension<S>>& seen) { return contains(seen, point); });
}
template <class S, int D, class Why = detail::WhyNotIn<D, S>>
auto contains(const S& shape, const glm::vec<D, float>& point);

}  // namespace abut
