// The BVH: degenerate trees, and the number of visited items.

#include "scenes.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/bvh/subtree.hpp>

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
std::size_t count_pairs(const Bvh<D>& tree) {
    std::size_t result = 0;
    tree.each_pair([&](std::uint32_t, std::uint32_t) { ++result; });
    return result;
}

/// The nodes of bounded boxes, or of the same boxes treated as unbounded.
template <int D>
class Nodes {
public:
    Nodes(const std::vector<Aabb<D>>& boxes, bool bounded) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i) part_.items.push_back(detail::item_of(boxes[i], i));
        detail::build_subtree(part_, bounded, 0);
        walk(part_.root, 0);
    }
    int depth() const { return depth_; }
    double area() const { return area_; }

private:
    void walk(std::uint32_t ref, int depth) {
        depth_ = std::max(depth_, depth);
        if (detail::is_leaf(ref)) return;
        area_ += detail::children_area(part_.nodes[ref]);
        for (const std::uint32_t child : part_.nodes[ref].child)
            if (child != detail::bvh_none) walk(child, depth + 1);
    }

    detail::BvhSubtree<D> part_;
    int depth_ = 0;
    double area_ = 0;
};

TEST(Bvh, SplitsBetterThanInHalves) {
    oracle::Random random(12);
    for (const Scene scene : {Scene::uniform, Scene::clustered, Scene::mixed_sizes}) {
        const auto boxes = make_scene<3>(scene, 3000, random);
        // Splits in halves fill the leaves, which gives the minimal number of leaves.
        const double part = scene == Scene::clustered ? 0.95 : 1.03;
        EXPECT_LT(Nodes<3>(boxes, true).area(), part * Nodes<3>(boxes, false).area()) << static_cast<int>(scene);
    }
}

TEST(Bvh, SweepsABoxThroughAllThatItTouches) {
    oracle::Random random(13);
    int touched = 0, visited = 0;
    for (int i = 0; i < 200; ++i) {
        const auto boxes = make_scene<3>(Scene::mixed_sizes, 300, random);
        Bvh<3> tree;
        tree.build(boxes);
        const DVec<3> low(tree.bounds().min), high(tree.bounds().max), extent = high - low;
        MovingBox<3> moving;
        moving.center = low + (DVec<3>(0.5) + 0.5 * random.in_cube<3>()) * extent;
        moving.half = DVec<3>(random.unit(), random.unit(), random.chance(0.3) ? 0 : random.unit()) * (0.02 * extent.x);
        moving.direction = random.in_cube<3>() * extent;
        if (random.chance(0.3)) moving.direction.y = 0;
        moving.length = random.uniform(0, 1);
        std::vector<bool> seen(boxes.size());
        tree.sweep(moving, [&](std::uint32_t item) {
            seen[item] = true;
            ++visited;
        });
        // Samples of the moving box.
        for (int step = 0; step <= 50; ++step) {
            const DVec<3> now = moving.center + moving.direction * (moving.length * step / 50);
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                bool touches = true;
                for (int axis = 0; axis < 3; ++axis)
                    touches = touches && static_cast<double>(boxes[k].min[axis]) <= now[axis] + moving.half[axis] &&
                              now[axis] - moving.half[axis] <= static_cast<double>(boxes[k].max[axis]);
                EXPECT_TRUE(!touches || seen[k]) << i << " " << step;
            }
        }
        // After a visitor shortens the reach to 0, no item ahead is visited.
        std::size_t few = 0;
        tree.sweep(moving, [&](std::uint32_t) -> float {
            ++few;
            return -1;
        });
        EXPECT_LE(few, 1u);
        touched += static_cast<int>(std::count(seen.begin(), seen.end(), true));
    }
    EXPECT_GT(touched, 200);
    EXPECT_EQ(visited, touched) << "each once";
}

TEST(Bvh, IsNeverDeeperThanItsStacks) {
    // The boxes approach 0 along each axis in turn, each step half of the last, so that every split separates only a
    // few.
    std::vector<Aabb3> boxes;
    for (int exponent = -148; exponent < 120; ++exponent)
        for (int axis = 0; axis < 3; ++axis)
            for (int copy = 0; copy < 4; ++copy) {
                Vec3 point(0);
                point[axis] = std::ldexp(1.0f, exponent);
                boxes.push_back({point, point});
            }
    const int depth = Nodes<3>(boxes, true).depth();
    EXPECT_GT(depth, 2) << "too easy to prove anything";
    EXPECT_LE(depth, detail::bvh_depth);
}

TEST(Bvh, PartsWhatCoincidesByIndex) {
    const std::vector<Aabb2> boxes(1000, {Vec2(0), Vec2(1)});
    Bvh<2> tree;
    tree.build(boxes);
    std::uint32_t next = 0;
    tree.each_overlapping(boxes[0], [&](std::uint32_t i) { EXPECT_EQ(i, next++); });
    EXPECT_EQ(next, 1000u);
}

