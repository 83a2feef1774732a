#pragma once

// Where does a ray meet a shape?

#include <abut/math/ray.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view.hpp>

#include <optional>

namespace abut {

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Convex<D>& shape, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Given<D>& shape, const QueryOptions<D>& options = {});

/// The first hit. A ray that starts inside or on the surface hits at 0 only if it goes further in; along the surface or
/// outwards is no hit, and the search goes on behind it.
template <Shape S>
std::optional<Hit<dimension<S>>> raycast(const Ray<dimension<S>>& ray, const S& shape,
                                         const QueryOptions<dimension<S>>& options = {}) {
    return raycast(ray, detail::view_beside<S, S>(shape), options);
}

}  // namespace abut
