#pragma once

// The first hit of a ray with a shape, whether there is one, or all its hits.

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
std::optional<Hit<D>> raycast(const Ray<D>& ray, const detail::Convex<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const detail::Composite<D>& shape,
                              const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const detail::ShapeRef<D>& shape, const QueryOptions<D>& options = {});

/// A mesh without a pose, without a view of it.
std::optional<Hit<3>> raycast(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options = {});

/// A solid level without a pose, by its tree. The hit is the first point where the ray passes from open space into the
/// solid. A ray that starts on a face and goes in hits at 0. A ray that starts inside leaves the solid first, and sets
/// `started_inside`. A ray along a face doesn't hit it. The feature's part is the number of the face, if there is one.
///
/// Placed by `at`, stretched, in a Compound or in a World, the level is a shape of convex parts like others: the ray
/// hits one of them, also if it starts inside another, and the feature's part is its number.
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>& options = {});

/// The first hit. A ray that starts inside or on the surface hits at 0 only if it goes further in; along the surface or
/// outwards it doesn't hit, and the search goes on behind it. A shape without an interior (a segment in the plane, a
/// triangle) is never hit by a ray that starts on it. "On" means within 16 ulp of the largest coordinate seen from the
/// start, about a millionth of it.
template <Shape S>
std::optional<Hit<dimension<S>>> raycast(const Ray<dimension<S>>& ray, const S& shape,
                                         const QueryOptions<dimension<S>>& options = {}) {
    detail::clear_upper_halves();
    if constexpr (detail::is_composite_view<detail::ViewOf<S>>) {
        const auto& shape_view = view(shape);
        detail::clear_upper_halves();
        return raycast(ray, shape_view, options);
    } else {
        const auto& shape_view = detail::view_for_pair<S, S>(shape);
        detail::clear_upper_halves();
        return raycast(ray, shape_view, options);
    }
}
template <int D, class S, class Why = detail::WhyNotIn<D, S>>
auto raycast(const Ray<D>& ray, const S& shape, const QueryOptions<D>& options = {});

template <int D>
bool raycast_any(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options = {});
template <int D>
bool raycast_any(const Ray<D>& ray, const detail::Composite<D>& shape, const QueryOptions<D>& options = {});

/// A mesh without a pose, without a view of it.
bool raycast_any(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options = {});

/// Whether `raycast` returns a hit. It stops at the first hit that it finds in a composite shape; on a mesh it takes
/// two thirds of the time of `raycast`.
template <Shape S>
bool raycast_any(const Ray<dimension<S>>& ray, const S& shape, const QueryOptions<dimension<S>>& options = {}) {
    if constexpr (detail::is_composite_view<detail::ViewOf<S>>) {
        detail::clear_upper_halves();
        const auto& shape_view = view(shape);
        detail::clear_upper_halves();
        return raycast_any(ray, shape_view, options);
    } else {
        return raycast(ray, shape, options).has_value();
    }
}
template <int D, class S, class Why = detail::WhyNotIn<D, S>>
bool raycast_any(const Ray<D>& ray, const S& shape, const QueryOptions<D>& options = {});

/// A solid level without a pose, by its tree.
template <int D>
bool raycast_any(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>& options = {}) {
    return raycast(ray, level, options).has_value();
}

template <int D>
void each_hit(const Ray<D>& ray, const View<D>& shape, FunctionRef<float(const Hit<D>&)> visit,
              const QueryOptions<D>& options = {});
template <int D>
void raycast_all(const Ray<D>& ray, const View<D>& shape, std::vector<Hit<D>>& out,
                 const QueryOptions<D>& options = {});

/// Visits each part of the shape that the ray hits, in no order, with the hit that `raycast` returns for that part
/// alone. A convex shape is one part, so the ray's exit is no hit. A ray through an edge that two triangles of a mesh
/// share hits both. `visit(hit)` returns nothing (go on), bool (false stops) or float: the distance along the ray up to
/// which further hits count. Never allocates.
template <Shape S, class Visit>
requires std::invocable < Visit&, const Hit<dimension<S>>
& > void each_hit(const Ray<dimension<S>>& ray, const S& shape, Visit&& visit,
                  const QueryOptions<dimension<S>>& options = {}) {
    constexpr int D = dimension<S>;
    using VisitResult = std::invoke_result_t<Visit&, const Hit<D>&>;
    const auto reach_visitor = [&visit](const Hit<D>& hit) -> float {
        constexpr float unlimited = std::numeric_limits<float>::infinity();
        if constexpr (std::is_void_v<VisitResult>) {
            visit(hit);
            return unlimited;
        } else if constexpr (std::is_same_v<VisitResult, bool>) {
            return visit(hit) ? unlimited : -1.0f;
        } else {
            return visit(hit);
        }
    };
    detail::with_view(shape, [&](const View<D>& shape_view) {
        each_hit<D>(ray, shape_view, FunctionRef<float(const Hit<D>&)>(reach_visitor), options);
    });
}

/// Replaces `out` by these hits, nearest first; of hits at one distance the lowest part comes first.
template <Shape S>
void raycast_all(const Ray<dimension<S>>& ray, const S& shape, std::vector<Hit<dimension<S>>>& out,
                 const QueryOptions<dimension<S>>& options = {}) {
    detail::with_view(
        shape, [&](const View<dimension<S>>& shape_view) { raycast_all<dimension<S>>(ray, shape_view, out, options); });
}

}  // namespace abut
