#pragma once

// Where on a shape an answer lies.

#include <abut/convex/feature.hpp>

namespace abut {

struct Feature {
    std::uint32_t part = 0;   ///< of a composite shape: its triangle, tile or child
    std::uint32_t index = 0;  ///< on that part, as the kind says
    FeatureKind kind = FeatureKind::none;

    friend bool operator==(const Feature&, const Feature&) = default;
};

}  // namespace abut
