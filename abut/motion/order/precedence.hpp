#pragma once

// Precedence of removal: which shapes have to be removed before others along a direction. For .cpp files.

#include <abut/convex/support.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// An edge of the precedence graph: `upper` has to be removed before `lower`.
struct Precedence {
    std::uint32_t lower, upper;
};

/// Edges whose transitive closure is the whole relation. `up` has length 1, all numbers are finite. O(n log n).
std::vector<Precedence> precedences(std::span<const Convex<2>> shapes, const DVec<2>& up);

/// All edges, sorted by `lower`, then `upper`.
std::vector<Precedence> precedences(std::span<const Convex<3>> shapes, const DVec<3>& up);

}  // namespace abut::detail
