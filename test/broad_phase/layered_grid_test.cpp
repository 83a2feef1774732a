// Cases that only a hierarchical grid has: all sizes at once, borders of cells, dense clusters, and outliers.

#include "../../scenes/skewed_boxes.hpp"
#include "dimensions.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/layered_grid.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using Pairs = std::vector<ItemPair>;

template <class T>
Pairs pairs_in_order(const T& phase) {
    Pairs result;
    phase.each_pair([&](std::uint32_t i, std::uint32_t j) { result.emplace_back(i, j); });
    return result;
}

/// The grid's pairs, each once, are those of the tree. Returns how many there are.
template <int D>
std::size_t check_pairs(const LayeredGrid<D>& grid, std::span<const Aabb<D>> boxes) {
    Bvh<D> tree;
    tree.build(boxes);
    Pairs expected, found = pairs_in_order(grid);
    tree.sorted_pairs(expected);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_TRUE(found == expected);
    return expected.size();
}

template <int D>
void check_build_and_updates(std::vector<Aabb<D>> boxes, double step, oracle::Random& random, std::size_t least_pairs) {
    LayeredGrid<D> grid;
    grid.build(boxes);
    EXPECT_GE(check_pairs<D>(grid, boxes), least_pairs) << "too few to prove anything";
    for (int frame = 0; frame < 4; ++frame) {
        for (Aabb<D>& box : boxes) {
            const Vec<D> way(random.in_cube<D>() * step);
            box = {box.min + way, box.max + way};
        }
        grid.update(boxes);
        check_pairs<D>(grid, boxes);
    }
}

/// Sizes over four decades and more, some of which hold all others.
template <int D>
std::vector<Aabb<D>> all_sizes(oracle::Random& random, std::size_t count, int low, int high, const DVec<D>& middle) {
    const double world = std::ldexp(1.0, high);
    std::vector<Aabb<D>> result;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = i % 500 == 0 ? 4 * world : random.power_of_two(low, high - 2);
        const DVec<D> place = middle + random.in_cube<D>() * world;
        result.push_back(box_at<D>(place, DVec<D>(0.5 * size) + 0.2 * size * random.in_cube<D>()));
    }
    return result;
}

template <class T>
class Layered : public testing::Test {};
TYPED_TEST_SUITE(Layered, Both);

TYPED_TEST(Layered, HoldsSizesOfManyDecades) {
    constexpr int D = TypeParam::value;
    const std::pair<int, int> ranges[] = {{-10, 4}, {-3, 10}, {-20, 3}};
    for (const auto& [low, high] : ranges)
        for (const double far : {0.0, 1e6, -1e6}) {
            SCOPED_TRACE(testing::Message() << "seed 41, 2^" << low << " to 2^" << high << " at " << far);
            oracle::Random random(41);
            check_build_and_updates<D>(all_sizes<D>(random, 2000, low, high, DVec<D>(far)), 0.01, random, 2000);
        }
}

TYPED_TEST(Layered, HoldsDenseClusters) {
    constexpr int D = TypeParam::value;
    scenes::SkewedBoxes<D> scene(5000, 42);
    LayeredGrid<D> grid;
    grid.build(scene.boxes());
    for (int frame = 0; frame < 40; ++frame) {
        scene.step();
        grid.update(scene.boxes());
        if (frame % 8 == 0) {
            EXPECT_GT(check_pairs<D>(grid, scene.boxes()), 5000u) << "seed 42, frame " << frame;
        }
    }
}

TYPED_TEST(Layered, HoldsBoxesThatEndAtTheBordersOfCells) {
    constexpr int D = TypeParam::value;
    // The edges of the cells are powers of two, and the borders are multiples of the edges.
    oracle::Random random(43);
    std::vector<Aabb<D>> boxes(1500);
    for (Aabb<D>& box : boxes) {
        const double edge = std::ldexp(1.0, static_cast<int>(random.below(3)) - 1);
        for (int axis = 0; axis < D; ++axis) {
            const double begin = edge * std::floor(random.uniform(-16, 16) / edge);
            box.min[axis] = static_cast<float>(begin);
            box.max[axis] = static_cast<float>(begin + edge * random.below(3));
        }
    }
    check_build_and_updates<D>(boxes, 0, random, 1500);
    for (Aabb<D>& box : boxes)
        for (int axis = 0; axis < D; ++axis) {
            if (random.chance(0.3)) box.min[axis] = std::nextafter(box.min[axis], -20.0f);
            if (random.chance(0.3)) box.max[axis] = std::nextafter(box.max[axis], 20.0f);
        }
    check_build_and_updates<D>(boxes, 0, random, 1500);
}

