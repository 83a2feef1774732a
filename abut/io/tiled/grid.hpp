#pragma once

// Where the cells of a map are, and their outlines.

#include <abut/io/tiled/map.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace abut::tiled {

/// The measures of a staggered or hexagonal grid, as Tiled draws it: a staggered one is hexagonal with sides of length
/// 0. Lengths are whole pixels.
struct StaggeredGrid {
    detail::DVec<2> tile, side{0}, corner, step;

    explicit StaggeredGrid(const Map& map) : tile(2 * std::floor(0.5 * map.cell.x), 2 * std::floor(0.5 * map.cell.y)) {
        side[map.stagger->axis] = map.stagger->side;
        corner = 0.5 * (tile - side);
        step = corner + side;
    }
};

/// The low corner of the rectangle around a cell.
inline detail::DVec<2> cell_position(const Map& map, std::int64_t column, std::int64_t row) {
    const detail::DVec<2> cell(static_cast<double>(column), static_cast<double>(row));
    if (!map.stagger) return cell * map.cell;
    const StaggeredGrid grid(map);
    const int along = map.stagger->axis, across = 1 - along;
    const bool is_shifted = (((along == 0 ? column : row) & 1) == 0) == map.stagger->shifts_even;
    detail::DVec<2> result;
    result[along] = cell[along] * grid.step[along];
    result[across] = cell[across] * (grid.tile[across] + grid.side[across]) + (is_shifted ? grid.step[across] : 0);
    return result;
}

/// The corners of a cell of a staggered or hexagonal map, relative to that. Some may be equal.
inline std::vector<detail::DVec<2>> cell_outline(const Map& map) {
    const StaggeredGrid grid(map);
    const detail::DVec<2>&size = grid.tile, &cut = grid.corner;
    return {{cut.x, 0},      {size.x - cut.x, 0}, {size.x, cut.y}, {size.x, size.y - cut.y}, {size.x - cut.x, size.y},
            {cut.x, size.y}, {0, size.y - cut.y}, {0, cut.y}};
}

}  // namespace abut::tiled