TEST(Bvh, TakesManyBoxesInOnePlace) {
    std::vector<Aabb3> boxes(100000, {Vec3(0), Vec3(1)});
    Bvh<3> tree;
    tree.build(boxes);
    std::size_t found = 0;
    tree.each_overlapping({Vec3(1), Vec3(2)}, [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, boxes.size());
    tree.update(boxes);
    EXPECT_EQ(tree.bounds(), boxes[0]);
}

TEST(Bvh, TakesPointsThatHalveTheirWay) {
    // Each split by cost separates only a few: without a limit of depth, the tree would be a list.
    std::vector<Aabb2> boxes;
    for (int exponent = -148; exponent < 127; ++exponent)
        for (int copy = 0; copy < 20; ++copy) {
            const Vec2 point(std::ldexp(1.0f, exponent));
            boxes.push_back({point, point});
        }
    Bvh<2> tree;
    tree.build(boxes);
    // The 20 points of a place pair with one another, and no others.
    EXPECT_EQ(count_pairs(tree), boxes.size() * 19 / 2);
    for (std::uint32_t i = 0; i < boxes.size(); i += 20) {
        std::uint32_t found = 0, near = 0;
        tree.each_overlapping(boxes[i], [&](std::uint32_t item) { found += item / 20 == i / 20 ? 1 : 100; });
        tree.closest(boxes[i].min, [&](std::uint32_t) { return ++near, 0.0f; });
        EXPECT_EQ(found, 20u);
        EXPECT_GE(near, 20u);
    }
}

TEST(Bvh, TakesTheLargestNumbers) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    std::vector<Aabb3> boxes;
    for (int i = 0; i < 12; ++i) {
        boxes.push_back({Vec3(-most), Vec3(most)});
        boxes.push_back({Vec3(most), Vec3(most)});
        boxes.push_back({Vec3(0), Vec3(least * static_cast<float>(i))});
    }
    Bvh<3> tree;
    tree.build(boxes);
    // 66 within each of three kinds, and 12 * 24 of the large ones with the others.
    EXPECT_EQ(count_pairs(tree), 3u * 66 + 12 * 24);
}

TEST(Bvh, NewcomersAndHolesInAnUpdate) {
    std::vector<Aabb2> boxes(40, Aabb2::empty());
    Bvh<2> tree;
    tree.build(boxes);
    EXPECT_EQ(tree.size(), 40u);
    EXPECT_FALSE(tree.empty());
    EXPECT_EQ(tree.bounds(), Aabb2::empty());
    for (std::size_t i = 0; i < 10; ++i) boxes[3 * i] = {Vec2(static_cast<float>(i)), Vec2(static_cast<float>(i) + 1)};
    tree.update(boxes);
    EXPECT_EQ(count_pairs(tree), 9u);
    for (std::size_t i = 0; i < 5; ++i) boxes[3 * i] = Aabb2::empty();
    tree.update(boxes);
    EXPECT_EQ(count_pairs(tree), 4u);
    boxes[0] = {Vec2(5), Vec2(6)};    // a place that was used before
    boxes[1] = {Vec2(20), Vec2(21)};  // and one that was not
    tree.update(boxes);
    EXPECT_EQ(count_pairs(tree), 6u);
    EXPECT_EQ(tree.bounds().max, Vec2(21));
}

/// The number of visits to find the nearest of many items.
int visits_to_nearest(const Bvh<2>& tree, const std::vector<Aabb2>& boxes, const Vec2& point) {
    int visits = 0;
    tree.closest(point, [&](std::uint32_t i) {
        ++visits;
        const DVec<2> gap = DVec<2>(point) - DVec<2>(center(boxes[i]));
        return static_cast<float>(length(gap));
    });
    return visits;
}

TEST(Bvh, VisitsTheNearestFirst) {
    std::vector<Aabb2> boxes;
    for (int i = 0; i < 1000; ++i) boxes.push_back(box_at<2>({2.0 * i, 0.0}, {0.5, 0.5}));
    Bvh<2> tree;
    tree.build(boxes);
    for (const float x : {-50.0f, 3.0f, 700.0f, 1500.0f, 5000.0f}) {
        EXPECT_LE(visits_to_nearest(tree, boxes, {x, 3}), 8) << x;
        for (const float direction : {-1.0f, 1.0f}) {
            int visits = 0;
            const Ray2 ray{Vec2(x, 0), Vec2(direction, 0)};
            tree.raycast(ray, [&](std::uint32_t i) {
                ++visits;
                return std::max(0.0f, direction * (boxes[i].min.x - x));
            });
            EXPECT_LE(visits, 8) << x;
        }
    }
}

TEST(Bvh, StaysGoodWhileEverythingMixes) {
    oracle::Random random(9);
    auto boxes = make_scene<2>(Scene::uniform, 2000, random);
    Bvh<2> updated;
    updated.build(boxes);
    for (int frame = 0; frame < 60; ++frame) {
        for (Aabb2& box : boxes) {
            const Vec2 step(random.in_cube<2>() * 4.0);
            box = {box.min + step, box.max + step};
        }
        updated.update(boxes);
    }
    Bvh<2> fresh;
    fresh.build(boxes);
    int updated_visits = 0, fresh_visits = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
        const Vec2 point(random.in_cube<2>() * 40.0);
        updated_visits += visits_to_nearest(updated, boxes, point);
        fresh_visits += visits_to_nearest(fresh, boxes, point);
    }
    EXPECT_LT(updated_visits, 1.5 * fresh_visits);
}

TEST(Bvh, IsAValue) {
    oracle::Random random(2);
    const auto boxes = make_scene<3>(Scene::uniform, 50, random);
    Bvh<3> tree;
    tree.build(boxes);
    const Bvh<3> copy = tree;
    tree.build({});
    Bvh<3> again;
    again.build(boxes);
    EXPECT_EQ(count_pairs(copy), count_pairs(again));
    EXPECT_EQ(count_pairs(tree), 0u);
}

}  // namespace
}  // namespace abut::test
