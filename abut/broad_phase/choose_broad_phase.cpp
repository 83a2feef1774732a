#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/grid_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace abut {
namespace {

constexpr std::size_t sample_size = 1024;

// What follows was measured, in ns; docs/broad_phases.md has the rows.

/// With fewer boxes, every box against every other takes no longer than a grid.
constexpr std::size_t few = 150;
/// By so much a box are an update of a tree and its pairs longer than those of the others.
constexpr double tree_frame_longer = 45;
/// By so much a ray, or a search for what is near, is longer in a grid than in a tree.
constexpr double grid_question_longer = 1000;
/// The same by brute force, which looks at each box: soon a tree is better, unless it is asked for next to nothing.
double longer_by_brute_force(std::size_t count) {
    return 5 * static_cast<double>(count) - 100;
}
/// Boxes of a cell that one is compared with. A grid has some thirty boxes a cell and compares sixteen in 4 ns, so that
/// this takes it as long as a tree.
constexpr double crowd = 500;

template <int D>
bool holds_something(const Aabb<D>& box) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && box.min[i] <= box.max[i];
    return result;
}

/// Boxes of a cell that a box of a grid is compared with, on the average: two of the sample share a cell as often as
/// two of all.
template <int D>
double company_in_grid(std::span<const Aabb<D>> sample, std::size_t count) {
    GridScene<D> scene = scene_of(sample);
    if (scene.count < 2) return 0;
    scene.count = scene.count * count / sample.size();
    const GridCells<D> cells =
        cells_in(scene.block, edge_for(scene, grid_boxes_a_cell, grid_edges_a_cell), grid_most_cells(count));
    std::array<std::uint32_t, sample_size> cell;
    std::size_t found = 0;
    for (const Aabb<D>& box : sample)
        if (holds_something(box)) cell[found++] = cells.index(cells.range(box).low);
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
    const std::size_t count = boxes.size();
    if (count < few)
        return history.asked * longer_by_brute_force(count) > tree_frame_longer ? BroadPhaseKind::bvh
                                                                                : BroadPhaseKind::brute_force;
    if (history.asked * grid_question_longer > tree_frame_longer) return BroadPhaseKind::bvh;
    if (static_cast<double>(count) <= crowd) return BroadPhaseKind::grid;  // all in one cell are no more
    // Where as many share a cell as matter, a thousand pairs of the sample do.
    const auto wanted = static_cast<std::size_t>(2 * std::sqrt(static_cast<double>(count)));
    std::array<Aabb<D>, sample_size> sample;
    const std::size_t taken = std::min(wanted, sample_size);
    for (std::size_t i = 0; i < taken; ++i) sample[i] = boxes[i * count / taken];
    const double company = company_in_grid<D>({sample.data(), taken}, count);
    return company > crowd ? BroadPhaseKind::bvh : BroadPhaseKind::grid;
}

template BroadPhaseKind choose_broad_phase(std::span<const Aabb<2>>, const BroadPhaseHistory&);
template BroadPhaseKind choose_broad_phase(std::span<const Aabb<3>>, const BroadPhaseHistory&);

}  // namespace abut
