#pragma once

// When two parts first touch at their fronts, the first moving straight. For .cpp files.

#include <abut/query/function_motion.hpp>
#include <abut/query/one_sided.hpp>
#include <abut/query/sweep_part.hpp>

namespace abut {

/// As part_touch. Whatever overlap there is on a straight way is one stretch of it, so that what first touches at a
/// back doesn't touch at a front after it.
template <int D, class PartA, class PartB>
bool front_touch(const PartA& a, const Path<D>& path, const PartB& b, std::uint32_t index,
                 const SweepOptions<D>& options, PartTouch<D>& touch) {
    return goes_at_front(b, path.direction) && goes_at_front(a, -path.direction) &&
           part_touch(a, path, b, index, options, touch) && meet_at_fronts(a, b, touch.normal);
}

}  // namespace abut
