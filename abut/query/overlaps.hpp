#pragma once

// Whether two shapes share a point.

#include <abut/query/options.hpp>
#include <abut/shape/view/constraints.hpp>

namespace abut {

template <int D>
bool overlaps(const View<D>& a, const View<D>& b, const QueryOptions<D>& options = {});
template <int D>
bool overlaps(const detail::Convex<D>& a, const detail::Convex<D>& b, const QueryOptions<D>& options = {});
template <int D>
bool overlaps(const detail::ShapeRef<D>& a, const detail::ShapeRef<D>& b, const QueryOptions<D>& options = {});
template <>
bool overlaps(const detail::ShapeRef<2>& a, const detail::ShapeRef<2>& b, const QueryOptions<2>& options);
template <>
bool overlaps(const detail::ShapeRef<3>& a, const detail::ShapeRef<3>& b, const QueryOptions<3>& options);

/// True if the shapes overlap or touch. This is cheaper than `closest`: it stops at the first separating axis.
template <class A, class B>
requires Pair<A, B>
bool overlaps(const A& a, const B& b, const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b, [&](const auto& x, const auto& y) { return overlaps(x, y, options); });
}
template <class A, class B, class Why = detail::WhyNoPair<A, B>>
auto overlaps(const A& a, const B& b, const QueryOptions<detail::dimension_or_3<A>>& options = {});

}  // namespace abut
