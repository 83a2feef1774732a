// What is the planes' own: items on both sides of one, what a tree may use up, and what is put in anew.

#include "executors.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Items = std::vector<std::uint32_t>;

template <class T>
std::vector<ItemPair> pairs_of(const T& phase) {
    std::vector<ItemPair> result;
    phase.each_pair([&](std::uint32_t i, std::uint32_t j) { result.emplace_back(i, j); });
    return result;
}

template <class T>
std::vector<ItemPair> sorted_pairs_of(const T& phase) {
    std::vector<ItemPair> result = pairs_of(phase);
    std::sort(result.begin(), result.end());
    return result;
}

template <class T, int D>
Items along(const T& phase, const Ray<D>& ray) {
    Items result;
    phase.raycast(ray, [&](std::uint32_t i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
}

template <class T, int D>
Items overlapping(const T& phase, const Aabb<D>& box) {
    Items result;
    phase.each_overlapping(box, [&](std::uint32_t i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
}

template <class T, int D>
Items near(const T& phase, const Aabb<D>& box, float reach) {
    Items result;
    phase.closest(
        box, [&](std::uint32_t i) { result.push_back(i); }, reach);
    std::sort(result.begin(), result.end());
    return result;
}

/// The tree of some boxes, as the broad phase makes it.
template <int D>
BspTree<D> tree_of(const std::vector<Aabb<D>>& boxes) {
    BspTree<D> tree;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) tree.items.push_back({boxes[i], i});
    build_tree(tree);
    return tree;
}

template <int D>
std::size_t mentions(const BspTree<D>& tree) {
    std::size_t result = 0;
    for (const BspNode& node : tree.nodes) result += node.count;
    return result;
}

template <int D>
int depth_of(const BspTree<D>& tree, std::uint32_t index = 0) {
    const BspNode& node = tree.nodes[index];
    return node.is_leaf() ? 0 : 1 + std::max(depth_of(tree, index + 1), depth_of(tree, node.above()));
}

TEST(Bsp, TheFloatBeforeIsTheNextLower) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    for (const float x : {0.0f, -0.0f, 1.0f, -1.0f, least, -least, most, 1e-30f, -3.5f})
        EXPECT_EQ(float_before(x), std::nextafter(x, -std::numeric_limits<float>::infinity())) << x;
}

TEST(Bsp, UsesNoMoreThanIsStated) {
    oracle::Random random(41);
    for (const Scene scene : all_scenes)
        for (const std::uint32_t count : {1u, 10u, 1000u, 5000u}) {
            const auto boxes = make_scene<3>(scene, count, random);
            const BspTree<3> tree = tree_of(boxes);
            EXPECT_LE(tree.nodes.size(), count + 1u);
            EXPECT_LE(mentions(tree), 2u * count);
            EXPECT_LE(tree.used, tree.words.size());
            EXPECT_LE(tree.words.size(), 4u * count + 8);
            EXPECT_LE(depth_of(tree), bsp_depth);
        }
}

TEST(Bsp, IsNeverDeeperThanItsStacks) {
    // Ever nearer to 0 along each axis in turn, each step half of the last.
    std::vector<Aabb3> boxes;
    for (int exponent = -148; exponent < 120; ++exponent)
        for (int axis = 0; axis < 3; ++axis)
            for (int copy = 0; copy < 6; ++copy) {
                Vec3 point(0);
                point[axis] = std::ldexp(1.0f, exponent);
                boxes.push_back({point, point});
            }
    const int depth = depth_of(tree_of(boxes));
    EXPECT_GT(depth, 32) << "too easy to prove anything";
    EXPECT_LE(depth, bsp_depth);
    Bsp<3> tree;
    tree.build(boxes);
    EXPECT_EQ(pairs_of(tree).size(), boxes.size() * 5 / 2);
}

TEST(Bsp, PartsWhatCanBeParted) {
    oracle::Random random(42);
    const BspTree<3> tree = tree_of(make_scene<3>(Scene::uniform, 5000, random));
    std::uint32_t largest = 0;
    for (const BspNode& node : tree.nodes) largest = std::max(largest, node.count);
    EXPECT_LT(largest, 40u);
    // Of what the whole scene is full of, the planes keep most: it isn't told to every leaf.
    auto boxes = make_scene<3>(Scene::uniform, 5000, random);
    for (std::size_t i = 0; i < 500; ++i) boxes[10 * i] = box_at<3>(random.in_cube<3>() * 4.0, DVec<3>(12.0));
    const BspTree<3> mixed = tree_of(boxes);
    std::size_t looks = 0;
    for (const BspNode& node : mixed.nodes) looks += node.is_leaf() ? node.count : 0;
    EXPECT_LT(looks, 2u * boxes.size());
    std::uint32_t fullest_leaf = 0;
    for (const BspNode& node : mixed.nodes) fullest_leaf = std::max(fullest_leaf, node.is_leaf() ? node.count : 0);
    EXPECT_LT(fullest_leaf, 100u);
}

// On whole numbers planes, faces, corners and rays meet exactly.
template <int D>
void expect_the_same_on_a_lattice(std::uint64_t seed) {
    oracle::Random random(seed);
    const auto whole = [&](int range) {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = static_cast<float>(random.below(static_cast<std::uint32_t>(range)));
        return result;
    };
    std::vector<Aabb<D>> boxes(400);
    for (Aabb<D>& box : boxes) {
        box.min = whole(12);
        box.max = box.min + whole(random.chance(0.1) ? 9 : 3);
    }
    Bsp<D> tree;
    BruteForce<D> oracle;
    tree.build(boxes);
    oracle.build(boxes);
    EXPECT_EQ(sorted_pairs_of(tree), sorted_pairs_of(oracle));
    std::size_t found = 0;
    for (int repeat = 0; repeat < 1000; ++repeat) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << " repeat " << repeat);
        Ray<D> ray{whole(14), whole(5) - Vec<D>(2)};
        if (random.chance(0.5)) ray.length = static_cast<float>(random.below(5));
        EXPECT_EQ(along(tree, ray), along(oracle, ray));
        ray.origin += Vec<D>(0.37f);
        ray.direction = Vec<D>(random.direction<D>());
        EXPECT_EQ(along(tree, ray), along(oracle, ray));
        found += along(tree, ray).size();
        Aabb<D> box{whole(12), {}};
        box.max = box.min + whole(4);
        EXPECT_EQ(overlapping(tree, box), overlapping(oracle, box));
        const float reach = static_cast<float>(random.below(4));
        EXPECT_EQ(near(tree, box, reach), near(oracle, box, reach));
        // A corner of a box through which a ray just comes, in directions that round.
        const Vec<D> origin = whole(14) + Vec<D>(random.in_cube<D>() * 0.5);
        const Ray<D> at_corner = Ray<D>::between(origin, random.chance(0.5) ? boxes[7].min : boxes[11].max);
        EXPECT_EQ(along(tree, at_corner), along(oracle, at_corner));
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(found, 1000u);
}

TEST(Bsp, TellsEachOnceOnALattice) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        expect_the_same_on_a_lattice<2>(seed);
        expect_the_same_on_a_lattice<3>(seed);
    }
}

