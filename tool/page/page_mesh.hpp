#pragma once

// Shapes for the report page: facets near the findings, in few bytes.

#include "tool/shared/format.hpp"
#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut::tool {

/// Segments in 2D, triangles in 3D.
template <int D>
struct Facets {
    std::span<const Vec<D>> points;
    std::vector<std::array<std::uint32_t, static_cast<std::size_t>(D)>> facets;
};

/// The numbers of the `count` facets nearest to the places, sorted; all facets if there are no more. Distances are
/// those of the facets' boxes.
template <int D>
std::vector<std::uint32_t> nearest_facets(const Facets<D>& shape, const std::vector<Vec<D>>& places, std::size_t count);

/// {"low", "high", "points", "elements", "partial"}: the points of these facets, as 16-bit numbers between the corners
/// of their box, and the facets by the numbers of these points, both in base64.
template <int D>
Json mesh_json(const Facets<D>& shape, const std::vector<std::uint32_t>& chosen);

/// Numbers as little-endian 32-bit floats in base64.
std::string base64_floats(std::span<const float> numbers);

}  // namespace abut::tool
