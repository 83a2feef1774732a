// Cases that only splitting planes have: boxes that end at a plane, deep trees, and updates in which few boxes move.

#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

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

TEST(Bsp, BuildsADeepTree) {
    // The points approach 0 along each axis, each at half the distance of the one before.
    std::vector<Aabb3> boxes;
    for (int exponent = -148; exponent < 120; ++exponent)
        for (int axis = 0; axis < 3; ++axis)
            for (int copy = 0; copy < 6; ++copy) {
                Vec3 point(0);
                point[axis] = std::ldexp(1.0f, exponent);
                boxes.push_back({point, point});
            }
    Bsp<3> tree;
    tree.build(boxes);
    EXPECT_EQ(pairs_of(tree).size(), boxes.size() * 5 / 2);
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

TEST(Bsp, ReportsEachOnceOnALattice) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        expect_the_same_on_a_lattice<2>(seed);
        expect_the_same_on_a_lattice<3>(seed);
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

TEST(Bsp, KeepsItsOrderWhileNothingMoves) {
    oracle::Random random(44);
    auto boxes = make_scene<3>(Scene::holes_and_endless, 500, random);
    Bsp<3> tree;
    tree.build(boxes);
    boxes[3] = some_box<3>(random, 5, 2);
    tree.update(boxes);
    const auto order = pairs_of(tree);
    tree.update(boxes);
    EXPECT_EQ(pairs_of(tree), order);
    EXPECT_GT(order.size(), 100u);
}

TEST(Bsp, FindsBoxesThatCameAndWent) {
    std::vector<Aabb2> boxes(20, {Vec2(0), Vec2(1)});
    boxes[4] = Aabb2::empty();
    Bsp<2> tree;
    tree.build(boxes);
    EXPECT_EQ(pairs_of(tree).size(), 19u * 18 / 2);
    std::swap(boxes[4], boxes[5]);
    tree.update(boxes);
    EXPECT_EQ(pairs_of(tree).size(), 19u * 18 / 2);
    boxes[5] = boxes[4];
    tree.update(boxes);
    EXPECT_EQ(pairs_of(tree).size(), 20u * 19 / 2);
}

TEST(Bsp, IsRightAfterManySmallMoves) {
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

TEST(Bsp, VisitsTheNearFirst) {
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
