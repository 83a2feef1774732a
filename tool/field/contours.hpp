#pragma once

// Contour lines (isolines) of a height grid, as closed loops.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::tool {

/// Heights at integer coordinates, row by row; at least two columns and two rows.
struct HeightGrid {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> heights;

    float at(std::uint32_t column, std::uint32_t row) const { return heights[std::size_t{row} * columns + column]; }
};

/// A closed contour: the outer boundary of the region below a level, or of a hole in it.
struct Contour {
    std::size_t level = 0;       ///< index of the level
    std::vector<Vec2> vertices;  ///< vertices, in columns and rows
    double area = 0;             ///< signed area: negative for a hole, whose inside is above the level
};

/// Contours of all levels, closed along the boundary of the grid. Heights are interpolated linearly on two triangles
/// per square, so that contours don't cross. Sorted from the largest to the smallest area: filled in this order, they
/// draw all bands. Vertices that change a line by less than `tolerance` are removed.
std::vector<Contour> contours(const HeightGrid& grid, std::span<const float> levels, double tolerance);

}  // namespace abut::tool
