#pragma once

// The optional last argument of every query.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/gjk/trace.hpp>

namespace abut {

/// Any member may be left out: closest(a, b, {.cache = &cache, .margin = 0.1f}).
template <int D>
struct QueryOptions {
    /// Warm start: where the last search of this pair ended. The caller owns one cache for each pair. Queries of
    /// composite shapes ignore it.
    Cache* cache = nullptr;

    /// Records the steps of the engines.
    Trace<D>* trace = nullptr;

    /// Contacts: points whose surfaces are up to this far apart count too, with negative depth.
    float margin = 0;

    /// Rays: whether the back faces of a mesh count, whose corners are clockwise seen from the ray. A mirrored mesh
    /// keeps its front outside; a rounded mesh has no back.
    bool back_faces = true;
};

namespace detail {

/// The type that `{}` converts to if it could stand for options or another argument. No conversion makes a scalar of
/// `{}`, so overload resolution prefers this one (C++20, [over.ics.list]).
enum class EmptyBraces : unsigned char {};

}  // namespace detail

}  // namespace abut
