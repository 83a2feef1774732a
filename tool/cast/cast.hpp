#pragma once

// Casts rays through a scene or a level, with or without reflections.

#include "tool/objects/objects.hpp"
#include "tool/shared/progress.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace abut::tool {

template <int D>
struct CastOptions {
    Vec<D> from{}, to{};
    std::size_t bounces =
        0;             ///< 0: the ray ends at `to`; else it continues without end and is reflected this many times
    bool all = false;  ///< without bounces: report all objects on the ray
};

template <int D>
struct CastHit {
    std::size_t object = 0;
    Ray<D> ray;            ///< the segment that ends at the hit, from `from` or the last hit
    Hit<D> hit;            ///< its distance is the length of that segment
    double travelled = 0;  ///< path length from `from`
};

template <int D>
struct CastResult {
    std::vector<CastHit<D>> hits;  ///< in order; at most bounces + 1, or the first hit on each object
    std::optional<Vec<D>> end;     ///< end of the ray; none if it leaves the scene
    Ray<D> last;                   ///< the segment after the last hit, or the one that ends there
};

/// Casts a ray against the objects at their current poses. Progress counts hits of the maximum possible.
template <int D>
CastResult<D> cast(const Objects<D>& objects, const CastOptions<D>& options, ProgressCall progress);

}  // namespace abut::tool