/// Every item is where a tree puts it: on both sides of the planes that it meets, until one keeps it.
template <int D>
void expect_in_its_cells(const BspTree<D>& tree, std::uint32_t item, std::uint32_t index) {
    const BspNode& node = tree.nodes[index];
    const auto begin = tree.words.begin() + node.first, end = begin + node.count;
    const auto times = std::count(begin, end, item);
    EXPECT_LE(times, 1);
    if (times == 1) return;
    ASSERT_FALSE(node.is_leaf());
    if (tree.items[item].box.min[node.axis()] < node.plane) expect_in_its_cells(tree, item, index + 1);
    if (tree.items[item].box.max[node.axis()] >= node.plane) expect_in_its_cells(tree, item, node.above());
}

TEST(Bsp, EveryItemIsInItsCells) {
    oracle::Random random(43);
    for (const Scene scene : all_scenes) {
        const BspTree<3> tree = tree_of(make_scene<3>(scene, 400, random));
        for (std::uint32_t item = 0; item < tree.items.size(); ++item) {
            const Aabb3& box = tree.items[item].box;
            if (overlaps(box, box)) expect_in_its_cells(tree, item, 0);
        }
    }
}

template <int D>
void expect_the_same_while_few_move(Scene scene, std::uint64_t seed) {
    oracle::Random random(seed);
    auto boxes = make_scene<D>(scene, 600, random);
    Bsp<D> tree;
    tree.build(boxes);
    BruteForce<D> oracle;
    for (int frame = 0; frame < 30; ++frame) {
        std::vector<Aabb<D>> few;
        Items which;
        for (std::uint32_t i = 0; i < random.below(60); ++i) {
            which.push_back(random.below(600));
            few.push_back(boxes[which.back()]);
        }
        move_some(few, random);
        for (std::size_t i = 0; i < few.size(); ++i) boxes[which[i]] = few[i];
        tree.update(boxes);
        oracle.build(boxes);
        ASSERT_EQ(sorted_pairs_of(tree), sorted_pairs_of(oracle)) << "seed " << seed << " frame " << frame;
        EXPECT_EQ(tree.bounds(), oracle.bounds());
        for (int repeat = 0; repeat < 10; ++repeat) {
            const Aabb<D> box = some_box<D>(random, 12, 4);
            EXPECT_EQ(overlapping(tree, box), overlapping(oracle, box));
            EXPECT_EQ(near(tree, box, 2), near(oracle, box, 2));
            const Ray<D> ray{box.min, Vec<D>(random.direction<D>())};
            EXPECT_EQ(along(tree, ray), along(oracle, ray));
        }
        ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " frame " << frame;
    }
}

