#pragma once

// What a ray through a scene or a level hits, and what it hits after that where things are mirrors.

#include "objects.hpp"
#include "progress.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace abut::tool {

template <int D>
struct CastOptions {
    Vec<D> from{}, to{};
    std::size_t bounces = 0;  ///< none: the ray ends at `to`. Else it goes on without end, thrown back so many times
    bool all = false;         ///< without bounces: it goes through what is in the way
};

template <int D>
struct CastHit {
    std::size_t object = 0;
    Ray<D> ray;            ///< the straight piece that ends in it, from `from` or the hit before
    Hit<D> hit;            ///< its distance is the length of that piece
    double travelled = 0;  ///< from `from`
};

template <int D>
struct CastResult {
    std::vector<CastHit<D>> hits;  ///< in order; one more than bounces at most, or the first on each thing
    std::optional<Vec<D>> end;     ///< where the ray ends; none where it leaves the scene and goes on without end
    Ray<D> last;                   ///< the piece that hits nothing, or ends in the last hit
};

/// The objects are where they were last taken to. Progress is told in hits, of as many as there can be.
template <int D>
CastResult<D> cast(const Objects<D>& objects, const CastOptions<D>& options, ProgressCall progress);

}  // namespace abut::tool
