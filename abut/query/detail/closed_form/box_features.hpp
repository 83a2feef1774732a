#pragma once

// The features of a box by their bits. For .cpp files.

#include <abut/query/feature.hpp>

#include <array>
#include <bit>

namespace abut::detail {

/// The corners, edges and faces of a box, by two sets of bits: the fixed axes, plus 8 times the fixed axes at their low
/// end.
inline constexpr std::array<Feature, 64> box_features = [] {
    std::array<Feature, 64> result{};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t fixed = i & 7u, low = i >> 3 & fixed;
        const int count = std::popcount(fixed);
        if (count == 1) result[i] = {0, (fixed & 6u) + (low != 0 ? 1u : 0u), FeatureKind::face};
        if (count == 2) result[i] = {0, edge_index(low, low | (fixed ^ 7u)), FeatureKind::edge};
        if (count == 3) result[i] = {0, low, FeatureKind::vertex};
    }
    return result;
}();

}  // namespace abut::detail
