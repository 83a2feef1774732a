#pragma once

// The order of half-planes around an edge, by exact predicates. For .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// Whether two solids with the same axis share a sector around it. Of a fan of fewer than two blades, beside a triangle
/// of zero area, nothing but the backs of its blades is known to be inside.
bool fans_overlap(const EdgeFan& a, const EdgeFan& b);

}  // namespace abut::detail