TYPED_TEST(Layered, IsNotSpoiledByOneThatFliesAway) {
    constexpr int D = TypeParam::value;
    oracle::Random random(44);
    std::vector<Aabb<D>> boxes;
    for (int i = 0; i < 3000; ++i) boxes.push_back(box_at<D>(random.in_cube<D>() * 20.0, DVec<D>(0.4)));
    boxes[7] = box_at<D>(DVec<D>(1e30), DVec<D>(1e23));
    boxes[8] = box_at<D>(DVec<D>(-1e12), DVec<D>(1e5));
    LayeredGrid<D> grid;
    for (double far = 10; far < 1e38; far *= 7) {
        boxes[9] = box_at<D>(DVec<D>(far), DVec<D>(0.5));
        if (far == 10)
            grid.build(boxes);
        else
            grid.update(boxes);
        check_pairs<D>(grid, boxes);
        std::set<std::uint32_t> near;
        grid.closest(
            Vec<D>(static_cast<float>(far)), [&](std::uint32_t i) { near.insert(i); }, 1.0f);
        EXPECT_TRUE(near.contains(9)) << far;
    }
}

TYPED_TEST(Layered, HasTheOrderOfANewOneAfterAnUpdate) {
    constexpr int D = TypeParam::value;
    oracle::Random random(45);
    const auto wide = all_sizes<D>(random, 4000, 5, 12, DVec<D>(0.0));
    auto small = all_sizes<D>(random, 4000, -8, 0, DVec<D>(100.0));
    LayeredGrid<D> grid, fresh;
    grid.build(wide);
    grid.update(small);
    fresh.build(small);
    EXPECT_EQ(pairs_in_order(grid), pairs_in_order(fresh));
    grid.update(wide);
    check_pairs<D>(grid, wide);
}

TYPED_TEST(Layered, VisitsFewForTheNearest) {
    constexpr int D = TypeParam::value;
    // The boxes are ten thousand cells apart.
    std::vector<Aabb<D>> boxes;
    for (int i = 0; i < 1000; ++i) boxes.push_back(box_at<D>(axis<D>(0) * (1e4 * i), DVec<D>(0.5)));
    LayeredGrid<D> grid;
    grid.build(boxes);
    for (const float x : {-5e6f, 3e4f, 7.004e6f, 5e7f}) {
        int near = 0, hits = 0;
        grid.closest(Vec<D>(axis<D>(0)) * x, [&](std::uint32_t i) {
            ++near;
            return std::max({0.0f, boxes[i].min[0] - x, x - boxes[i].max[0]});
        });
        EXPECT_LE(near, 8) << x;
        grid.raycast(Ray<D>{Vec<D>(axis<D>(0)) * x, Vec<D>(axis<D>(0))}, [&](std::uint32_t i) {
            ++hits;
            return std::max(0.0f, boxes[i].min[0] - x);
        });
        EXPECT_LE(hits, 8) << x;
    }
}

/// A face, or a coordinate of a query, of any magnitude.
float any_number(oracle::Random& random) {
    constexpr float far = std::numeric_limits<float>::infinity(), largest = std::numeric_limits<float>::max();
    constexpr float numbers[] = {0, 1, 1e-45f, 1e-30f, 1e30f, largest, far};
    const float number =
        random.chance(0.5) ? numbers[random.below(7)] : static_cast<float>(random.power_of_two(-149, 127));
    return random.chance(0.5) ? number : -number;
}

/// Searches proceed in regions of growing size. They end, and visit all, even if no region contains all boxes, or if
/// the first is too small to change any coordinate.
TYPED_TEST(Layered, SearchesEndWhateverTheNumbers) {
    constexpr int D = TypeParam::value;
    oracle::Random random(46);
    const auto any_vector = [&] {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = any_number(random);
        return result;
    };
    std::size_t along = 0, near = 0;
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE(testing::Message() << "seed 46, round " << round);
        std::vector<Aabb<D>> boxes(1 + random.below(40));
        for (Aabb<D>& box : boxes) {
            const Vec<D> a = any_vector(), b = random.chance(0.2) ? a : any_vector();
            box = {glm::min(a, b), glm::max(a, b)};
        }
        LayeredGrid<D> grid;
        BruteForce<D> oracle;
        grid.build(boxes);
        oracle.build(boxes);
        for (int query = 0; query < 10; ++query) {
            MovingBox<D> moving{DVec<D>(any_vector()), DVec<D>(random.below(2)), DVec<D>(any_vector()), 1};
            moving.direction *= random.power_of_two(-200, 0);
            if (random.chance(0.5)) moving.length = std::abs(static_cast<double>(any_number(random)));
            const Vec<D> point = any_vector();
            const auto visited = [&](const auto& phase) {
                std::pair<std::set<std::uint32_t>, std::set<std::uint32_t>> result;
                phase.sweep(moving, [&](std::uint32_t i) { EXPECT_TRUE(result.first.insert(i).second); });
                phase.closest(point, [&](std::uint32_t i) { EXPECT_TRUE(result.second.insert(i).second); });
                return result;
            };
            const auto expected = visited(oracle);
            EXPECT_EQ(visited(grid), expected);
            along += expected.first.size();
            near += expected.second.size();
        }
    }
    EXPECT_GT(along, 3000u);
    EXPECT_GT(near, 3000u);
}

}  // namespace
}  // namespace abut::test
