#pragma once

// Which cells suit some boxes. For .cpp files.

#include <abut/broad_phase/grid_cells.hpp>
#include <abut/math/executor.hpp>

#include <span>

namespace abut {

/// What a Grid wants of its cells: so many boxes in each, edges no less than so many of the boxes' mean ones, and no
/// more of them than memory has room for.
inline constexpr double grid_boxes_a_cell = 28, grid_edges_a_cell = 3;
inline std::uint32_t grid_most_cells(std::size_t boxes) {
    return static_cast<std::uint32_t>(boxes / 28 + 64);
}

/// What there is to know of boxes in order to choose cells.
template <int D>
struct GridScene {
    std::size_t count = 0;  ///< of those that hold something and have bounds
    Aabb<D> block{};        ///< most of them have their middle in it
    double mean_edge = 0;
};
template <int D>
GridScene<D> scene_of(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

/// The edge of cells that hold about so many of the boxes, but no less than `least` of their mean edges. At least a
/// normal float.
template <int D>
float edge_for(const GridScene<D>& scene, double boxes_a_cell, double least);

/// Cells of that edge, or of one so much larger that there are no more than `most`, in the block.
template <int D>
GridCells<D> cells_in(const Aabb<D>& block, float edge, std::uint32_t most);

}  // namespace abut
