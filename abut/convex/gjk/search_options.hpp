#pragma once

// Options of the searches in this folder.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/gjk/trace.hpp>

namespace abut::detail {

template <int D>
struct SearchOptions {
    Cache* cache = nullptr;     ///< warm start, updated by the search; null: none
    Trace<D>* trace = nullptr;  ///< receives every step; null: none
};

}  // namespace abut::detail
