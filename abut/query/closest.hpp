#pragma once

// The signed distance of two shapes, with the closest points.

#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/view/constraints.hpp>

#include <limits>

namespace abut {

/// All fields are always valid, also for shapes that touch, coincide or are nested.
template <int D>
struct Closest {
    /// The gap, or minus the least translation that separates them; 0 if they touch. For composite shapes it is the
    /// minimum over all pairs of parts, and infinite if one has no parts.
    float distance = std::numeric_limits<float>::infinity();
    Vec<D> normal = first_axis();  ///< unit vector from A to B: moving B by -distance * normal makes them touch
    Vec<D> on_a{};                 ///< on the surface of A; on_b == on_a + distance * normal
    Vec<D> on_b{};                 ///< on the surface of B
    Feature feature_a{};
    Feature feature_b{};

private:
    static constexpr Vec<D> first_axis() {
        Vec<D> result{};
        result[0] = 1;
        return result;
    }
};

template <int D>
Closest<D> closest(const View<D>& a, const View<D>& b, const QueryOptions<D>& options = {});
template <int D>
Closest<D> closest(const detail::Convex<D>& a, const detail::Convex<D>& b, const QueryOptions<D>& options = {});
template <int D>
Closest<D> closest(const detail::ShapeRef<D>& a, const detail::ShapeRef<D>& b, const QueryOptions<D>& options = {});
template <>
Closest<2> closest(const detail::ShapeRef<2>& a, const detail::ShapeRef<2>& b, const QueryOptions<2>& options);
template <>
Closest<3> closest(const detail::ShapeRef<3>& a, const detail::ShapeRef<3>& b, const QueryOptions<3>& options);

/// The signed distance of two shapes, with the closest points and the direction between them. The error is at most 1e-5
/// x the size of the smaller shape. The depth of two solids, as `solid(mesh)` makes them, is a move that parts them,
/// mostly the least one. The depth of cylinders, cones and shapes known by a support function is a valid
/// separating move, at most 1e-3 x size above the least.
template <class A, class B>
requires Pair<A, B> Closest<dimension<A>> closest(const A& a, const B& b,
                                                  const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b, [&](const auto& x, const auto& y) { return closest(x, y, options); });
}
template <class A, class B, class Why = detail::WhyNoPair<A, B>>
requires(!(Shape<A> && detail::PointIn<B, detail::dimension_or_3<A>>)) auto closest(
    const A& a, const B& b, const QueryOptions<detail::dimension_or_3<A>>& options = {});

/// The point on a shape closest to a point: `on_a`. Inside, the distance is negative and `on_a` is the nearest point of
/// the surface.
template <Shape A>
Closest<dimension<A>> closest(const A& a, const Vec<dimension<A>>& point,
                              const QueryOptions<dimension<A>>& options = {}) {
    return closest(a, Ball<dimension<A>>{point, 0}, options);
}

}  // namespace abut
