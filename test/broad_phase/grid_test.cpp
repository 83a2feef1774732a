// The uniform grid: cells and their borders, quantised steps that decide or don't, boxes of many cells.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using Pairs = std::vector<ItemPair>;

template <class Phase>
Pairs pairs_of(const Phase& phase) {
    Pairs result;
    phase.sorted_pairs(result);
    return result;
}
template <int D>
Pairs every_pair(const std::vector<Aabb<D>>& boxes) {
    BruteForce<D> oracle;
    oracle.build(boxes);
    return pairs_of(oracle);
}
template <int D>
Pairs grid_pairs(const std::vector<Aabb<D>>& boxes, float edge = 0) {
    Grid<D> grid(edge);
    grid.build(boxes);
    return pairs_of(grid);
}

template <class T>
class Grids : public testing::Test {};
using GridDimensions = testing::Types<Grid<2>, Grid<3>>;
TYPED_TEST_SUITE(Grids, GridDimensions);

/// Corners lie on a lattice as fine as the steps of the cells, or on their borders: boxes touch, end where a cell ends,
/// and lie in up to four cells along an axis.
TYPED_TEST(Grids, BoxesThatEndWhereCellsEnd) {
    constexpr int D = dimension_of<TypeParam>;
    std::size_t found = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const float lattice = std::array{1.0f, 0.5f, 1.0f / 128, 1.0f / 256, 1.0f / 8192}[seed % 5];
        const auto place = [&](float most) {
            return lattice * static_cast<float>(random.below(static_cast<std::uint32_t>(most / lattice) + 1));
        };
        // The first two boxes are points, so that the cells begin at 0, with four along each axis.
        std::vector<Aabb<D>> boxes{{Vec<D>(0), Vec<D>(0)}, {Vec<D>(4), Vec<D>(4)}};
        while (boxes.size() < 120) {
            Aabb<D> box;
            for (int i = 0; i < D; ++i) {
                box.min[i] = place(4);
                box.max[i] = box.min[i] + place(random.chance(0.1) ? 3.0f : 1.0f);
            }
            boxes.push_back(box);
        }
        const Pairs expected = every_pair(boxes);
        EXPECT_EQ(grid_pairs(boxes, 1.0f), expected);
        EXPECT_EQ(grid_pairs(boxes, 0.75f), expected);
        found += expected.size();
    }
    EXPECT_GT(found, 5000u);
}

/// The boxes are a few times smaller than a step, or than an ulp far from the origin.
TYPED_TEST(Grids, UndecidedStepsAreLeftToFloats) {
    constexpr int D = dimension_of<TypeParam>;
    for (const float far : {0.0f, 1e4f, 1e6f, -3e7f}) {
        for (const double size : {1e-3, 1e-1, 10.0}) {
            oracle::Random random(9);
            std::vector<Aabb<D>> boxes;
            for (int i = 0; i < 400; ++i) {
                const DVec<D> middle = random.in_cube<D>() * size * (i % 2 == 0 ? 10.0 : 0.01);
                const DVec<D> half(random.uniform(0, size * 0.01));
                boxes.push_back(box_at<D>(DVec<D>(static_cast<double>(far)) + middle, half));
            }
            EXPECT_EQ(grid_pairs(boxes), every_pair(boxes)) << "at " << far << " size " << size << " seed 9";
        }
    }
}

TYPED_TEST(Grids, ManyMovingBoxesOnEveryVectorUnit) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(17);
    auto boxes = make_scene<D>(Scene::uniform, 6000, random);
    const auto units = oracle::supported_simd_targets();
    std::vector<Grid<D>> grids(units.size());
    for (int frame = 0; frame < 12; ++frame) {
        move_some(boxes, random);
        const Pairs expected = every_pair(boxes);
        EXPECT_GT(expected.size(), 2000u);
        Pairs first_order;
        for (std::size_t unit = 0; unit < units.size(); ++unit) {
            const oracle::ForcedSimdTarget only(units[unit]);
            Grid<D>& grid = grids[unit];
            if (frame == 0)
                grid.build(boxes);
            else
                grid.update(boxes);
            EXPECT_EQ(pairs_of(grid), expected)
                << "seed 17 frame " << frame << " unit " << hwy::TargetName(units[unit]);
            Pairs order;
            grid.each_pair([&](std::uint32_t i, std::uint32_t j) { order.emplace_back(i, j); });
            if (first_order.empty()) first_order = order;
            EXPECT_EQ(order, first_order) << "the order depends on the vector unit";
        }
    }
}

/// All boxes move together into a corner, then apart to ten times the extent: cells are chosen anew.
TYPED_TEST(Grids, CellsFollowTheBoxes) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(23);
    const auto start = make_scene<D>(Scene::uniform, 3000, random);
    Grid<D> grid;
    grid.build(start);
    const float edge_at_first = grid.cell_edge();
    const auto spread = [&](float scale) {
        auto boxes = start;
        for (Aabb<D>& box : boxes) {
            const Vec<D> half = 0.5f * (box.max - box.min), middle = scale * (box.min + half);
            box = {middle - half, middle + half};
        }
        return boxes;
    };
    for (const float scale : {0.5f, 0.3f, 1.0f, 3.0f, 10.0f}) {
        const auto boxes = spread(scale);
        grid.update(boxes);
        EXPECT_EQ(pairs_of(grid), every_pair(boxes)) << scale;
    }
    grid.update(spread(10));
    Grid<D> fresh;
    fresh.build(spread(10));
    EXPECT_GT(fresh.cell_edge(), 2 * edge_at_first);
}

