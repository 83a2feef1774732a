#pragma once

// The names of the features of a shape: a vertex, an edge or a face, by number.

#include <algorithm>
#include <cstdint>

namespace abut {

/// The numbers are the shape's own. Points are numbered as the shape lists them. A vertex of a box has bit i set if it
/// is at the low end of axis i. Faces, in 3D alone: a polyhedron's as `facets()` lists them; a box' as 2 * axis, plus
/// one at the low end; a triangle's 0 on the side from which it is counter-clockwise, 1 on the other.
enum class FeatureKind : std::uint8_t {
    none,    ///< a round or unnamed place
    vertex,  ///< index: of the point
    edge,    ///< index: `edge_index` of its two points
    face,    ///< index: of the face
};

/// The lower of two point numbers in the low 16 bits, the higher one in the high 16. Of a number above 65535 its low
/// 16 bits count: two edges of so large a shape may have one name.
constexpr std::uint32_t edge_index(std::uint32_t i, std::uint32_t j) {
    return (std::min(i, j) & 0xffffu) | std::max(i, j) << 16;
}

}  // namespace abut
