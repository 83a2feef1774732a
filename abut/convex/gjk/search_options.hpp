#pragma once

// Options of the searches in this folder.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/gjk/trace.hpp>
#include <abut/math/dvec.hpp>

namespace abut::detail {

template <int D>
struct SearchOptions {
    Cache* cache = nullptr;     ///< warm start, updated by the search; null: none
    Trace<D>* trace = nullptr;  ///< receives every step; null: none
};

/// The separating axis of a cache, zero if there is none.
template <int D>
DVec<D> axis_of(const Cache& cache) {
    DVec<D> result;
    for (int i = 0; i < D; ++i) result[i] = static_cast<double>(cache.axis[static_cast<std::size_t>(i)]);
    return result;
}
template <int D>
void set_axis(const glm::vec<D, double>& axis, Cache& cache) {
    for (int i = 0; i < D; ++i) cache.axis[static_cast<std::size_t>(i)] = static_cast<float>(axis[i]);
}

}  // namespace abut::detail
