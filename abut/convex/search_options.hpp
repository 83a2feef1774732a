#pragma once

// What the searches of this folder take beside the two shapes.

#include <abut/convex/cache.hpp>
#include <abut/convex/trace.hpp>

namespace abut {

template <int D>
struct SearchOptions {
    Cache* cache = nullptr;     ///< where to begin, and told where it ended; null: begins from nothing
    Trace<D>* trace = nullptr;  ///< told every step; null: nobody watches
};

}  // namespace abut
