#pragma once

// The time of impact of two parts at their fronts, the first moving straight. For .cpp files.

#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sweep/linear.hpp>

namespace abut::detail {

/// Like time_of_impact, with one-sided parts. On a straight path the overlap is a single interval, so parts that first
/// touch at a back don't touch at a front later.
template <int D, class PartA, class PartB>
bool front_time_of_impact(const PartA& a, const Path<D>& path, const PartB& b, std::uint32_t index,
                          const SweepOptions<D>& options, LinearImpact<D>& impact) {
    return approaches_front(b, path.direction) && approaches_front(a, -path.direction) &&
           time_of_impact(a, path, b, index, options, impact) && touch_at_fronts(a, b, impact.normal);
}

}  // namespace abut::detail
