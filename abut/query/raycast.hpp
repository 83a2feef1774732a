#pragma once

// Where does a ray meet a shape?

#include <abut/math/ray.hpp>
#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view.hpp>

#include <optional>

namespace abut {

/// Contact gained by a motion.
template <int D>
struct Hit {
    float fraction = 0;           ///< of the motion, in [0, 1]; 0 for a ray of infinite length
    float distance = 0;           ///< along the motion
    Vec<D> point{};               ///< where they touch at that moment
    Vec<D> normal{};              ///< of length 1, facing the mover or the ray's origin
    bool started_inside = false;  ///< the motion started deeper in than rounding explains
    Feature feature{};
};

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