/// Memory suffices for any requested cell size.
TYPED_TEST(Grids, AnyEdgeOfCells) {
    constexpr int D = dimension_of<TypeParam>;
    oracle::Random random(29);
    const auto boxes = make_scene<D>(Scene::mixed_sizes, 500, random);
    const Pairs expected = every_pair(boxes);
    for (const float edge : {1e-30f, 1e-3f, 1.0f, 30.0f, 1e5f, 1e30f}) EXPECT_EQ(grid_pairs(boxes, edge), expected);
}

TYPED_TEST(Grids, AreTheSameWithSeveralThreads) {
    constexpr int D = dimension_of<TypeParam>;
    for (const Scene scene : {Scene::uniform, Scene::clustered, Scene::mixed_sizes, Scene::holes_and_endless}) {
        oracle::Random random(31);
        auto boxes = make_scene<D>(scene, 9000, random);
        if (scene == Scene::clustered)
            for (std::size_t i = 0; i < boxes.size(); ++i)
                boxes[i] = box_at<D>(DVec<D>(static_cast<double>(i % 5000)), DVec<D>(0.6));
        TypeParam one, many[2];
        ThreadPool two(2), seven(7);
        one.build(boxes);
        many[0].build(boxes, &two);
        many[1].build(boxes, &seven);
        const auto order = [](const TypeParam& grid) {
            Pairs result;
            grid.each_pair([&](std::uint32_t i, std::uint32_t j) { result.emplace_back(i, j); });
            return result;
        };
        for (int frame = 0; frame < 3; ++frame) {
            const Pairs expected = order(one);
            EXPECT_GT(expected.size(), 2000u);
            for (const TypeParam& grid : many) {
                EXPECT_EQ(order(grid), expected) << "seed 31 frame " << frame;
                EXPECT_EQ(grid.cell_edge(), one.cell_edge());
            }
            move_some(boxes, random);
            one.update(boxes);
            many[0].update(boxes, &two);
            many[1].update(boxes, &seven);
        }
    }
}

/// Rays and points from outside the cells, along borders of cells, and through corners of boxes.
TYPED_TEST(Grids, RaysAlongBordersAndFromFarAway) {
    constexpr int D = dimension_of<TypeParam>;
    std::size_t found = 0;
    for (std::uint64_t seed = 40; seed < 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const auto place = [&](std::uint32_t most) { return 0.25f * static_cast<float>(random.below(4 * most + 1)); };
        std::vector<Aabb<D>> boxes{{Vec<D>(0), Vec<D>(0)}, {Vec<D>(8), Vec<D>(8)}};
        while (boxes.size() < 3000) {
            Aabb<D> box;
            for (int i = 0; i < D; ++i) {
                box.min[i] = place(8);
                box.max[i] = box.min[i] + place(random.chance(0.02) ? 12 : 1);
            }
            if (random.chance(0.01)) box.max[0] = std::numeric_limits<float>::infinity();
            boxes.push_back(box);
        }
        // The cells are so large that memory suffices. All borders lie on the lattice; those of the second grid are not
        // exact in steps of a float's scale.
        const float edge = static_cast<float>(D - 1) * (seed % 2 == 0 ? 2.0f : 1.75f);
        TypeParam grid(edge);
        BruteForce<D> oracle;
        grid.build(boxes);
        oracle.build(boxes);
        ASSERT_EQ(grid.cell_edge(), edge);
        for (int query = 0; query < 200; ++query) {
            Vec<D> origin, target;
            for (int i = 0; i < D; ++i) {
                origin[i] = place(8);
                target[i] = random.chance(0.3) ? origin[i] : place(8);
            }
            // The ray goes from a corner of a cell diagonally through others.
            if (random.chance(0.3))
                for (int i = 0; i < D; ++i) {
                    origin[i] = edge * static_cast<float>(random.below(5));
                    target[i] = origin[i] + (random.chance(0.5) ? 3 * edge : -3 * edge);
                }
            if (random.chance(0.2)) origin[static_cast<int>(random.below(D))] = random.chance(0.5) ? -1e4f : 3e6f;
            const auto ray = Ray<D>::between(origin, target);
            const auto ordered = [](auto run) {
                std::vector<std::uint32_t> result;
                run([&](std::uint32_t i) { result.push_back(i); });
                std::sort(result.begin(), result.end());
                return result;
            };
            const auto along = ordered([&](auto visit) { oracle.raycast(ray, visit); });
            EXPECT_EQ(ordered([&](auto visit) { grid.raycast(ray, visit); }), along);
            const float reach = place(2);
            const auto near = ordered([&](auto visit) { oracle.closest(origin, visit, reach); });
            EXPECT_EQ(ordered([&](auto visit) { grid.closest(origin, visit, reach); }), near);
            const Aabb<D> box{glm::min(origin, target), glm::max(origin, target)};
            const auto around = ordered([&](auto visit) { oracle.closest(box, visit, reach); });
            EXPECT_EQ(ordered([&](auto visit) { grid.closest(box, visit, reach); }), around);
            found += along.size() + near.size();
        }
    }
    EXPECT_GT(found, 20000u);
}

}  // namespace
}  // namespace abut::test
