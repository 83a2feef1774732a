#include <abut/broad_phase/grid/cell_size.hpp>
#include <abut/broad_phase/grid/parallel_parts.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

/// The ratio of successive edges in the search: the inverse of the fourth root of two. It is a literal, for functions
/// of the C library round differently from machine to machine.
constexpr double edge_ratio = 0.8408964152537145;

template <int D>
double cells_along(const Aabb<D>& region, int axis, double edge) {
    return std::floor((static_cast<double>(region.max[axis]) - static_cast<double>(region.min[axis])) / edge) + 1;
}
template <int D>
double cell_count(const Aabb<D>& region, double edge) {
    double result = 1;
    for (int axis = 0; axis < D; ++axis) result *= cells_along(region, axis, edge);
    return result;
}
template <int D>
double longest(const Aabb<D>& region) {
    double result = 0;
    for (int axis = 0; axis < D; ++axis)
        result = std::max(result, static_cast<double>(region.max[axis]) - static_cast<double>(region.min[axis]));
    return result;
}

/// Sums over some boxes.
template <int D>
struct Sums {
    std::size_t count = 0;
    double centers[D] = {}, squares[D] = {}, edges = 0;
    Aabb<D> center_bounds = Aabb<D>::empty();

    void add(const Aabb<D>& box) {
        constexpr float far = 1e37f;
        bool counts = true;
        for (int i = 0; i < D; ++i)
            counts = counts && -far < box.min[i] && box.min[i] <= box.max[i] && box.max[i] < far;
        if (!counts) return;
        ++count;
        for (int i = 0; i < D; ++i) {
            const double low = static_cast<double>(box.min[i]), high = static_cast<double>(box.max[i]);
            const double center = 0.5 * (low + high);
            centers[i] += center;
            squares[i] += center * center;
            edges += high - low;
            center_bounds.min[i] = std::min(center_bounds.min[i], static_cast<float>(center));
            center_bounds.max[i] = std::max(center_bounds.max[i], static_cast<float>(center));
        }
    }
    void add(const Sums& other) {
        count += other.count;
        edges += other.edges;
        center_bounds = merged(center_bounds, other.center_bounds);
        for (int i = 0; i < D; ++i) {
            centers[i] += other.centers[i];
            squares[i] += other.squares[i];
        }
    }
};

}  // namespace

template <int D>
GridStatistics<D> statistics_of(std::span<const Aabb<D>> boxes, Executor* executor) {
    std::array<Sums<D>, part_count> parts;
    run_parts(executor, boxes.size(), [&](std::uint32_t part) {
        const auto [begin, end] = range_of_part(boxes.size(), part);
        for (std::size_t i = begin; i < end; ++i) parts[part].add(boxes[i]);
    });
    Sums<D> sums;
    for (const Sums<D>& part : parts) sums.add(part);
    GridStatistics<D> statistics;
    statistics.count = sums.count;
    if (statistics.count == 0) return statistics;
    const double count = static_cast<double>(statistics.count);
    statistics.mean_edge = sums.edges / (count * D);
    for (int i = 0; i < D; ++i) {
        const double mean = sums.centers[i] / count, variance = std::max(0.0, sums.squares[i] / count - mean * mean);
        const double spread = 3 * square_root(variance);
        statistics.region.min[i] = std::max(sums.center_bounds.min[i], static_cast<float>(mean - spread));
        statistics.region.max[i] =
            std::max(statistics.region.min[i], std::min(sums.center_bounds.max[i], static_cast<float>(mean + spread)));
    }
    return statistics;
}

template <int D>
float choose_cell_edge(const GridStatistics<D>& statistics, double boxes_per_cell, double min_ratio) {
    const double cells = static_cast<double>(statistics.count) / boxes_per_cell;
    const double min_edge =
        std::max(min_ratio * statistics.mean_edge, static_cast<double>(std::numeric_limits<float>::min()));
    double edge = std::max(longest(statistics.region), min_edge);
    while (edge * edge_ratio >= min_edge && cell_count(statistics.region, edge * edge_ratio) <= cells)
        edge *= edge_ratio;
    return static_cast<float>(edge);
}

template <int D>
GridCells<D> make_cells(const Aabb<D>& region, float edge, std::uint32_t max_count) {
    // With this limit a step is larger than the spacing of floats, and step numbers are exact in float.
    constexpr double max_along_axis = 1 << 17;
    // With shorter edges the number of steps per unit of length would overflow a float.
    constexpr double smallest_edge = 1e-32;
    double cell_edge = std::max({static_cast<double>(edge), smallest_edge, longest(region) / max_along_axis * 2});
    while (cell_count(region, cell_edge) > max_count) cell_edge /= edge_ratio;
    GridCells<D> result;
    result.edge = static_cast<float>(cell_edge);
    result.scale = static_cast<float>(PackedBounds<D>::steps / cell_edge);
    result.total = 1;
    for (std::size_t i = 0; i < D; ++i) {
        const int axis = static_cast<int>(i);
        result.origin[i] = region.min[axis];
        result.count[i] = static_cast<std::uint32_t>(cells_along(region, axis, cell_edge));
        result.stride[i] = result.total;
        result.total *= result.count[i];
        const std::uint32_t steps = result.count[i] * PackedBounds<D>::steps;
        result.last[i] = std::nextafter(static_cast<float>(steps), 0.0f);
    }
    return result;
}

template GridStatistics<2> statistics_of(std::span<const Aabb<2>>, Executor*);
template GridStatistics<3> statistics_of(std::span<const Aabb<3>>, Executor*);
template float choose_cell_edge(const GridStatistics<2>&, double, double);
template float choose_cell_edge(const GridStatistics<3>&, double, double);
template GridCells<2> make_cells(const Aabb<2>&, float, std::uint32_t);
template GridCells<3> make_cells(const Aabb<3>&, float, std::uint32_t);

}  // namespace abut::detail
