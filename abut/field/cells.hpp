#pragma once

// Access to single cells of a field in double, for queries that visit many of them. For .cpp files.

#include <abut/field/look_up/stencil.hpp>
#include <abut/math/dvec.hpp>

namespace abut::detail {

template <int D>
using Cell = glm::vec<D, std::int32_t>;

/// A regular grid of samples: that of the volume, of a brick, or the corners of one block without a brick.
template <int D>
struct SampleGrid {
    Cell<D> low, high;    ///< first and last cell of the volume in the grid
    std::uint32_t first;  ///< the sample at its lowest corner
    glm::vec<D, std::uint32_t> stride;
    std::int32_t side = 1;  ///< cells of the volume between samples
    bool coarse = false;
};

template <int D>
double value_of(const FieldData<D>& data, const SampleGrid<D>& grid, std::uint32_t sample) {
    if (grid.coarse) return static_cast<double>(data.coarse[sample]);
    if (data.steps.empty()) return static_cast<double>(data.distance[sample]);
    return static_cast<double>(data.steps[sample]) * static_cast<double>(data.step);
}

/// The last cell of the volume along an axis.
template <int D>
std::int32_t last_cell(const FieldData<D>& data, int axis) {
    return static_cast<std::int32_t>(data.cells[axis]) - 1;
}

/// The grid that contains a cell of the volume.
template <int D>
SampleGrid<D> grid_of(const FieldData<D>& data, const Cell<D>& cell) {
    const FieldFrame<D>& frame = data.frame;
    SampleGrid<D> result;
    if (data.store == FieldStore::dense) {
        result = {Cell<D>(0), Cell<D>(data.cells) - 1, 0, frame.stride};
        return result;
    }
    constexpr auto side = static_cast<std::int32_t>(brick_cells<D>);
    std::uint32_t block = 0, corner = 0, stride = 1;
    for (int a = 0; a < D; ++a) {
        const auto at = static_cast<std::uint32_t>(cell[a] / side);
        block += at * frame.block_row[a];
        corner += at * frame.corners[a];
        result.low[a] = cell[a] / side * side;
        result.high[a] = result.low[a] + side - 1;
        result.stride[a] = stride;
        stride *= brick_cells<D> + 1;
    }
    const std::uint32_t brick = data.brick[block];
    if (brick != no_brick) {
        result.first = brick * brick_samples<D>;
        return result;
    }
    result.first = corner;
    result.stride = frame.corners;
    result.side = side;
    result.coarse = true;
    return result;
}

/// The distances at the corners of one cell of a grid. A coarse grid has a single cell.
template <int D>
struct CellValues {
    DVec<D> low;  ///< the lowest corner, in cells of the volume
    double side;
    std::array<double, cell_corners<D>> values;

    /// The interpolated distance at a place in cells of the volume.
    double at(const DVec<D>& place) const {
        std::array<double, cell_corners<D>> left = values;
        std::size_t count = left.size();
        for (int a = 0; a < D; ++a) {
            const double share = (place[a] - low[a]) / side;
            count /= 2;
            for (std::size_t i = 0; i < count; ++i) left[i] = left[2 * i] + share * (left[2 * i + 1] - left[2 * i]);
        }
        return left[0];
    }

    /// The gradient at a place, per cell of the volume.
    DVec<D> gradient(const DVec<D>& place) const {
        DVec<D> result;
        for (int along = 0; along < D; ++along) {
            std::array<double, cell_corners<D>> left = values;
            std::size_t count = left.size();
            for (int a = 0; a < D; ++a) {
                const double share = (place[a] - low[a]) / side;
                count /= 2;
                for (std::size_t i = 0; i < count; ++i) {
                    const double rise = left[2 * i + 1] - left[2 * i];
                    left[i] = a == along ? rise / side : left[2 * i] + share * rise;
                }
            }
            result[along] = left[0];
        }
        return result;
    }
};

template <int D>
CellValues<D> values_in(const FieldData<D>& data, const SampleGrid<D>& grid, const Cell<D>& cell) {
    CellValues<D> result;
    std::uint32_t first = grid.first;
    for (int a = 0; a < D; ++a) {
        const std::int32_t at = grid.coarse ? 0 : cell[a] - grid.low[a];
        first += static_cast<std::uint32_t>(at) * grid.stride[a];
        result.low[a] = grid.low[a] + at;
    }
    result.side = grid.side;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        std::uint32_t sample = first;
        for (int a = 0; a < D; ++a)
            if (i >> a & 1) sample += grid.stride[a];
        result.values[i] = value_of(data, grid, sample);
    }
    return result;
}

/// Advances to the next cell of a box, the first axis fastest. Returns false after the last.
template <int D>
bool next_cell(Cell<D>& cell, const Cell<D>& low, const Cell<D>& high) {
    for (int a = 0; a < D; ++a) {
        if (++cell[a] <= high[a]) return true;
        cell[a] = low[a];
    }
    return false;
}

/// Converts a point of the field's frame to cells of the volume.
template <int D>
DVec<D> in_cells(const FieldData<D>& data, const DVec<D>& point) {
    DVec<D> result;
    for (int a = 0; a < D; ++a)
        result[a] = (point[a] - static_cast<double>(data.origin[a])) / static_cast<double>(data.cell);
    return result;
}

/// The cell around a place of the volume, which is in cells.
template <int D>
CellValues<D> values_around(const FieldData<D>& data, const DVec<D>& place) {
    Cell<D> cell;
    for (int a = 0; a < D; ++a) cell[a] = std::clamp(static_cast<std::int32_t>(place[a]), 0, last_cell(data, a));
    return values_in(data, grid_of(data, cell), cell);
}

}  // namespace abut::detail
