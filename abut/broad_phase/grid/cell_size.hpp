#pragma once

// The choice of the cell size from statistics of the boxes. For .cpp files.

#include <abut/broad_phase/grid/cells.hpp>
#include <abut/math/executor.hpp>

#include <span>

namespace abut::detail {

/// The targets of a Grid: the number of boxes per cell, the minimum ratio of the cell edge to the mean edge of the
/// boxes, and the maximum number of cells that memory is reserved for.
inline constexpr double grid_boxes_per_cell = 28, grid_min_edge_ratio = 3;
inline std::uint32_t grid_max_cells(std::size_t boxes) {
    return static_cast<std::uint32_t>(boxes / 28 + 64);
}

/// The statistics of boxes that determine the cells.
template <int D>
struct GridStatistics {
    std::size_t count = 0;  ///< of the boxes that are bounded and not empty; the others don't count
    Aabb<D> region{};       ///< contains most of the centres: the mean and three standard deviations
    double mean_edge = 0;
};
template <int D>
GridStatistics<D> statistics_of(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

/// The edge of cells with about `boxes_per_cell` boxes each. It is at least `min_ratio` times the mean edge of the
/// boxes, and a normal float.
template <int D>
float choose_cell_edge(const GridStatistics<D>& statistics, double boxes_per_cell, double min_ratio);

/// The cells of a region, with this edge, or with an edge so much larger that there are at most `max_count` cells.
template <int D>
GridCells<D> make_cells(const Aabb<D>& region, float edge, std::uint32_t max_count);

}  // namespace abut::detail
