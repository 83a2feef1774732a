#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/grid_plan.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace abut {
namespace {

constexpr std::size_t sample_size = 1024;

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
        if (box.min[0] <= box.max[0]) cell[found++] = cells.index(cells.range(box).low);
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
    constexpr std::size_t few = 80;
    // A ray, or what is near, takes a grid some 25 us longer than a tree, and an update a tree 60 ns a box longer.
    constexpr double often = 60.0 / 25000;
    // A grid has some thirty boxes a cell and compares sixteen in 4 ns, so that this takes it as long as a tree.
    constexpr double crowd = 500;
    if (boxes.size() < few) return BroadPhaseKind::brute_force;
    if (history.asked > often) return BroadPhaseKind::bvh;
    std::array<Aabb<D>, sample_size> sample;
    const std::size_t count = std::min(boxes.size(), sample_size);
    for (std::size_t i = 0; i < count; ++i) sample[i] = boxes[i * boxes.size() / count];
    const double company = company_in_grid<D>({sample.data(), count}, boxes.size());
    return company > crowd ? BroadPhaseKind::bvh : BroadPhaseKind::grid;
}

template BroadPhaseKind choose_broad_phase(std::span<const Aabb<2>>, const BroadPhaseHistory&);
template BroadPhaseKind choose_broad_phase(std::span<const Aabb<3>>, const BroadPhaseHistory&);

}  // namespace abut
