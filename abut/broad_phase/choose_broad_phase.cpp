#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/grid/cell_size.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace abut {
namespace {

constexpr std::size_t sample_size = 1024;

// The constants are measured times in ns; docs/broad_phases.md has the rows.

/// With fewer boxes, brute force takes no longer than a grid.
constexpr std::size_t max_brute_force_count = 150;
/// The extra time per box of an update and the pairs of a tree, compared with the other structures.
constexpr double tree_update_overhead = 45;
/// The extra time of a raycast or a closest query in a grid, compared with a tree.
constexpr double grid_query_overhead = 1000;
/// The extra time of such a query by brute force, which tests every box.
double brute_force_query_overhead(std::size_t count) {
    return 5 * static_cast<double>(count) - 100;
}
/// With more pairs per cell, for each box, a grid takes longer than a tree. A grid has about thirty boxes per cell and
/// compares sixteen in 4 ns.
constexpr double max_pairs_per_cell = 500;

/// The mean number of boxes in the same cell that a box of a grid is compared with. Two boxes of the sample share a
/// cell with the same probability as any two boxes.
template <int D>
double pairs_per_cell(std::span<const Aabb<D>> sample, std::size_t count) {
    detail::GridStatistics<D> statistics = detail::statistics_of(sample);
    if (statistics.count < 2) return 0;
    statistics.count = statistics.count * count / sample.size();
    const detail::GridCells<D> cells = detail::make_cells(
        statistics.region, choose_cell_edge(statistics, detail::grid_boxes_per_cell, detail::grid_min_edge_ratio),
        detail::grid_max_cells(count));
    std::array<std::uint32_t, sample_size> cell;
    std::size_t found = 0;
    for (const Aabb<D>& box : sample)
        if (!detail::is_empty(detail::usable(box))) cell[found++] = cells.index(cells.range(box).low);
    std::sort(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(found));
    std::size_t together = 0, run = 0;
    for (std::size_t i = 1; i < found; ++i) {
        run = cell[i] == cell[i - 1] ? run + 1 : 0;
        together += run;
    }
    const double pairs = 0.5 * static_cast<double>(found) * static_cast<double>(found - 1);
    return static_cast<double>(together) / pairs * static_cast<double>(count);
}

}  // namespace

template <int D>
BroadPhaseKind choose_broad_phase(std::span<const Aabb<D>> boxes, const BroadPhaseHistory& history) {
    detail::enter_library();
    const std::size_t count = boxes.size();
    if (count < max_brute_force_count)
        return history.queries * brute_force_query_overhead(count) > tree_update_overhead ? BroadPhaseKind::bvh
                                                                                          : BroadPhaseKind::brute_force;
    if (history.queries * grid_query_overhead > tree_update_overhead) return BroadPhaseKind::bvh;
    if (static_cast<double>(count) <= max_pairs_per_cell) return BroadPhaseKind::grid;  // even if all share a cell
    // With this sample size, about a thousand pairs of the sample share a cell if the limit is reached.
    const auto sufficient = static_cast<std::size_t>(2 * detail::square_root(static_cast<double>(count)));
    std::array<Aabb<D>, sample_size> sample;
    const std::size_t sample_count = std::min(sufficient, sample_size);
    for (std::size_t i = 0; i < sample_count; ++i) sample[i] = boxes[i * count / sample_count];
    const double pairs = pairs_per_cell<D>({sample.data(), sample_count}, count);
    return pairs > max_pairs_per_cell ? BroadPhaseKind::bvh : BroadPhaseKind::grid;
}

template BroadPhaseKind choose_broad_phase(std::span<const Aabb<2>>, const BroadPhaseHistory&);
template BroadPhaseKind choose_broad_phase(std::span<const Aabb<3>>, const BroadPhaseHistory&);

}  // namespace abut