TEST(Bsp, IsRightWhileFewMove) {
    for (const Scene scene : all_scenes) {
        if (scene == Scene::coincident) continue;  // a third of a million pairs a frame
        SCOPED_TRACE(static_cast<int>(scene));
        expect_the_same_while_few_move<2>(scene, 51);
        expect_the_same_while_few_move<3>(scene, 52);
    }
}

TEST(Bsp, StandsStillWhereNothingMoves) {
    oracle::Random random(44);
    auto boxes = make_scene<3>(Scene::holes_and_endless, 500, random);
    Bsp<3> tree;
    tree.build(boxes);
    boxes[3] = some_box<3>(random, 5, 2);
    tree.update(boxes);
    const auto order = pairs_of(tree);
    tree.update(boxes);
    EXPECT_EQ(pairs_of(tree), order) << "one put in anew is not where a build would have it";
}

TEST(Bsp, ManyThatMoveLittleAreFewByFew) {
    // More are put in anew, all together, than there is room for.
    oracle::Random random(45);
    auto boxes = make_scene<2>(Scene::uniform, 2000, random);
    Bsp<2> tree;
    tree.build(boxes);
    BruteForce<2> oracle;
    for (std::uint32_t frame = 0; frame < 100; ++frame) {
        for (std::uint32_t i = 0; i < 200; ++i) {
            Aabb2& box = boxes[(200 * frame + 7 * i) % 2000];
            const Vec2 step(random.in_cube<2>() * 3.0);
            box = {box.min + step, box.max + step};
        }
        tree.update(boxes);
    }
    oracle.build(boxes);
    EXPECT_EQ(sorted_pairs_of(tree), sorted_pairs_of(oracle));
}

TEST(Bsp, TakesTheLargestNumbersAndPlacesAtInfinity) {
    constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    constexpr float far = std::numeric_limits<float>::infinity();
    std::vector<Aabb3> boxes;
    for (int i = 0; i < 12; ++i) {
        boxes.push_back({Vec3(-most), Vec3(most)});
        boxes.push_back({Vec3(most), Vec3(most)});
        boxes.push_back({Vec3(0), Vec3(least * static_cast<float>(i))});
        boxes.push_back({Vec3(far), Vec3(far)});
        boxes.push_back({Vec3(-far), Vec3(far)});
    }
    Bsp<3> tree;
    BruteForce<3> oracle;
    tree.build(boxes);
    oracle.build(boxes);
    EXPECT_EQ(sorted_pairs_of(tree), sorted_pairs_of(oracle));
    for (const Aabb3& box : boxes) EXPECT_EQ(overlapping(tree, box), overlapping(oracle, box));
    for (const Aabb3& box : boxes) EXPECT_EQ(near(tree, box, 1), near(oracle, box, 1));
}

TEST(Bsp, AsksTheNearFirst) {
    std::vector<Aabb2> boxes;
    for (int i = 0; i < 1000; ++i) boxes.push_back(box_at<2>({2.0 * i, 0.0}, {0.5, 0.5}));
    Bsp<2> tree;
    tree.build(boxes);
    for (const float x : {-50.0f, 3.0f, 700.0f, 1500.0f, 5000.0f}) {
        int visits = 0;
        tree.closest(Vec2(x, 3), [&](std::uint32_t i) {
            ++visits;
            return static_cast<float>(length(DVec<2>(Vec2(x, 3)) - DVec<2>(center(boxes[i]))));
        });
        EXPECT_LE(visits, 8) << x;
        for (const float direction : {-1.0f, 1.0f}) {
            visits = 0;
            tree.raycast(Ray2{Vec2(x, 0), Vec2(direction, 0)}, [&](std::uint32_t i) {
                ++visits;
                return std::max(0.0f, direction * (boxes[i].min.x - x));
            });
            EXPECT_LE(visits, 8) << x;
        }
    }
}

}  // namespace
}  // namespace abut::test
