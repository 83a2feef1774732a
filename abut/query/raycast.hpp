#pragma once

// Where does a ray meet a shape?

#include <abut/math/function_ref.hpp>
#include <abut/math/ray.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/constraints.hpp>

#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace abut {

class Mesh;
template <int D>
class SolidBsp;

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Convex<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Composite<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const ShapeRef<D>& shape, const QueryOptions<D>& options = {});

/// A mesh where it was made, without a view of it.
std::optional<Hit<3>> raycast(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options = {});

/// A solid level where it was made, by its tree: query/raycast_solid_bsp.hpp tells what the answer means.
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>& options = {});

/// The first hit. A ray that starts inside or on the surface hits at 0 only if it goes further in; along the surface or
/// outwards is no hit, and the search goes on behind it. What has no inside, a segment of the plane or a triangle, is
/// left by a ray that starts on it, whichever way it goes: within 16 units in the last place of the largest coordinate
/// seen from there, a millionth of it.
template <Shape S>
std::optional<Hit<dimension<S>>> raycast(const Ray<dimension<S>>& ray, const S& shape,
                                         const QueryOptions<dimension<S>>& options = {}) {
    detail::clear_upper_halves();
    if constexpr (detail::is_composite_view<detail::ViewOf<S>>) {
        const auto& seen = view(shape);
        detail::clear_upper_halves();
        return raycast(ray, seen, options);
    } else {
        const auto& seen = detail::view_for_pair<S, S>(shape);
        detail::clear_upper_halves();
        return raycast(ray, seen, options);
    }
}
template <int D, class S, class Why = detail::WhyNotIn<D, S>>
auto raycast(const Ray<D>& ray, const S& shape, const QueryOptions<D>& options = {});

template <int D>
void each_hit(const Ray<D>& ray, const View<D>& shape, FunctionRef<float(const Hit<D>&)> visit,
              const QueryOptions<D>& options = {});
template <int D>
void raycast_all(const Ray<D>& ray, const View<D>& shape, std::vector<Hit<D>>& out,
                 const QueryOptions<D>& options = {});

/// Each part of the shape that the ray hits, as `raycast` tells it of that part alone, in no order: a convex shape is
/// one part, so that it is told where the ray comes in and not where it leaves; through an edge that two triangles of a
/// mesh share both are told. `visit(hit)` returns nothing (go on), bool (false stops) or float: how far along the ray
/// hits are still wanted. Never allocates.
template <Shape S, class Visit>
requires std::invocable < Visit&, const Hit<dimension<S>>
& > void each_hit(const Ray<dimension<S>>& ray, const S& shape, Visit&& visit,
                  const QueryOptions<dimension<S>>& options = {}) {
    constexpr int D = dimension<S>;
    using Told = std::invoke_result_t<Visit&, const Hit<D>&>;
    const auto reach_after = [&visit](const Hit<D>& hit) -> float {
        constexpr float any = std::numeric_limits<float>::infinity();
        if constexpr (std::is_void_v<Told>) {
            visit(hit);
            return any;
        } else if constexpr (std::is_same_v<Told, bool>) {
            return visit(hit) ? any : -1.0f;
        } else {
            return visit(hit);
        }
    };
    detail::with_view(shape, [&](const View<D>& seen) {
        each_hit<D>(ray, seen, FunctionRef<float(const Hit<D>&)>(reach_after), options);
    });
}

/// The same hits in place of what was in `out`, the nearest first; of those at one distance, the lowest part.
template <Shape S>
void raycast_all(const Ray<dimension<S>>& ray, const S& shape, std::vector<Hit<dimension<S>>>& out,
                 const QueryOptions<dimension<S>>& options = {}) {
    detail::with_view(shape,
                      [&](const View<dimension<S>>& seen) { raycast_all<dimension<S>>(ray, seen, out, options); });
}

}  // namespace abut
