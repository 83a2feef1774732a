#pragma once

// Who has to wait for whom before it can be moved away along a direction. For .cpp files.

#include <abut/convex/support.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// `lower` can't leave before `upper` has left.
struct Wait {
    std::uint32_t lower, upper;
};

/// Enough of them that all others follow: a shape that is above another is so by a chain of these. `up` has length 1,
/// all numbers are finite. O(n log n).
std::vector<Wait> waits(std::span<const Convex<2>> shapes, const DVec<2>& up);

/// All of them, sorted by `lower`, then `upper`.
std::vector<Wait> waits(std::span<const Convex<3>> shapes, const DVec<3>& up);

}  // namespace abut
