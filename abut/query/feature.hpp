#pragma once

// The feature of a shape that an answer lies on.

#include <abut/convex/feature.hpp>

namespace abut {

struct Feature {
    std::uint32_t part = 0;   ///< of a composite shape: its triangle, tile or child
    std::uint32_t index = 0;  ///< on that part; its meaning depends on `kind`
    FeatureKind kind = FeatureKind::none;

    friend bool operator==(const Feature&, const Feature&) = default;
};

}  // namespace abut
