#pragma once

// Fast GJK between hulls and boxes, in the frame of A, compiled once for each SIMD target. It answers only if the
// answer is certain: a gap whose two bounds agree, or an axis or a simplex that decides by far more than rounding.
// Robust GJK (gjk.hpp) is the fallback for all other pairs.

#include <abut/convex/gjk/signed_distance.hpp>

#include <optional>

namespace abut::detail {

/// Returns false if the cores overlap, or if the two bounds of the distance differ. If the cores surely overlap,
/// `inside` receives the simplex that contains the origin.
bool fast_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options, SignedDistance<3>& result,
                   Cache& inside);
inline bool fast_distance(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&, SignedDistance<2>&, Cache&) {
    return false;
}

/// Returns nothing if the answer is within the rounding error.
std::optional<bool> fast_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);
inline std::optional<bool> fast_overlap(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&) {
    return std::nullopt;
}

}  // namespace abut::detail
