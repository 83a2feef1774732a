#pragma once

// What every question takes as its optional last argument.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/gjk/trace.hpp>

namespace abut {

/// Any of them may be left out: closest(a, b, {.cache = &cache, .margin = 0.1f}).
template <int D>
struct QueryOptions {
    /// Where this pair's search ended last time, kept by the caller, one for each pair. Of composite
    /// shapes nothing is remembered.
    Cache* cache = nullptr;

    /// Is told what the engines do, step by step.
    Trace<D>* trace = nullptr;

    /// Contacts: points whose surfaces are up to this far apart count too, with a depth below zero.
    float margin = 0;

    /// Rays: whether the back of a mesh's triangles counts, the side from which their corners go round clockwise. A
    /// mesh that is mirrored keeps its front outside; one that is rounded has no back.
    bool back_faces = true;
};

namespace detail {

/// What `{}` is taken for where it could be options or something else of a question. No conversion makes a scalar of
/// it, so of several functions the one that takes this is the best (C++20, [over.ics.list]).
enum class EmptyBraces : unsigned char {};

}  // namespace detail

}  // namespace abut
