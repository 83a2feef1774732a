#pragma once

// Where on a shape an answer lies.

#include <cstdint>

namespace abut {

enum class FeatureKind : std::uint8_t {
    none,    ///< a round or unnamed place
    vertex,  ///< index: of the point
    edge,    ///< index: the lower point number in the low 16 bits, the higher one in the high 16
    face,    ///< index: of the lowest point of it that was used; use `part` for triangles of a mesh
};

struct Feature {
    std::uint32_t part = 0;   ///< of a composite shape: its triangle, tile or child
    std::uint32_t index = 0;  ///< on that part, as the kind says
    FeatureKind kind = FeatureKind::none;

    friend bool operator==(const Feature&, const Feature&) = default;
};

}  // namespace abut
