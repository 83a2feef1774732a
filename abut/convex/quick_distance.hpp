#pragma once

// The answers that a quick walk is enough for: of hulls and boxes that are clearly apart or, where no more is asked
// than whether they overlap, clearly one in the other.

#include <abut/convex/signed_distance.hpp>

#include <optional>

namespace abut {

/// False where they overlap, or where reached and proven distance don't agree to the last digits. Where the cores
/// certainly overlap, `inside` is told the simplex that holds the origin.
bool quick_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options, SignedDistance<3>& result,
                    Cache& inside);
inline bool quick_distance(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&, SignedDistance<2>&, Cache&) {
    return false;
}

/// None where it is within the rounding.
std::optional<bool> quick_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);
inline std::optional<bool> quick_overlap(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&) {
    return std::nullopt;
}

}  // namespace abut
