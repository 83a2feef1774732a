#include <abut/broad_phase/grid_jobs.hpp>
#include <abut/broad_phase/grid_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {
namespace {

/// Each step of a search for an edge: the fourth root of two. Not by a function of the C library, whose last digit
/// differs from machine to machine.
constexpr double finer = 0.8408964152537145;

template <int D>
double cells_along(const Aabb<D>& block, int axis, double edge) {
    return std::floor((static_cast<double>(block.max[axis]) - static_cast<double>(block.min[axis])) / edge) + 1;
}
template <int D>
double count_of(const Aabb<D>& block, double edge) {
    double result = 1;
    for (int axis = 0; axis < D; ++axis) result *= cells_along(block, axis, edge);
    return result;
}
template <int D>
double longest(const Aabb<D>& block) {
    double result = 0;
    for (int axis = 0; axis < D; ++axis)
        result = std::max(result, static_cast<double>(block.max[axis]) - static_cast<double>(block.min[axis]));
    return result;
}

/// What is counted of some boxes.
template <int D>
struct Sums {
    std::size_t count = 0;
    double middles[D] = {}, squares[D] = {}, edges = 0;
    Aabb<D> around = Aabb<D>::empty();  ///< of the middles

    void add(const Aabb<D>& box) {
        constexpr float far = 1e37f;
        bool counts = true;
        for (int i = 0; i < D; ++i)
            counts = counts && -far < box.min[i] && box.min[i] <= box.max[i] && box.max[i] < far;
        if (!counts) return;
        ++count;
        for (int i = 0; i < D; ++i) {
            const double low = static_cast<double>(box.min[i]), high = static_cast<double>(box.max[i]);
            const double middle = 0.5 * (low + high);
            middles[i] += middle;
            squares[i] += middle * middle;
            edges += high - low;
            around.min[i] = std::min(around.min[i], static_cast<float>(middle));
            around.max[i] = std::max(around.max[i], static_cast<float>(middle));
        }
    }
    void add(const Sums& other) {
        count += other.count;
        edges += other.edges;
        around = merged(around, other.around);
        for (int i = 0; i < D; ++i) {
            middles[i] += other.middles[i];
            squares[i] += other.squares[i];
        }
    }
};

}  // namespace

template <int D>
GridScene<D> scene_of(std::span<const Aabb<D>> boxes, Executor* executor) {
    std::array<Sums<D>, parts_of_job> parts;
    run_parts(executor, boxes.size(), [&](std::uint32_t part) {
        const auto [begin, end] = part_of(boxes.size(), part);
        for (std::size_t i = begin; i < end; ++i) parts[part].add(boxes[i]);
    });
    Sums<D> sums;
    for (const Sums<D>& part : parts) sums.add(part);
    GridScene<D> scene;
    scene.count = sums.count;
    if (scene.count == 0) return scene;
    const double count = static_cast<double>(scene.count);
    scene.mean_edge = sums.edges / (count * D);
    for (int i = 0; i < D; ++i) {
        const double mean = sums.middles[i] / count, variance = std::max(0.0, sums.squares[i] / count - mean * mean);
        const double most = 3 * std::sqrt(variance);
        scene.block.min[i] = std::max(sums.around.min[i], static_cast<float>(mean - most));
        scene.block.max[i] =
            std::max(scene.block.min[i], std::min(sums.around.max[i], static_cast<float>(mean + most)));
    }
    return scene;
}

template <int D>
float edge_for(const GridScene<D>& scene, double boxes_a_cell, double least) {
    const double cells = static_cast<double>(scene.count) / boxes_a_cell;
    const double lowest = std::max(least * scene.mean_edge, static_cast<double>(std::numeric_limits<float>::min()));
    double edge = std::max(longest(scene.block), lowest);
    while (edge * finer >= lowest && count_of(scene.block, edge * finer) <= cells) edge *= finer;
    return static_cast<float>(edge);
}

template <int D>
GridCells<D> cells_in(const Aabb<D>& block, float edge, std::uint32_t most) {
    // A step is more than the last digit of the coordinates, or it would tell nothing; so many along an axis are exact.
    constexpr double most_along = 1 << 17;
    // With shorter edges there would be more steps a length than a float can tell.
    constexpr double least_edge = 1e-32;
    double wide = std::max({static_cast<double>(edge), least_edge, longest(block) / most_along * 2});
    while (count_of(block, wide) > most) wide /= finer;
    GridCells<D> result;
    result.edge = static_cast<float>(wide);
    result.scale = static_cast<float>(GridWords<D>::steps / wide);
    result.total = 1;
    for (std::size_t i = 0; i < D; ++i) {
        const int axis = static_cast<int>(i);
        result.origin[i] = block.min[axis];
        result.count[i] = static_cast<std::uint32_t>(cells_along(block, axis, wide));
        result.stride[i] = result.total;
        result.total *= result.count[i];
        const std::uint32_t steps = result.count[i] * GridWords<D>::steps;
        result.last[i] = std::nextafter(static_cast<float>(steps), 0.0f);
    }
    return result;
}

template GridScene<2> scene_of(std::span<const Aabb<2>>, Executor*);
template GridScene<3> scene_of(std::span<const Aabb<3>>, Executor*);
template float edge_for(const GridScene<2>&, double, double);
template float edge_for(const GridScene<3>&, double, double);
template GridCells<2> cells_in(const Aabb<2>&, float, std::uint32_t);
template GridCells<3> cells_in(const Aabb<3>&, float, std::uint32_t);

}  // namespace abut
