#pragma once

// Lines of equal height over a grid, as closed loops.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::tool {

/// Heights at whole places: `columns` a row, row by row, at least two of each.
struct HeightGrid {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> heights;

    float at(std::uint32_t column, std::uint32_t row) const { return heights[std::size_t{row} * columns + column]; }
};

/// One loop: the border of what lies below a level, or of a hole in that.
struct Contour {
    std::size_t level = 0;      ///< its number
    std::vector<Vec2> corners;  ///< in columns and rows
    double area = 0;            ///< of what is in it; below zero where that is above the level
};

/// The borders of what is below each of the levels, those at the edge of the grid closed along it. Between places
/// heights are told from the triangles that each square is cut into, so that no two loops cross. From the largest area
/// to the smallest: drawn in this order, each filled, they show all. Corners that change a line by less than
/// `tolerance` are left out.
std::vector<Contour> contours(const HeightGrid& grid, std::span<const float> levels, double tolerance);

}  // namespace abut::tool
