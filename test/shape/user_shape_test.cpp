// User-defined shapes, found by argument-dependent lookup: a convex one and a composite one, in every query.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/placed.hpp>

#include <set>
#include <vector>

namespace game {

using abut::Aabb3;
using abut::Vec3;

struct Ellipsoid {
    Vec3 center;
    Vec3 radii;
};
Aabb3 bounds(const Ellipsoid& e) {
    return {e.center - e.radii, e.center + e.radii};
}
Vec3 support(const Ellipsoid& e, const Vec3& direction) {
    const Vec3 scaled = e.radii * direction;
    const float norm = std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
    return e.center + e.radii * scaled / norm;
}

/// A grid of solid and empty cells, each one unit wide.
struct Voxels {
    int columns, rows, layers;
    std::vector<bool> solid;

    bool at(int x, int y, int z) const { return solid[static_cast<std::size_t>((z * rows + y) * columns + x)]; }
};
Aabb3 bounds(const Voxels& v) {
    return {{0, 0, 0}, {v.columns, v.rows, v.layers}};
}
template <class Visit>
void each_part(const Voxels& v, const Aabb3& box, Visit&& visit) {
    std::uint32_t index = 0;
    for (int z = 0; z < v.layers; ++z)
        for (int y = 0; y < v.rows; ++y)
            for (int x = 0; x < v.columns; ++x, ++index) {
                const Aabb3 cell{{x, y, z}, {x + 1, y + 1, z + 1}};
                if (v.at(x, y, z) && overlaps(cell, box) && !visit(cell, index)) return;
            }
}

}  // namespace game

namespace abut {

using namespace detail;

namespace {

using game::Ellipsoid;
using game::Voxels;
using oracle::near;

TEST(UserShape, OfASupportFunctionIsConvex) {
    static_assert(Shape<Ellipsoid> && dimension<Ellipsoid> == 3 && Pair<Ellipsoid, Voxels> && !Pair<Ellipsoid, Circle>);
}

TEST(UserShape, OfASupportFunctionAnswersEveryQuestion) {
    const Ellipsoid egg{{0, 0, 0}, {2, 1, 1}};
    const Sphere beside{{4, 0, 0}, 1};
    EXPECT_FALSE(overlaps(egg, beside));
    const Closest<3> gap = closest(egg, beside);
    EXPECT_NEAR(gap.distance, 1, 1e-5);
    EXPECT_TRUE(near(gap.on_a, Vec3(2, 0, 0), 1e-3));
    const Sphere into{{0, 1.75f, 0}, 1};
    EXPECT_TRUE(overlaps(egg, into));
    EXPECT_NEAR(closest(into, egg).distance, -0.25, 1e-3);
    const Contact<3> touch = contact(egg, into);
    ASSERT_EQ(touch.points.size(), 1u);
    EXPECT_NEAR(touch.depth, 0.25, 1e-3);
    EXPECT_TRUE(near(touch.points[0].position, Vec3(0, 0.875f, 0), 1e-2));
    EXPECT_TRUE(contains(egg, Vec3(1.99f, 0, 0)));
    EXPECT_FALSE(contains(egg, Vec3(2.01f, 0, 0)));
    const auto hit = raycast(Ray3{{-5, 0, 0}, {1, 0, 0}, 10}, egg);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 3, 1e-4);
    EXPECT_NEAR(closest(at(egg, Pose3{{0, 5, 0}}), HalfSpace3{{0, 1, 0}, 0}).distance, 4, 1e-5);
    EXPECT_NEAR(closest(rounded(egg, 0.5f), beside).distance, 0.5, 1e-5);
}

TEST(UserShape, AgreesWithTheSameShapeMadeOfViews) {
    int overlapping = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const Vec3 radii(random.uniform_float(0.3, 2), random.uniform_float(0.3, 2), random.uniform_float(0.3, 2));
        const Ellipsoid egg{{0, 0, 0}, radii};
        const auto same = stretched(Sphere{{0, 0, 0}, 1}, radii);
        const Box3 box{to_float(random.in_cube<3>() * 2.2), {1, 0.5f, 0.7f}, random.rotation<3>()};
        const Closest<3> mine = closest(egg, box), ours = closest(same, box);
        // Both are at most 1e-3 of the size above the least depth; gaps are right to rounding.
        EXPECT_NEAR(mine.distance, ours.distance, mine.distance > 0 ? 1e-5 : 2e-3);
        overlapping += ours.distance <= 0 ? 1 : 0;
    }
    EXPECT_GT(overlapping, 150);
    EXPECT_LT(overlapping, 350);
}

/// An L of five cells along x and three along y, one layer thick.
Voxels corner_of_cells() {
    Voxels v{5, 3, 1, std::vector<bool>(15, false)};
    for (int x = 0; x < 5; ++x) v.solid[static_cast<std::size_t>(x)] = true;
    v.solid[5] = v.solid[10] = true;
    return v;
}

TEST(UserShape, OfPartsAnswersEveryQuestion) {
    const Voxels voxels = corner_of_cells();
    // In the hollow of the L: one from the cells to its left, and half a unit above those below.
    const Sphere hollow{{3, 2.5f, 0.5f}, 1};
    EXPECT_FALSE(overlaps(voxels, hollow));
    const Closest<3> gap = closest(voxels, hollow);
    EXPECT_NEAR(gap.distance, 0.5, 1e-6);
    EXPECT_TRUE(near(gap.normal, Vec3(0, 1, 0)));
    EXPECT_TRUE(gap.feature_a.part == 2 || gap.feature_a.part == 3);
    // Sunk into the cells below by a quarter.
    const Sphere sunk{{3.5f, 1.75f, 0.5f}, 1};
    EXPECT_TRUE(overlaps(sunk, voxels));
    const Contact<3> touch = contact(voxels, sunk);
    ASSERT_TRUE(touch);
    EXPECT_NEAR(touch.depth, 0.25, 1e-6);
    EXPECT_EQ(touch.feature_a.part, 3u);
    EXPECT_EQ(closest(sunk, voxels).feature_b.part, 3u);
    EXPECT_TRUE(contains(voxels, Vec3(0.5f, 2.5f, 0.5f)));
    EXPECT_FALSE(contains(voxels, Vec3(1.5f, 2.5f, 0.5f)));
    const auto hit = raycast(Ray3{{5, 2.5f, 0.5f}, {-1, 0, 0}, 10}, voxels);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 4, 1e-6);
    EXPECT_EQ(hit->feature.part, 10u);
    EXPECT_NEAR(closest(voxels, HalfSpace3{{0, 1, 0}, -2}).distance, 2, 1e-6);
    EXPECT_NEAR(closest(voxels, at(voxels, Pose3{{10, 0, 0}})).distance, 5, 1e-6);
}

TEST(UserShape, OfPartsCanBePlacedRoundedAndStretched) {
    const Voxels voxels = corner_of_cells();
    const Pose3 quarter{{0, 0, 0}, turn_about({0, 0, 1}, 1.57079633f)};
    // Rotated by a quarter, the L is at x from -3 to 0, its long arm along y.
    EXPECT_NEAR(closest(at(voxels, quarter), Vec3(-0.5f, 7, 0.5f)).distance, 2, 1e-5);
    EXPECT_NEAR(closest(rounded(voxels, 0.25f), Vec3(2.5f, 3, 0.5f)).distance, 1.25, 1e-5);
    // Stretched threefold along x, the short arm ends at 3: out there two left, below three.
    EXPECT_NEAR(closest(stretched(voxels, Vec3(3, 2, 1)), Vec3(5, 5, 0.5f)).distance, 2, 1e-5);
    EXPECT_NEAR(closest(rounded(at(rounded(voxels, 0.25f), quarter), 0.5f), Vec3(-0.5f, 7, 0.5f)).distance, 1.25, 1e-5);
}

TEST(UserShape, WithoutPartsIsInfinitelyFar) {
    const Voxels nothing{2, 2, 2, std::vector<bool>(8, false)};
    const Sphere sphere{{1, 1, 1}, 1};
    EXPECT_FALSE(overlaps(nothing, sphere));
    EXPECT_FALSE(contact(nothing, sphere));
    EXPECT_FALSE(contains(nothing, Vec3(1, 1, 1)));
    EXPECT_FALSE(raycast(Ray3{{-5, 1, 1}, {1, 0, 0}, 10}, nothing));
    const Closest<3> found = closest(nothing, sphere);
    EXPECT_EQ(found.distance, std::numeric_limits<float>::infinity());
    EXPECT_TRUE(oracle::is_unit(found.normal));
}

TEST(UserShape, OfPartsAgreesWithTryingThemAll) {
    int overlapping = 0, far = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        Voxels voxels{4, 4, 4, {}};
        for (int i = 0; i < 64; ++i) voxels.solid.push_back(random.chance(0.2));
        const Pose3 pose{to_float(random.in_cube<3>()), random.rotation<3>()};
        const double spread = random.chance(0.1) ? 100 : 4;
        const Box3 box{
            pose * to_float(DVec<3>(2.0) + random.in_cube<3>() * spread), {0.5f, 1, 2}, random.rotation<3>()};
        float least = std::numeric_limits<float>::infinity();
        each_part(voxels, bounds(voxels), [&](const Aabb3& cell, std::uint32_t) {
            least = std::min(least, closest(at(cell, pose), box).distance);
            return true;
        });
        EXPECT_FLOAT_EQ(closest(at(voxels, pose), box).distance, least);
        EXPECT_FLOAT_EQ(closest(box, at(voxels, pose)).distance, least);
        EXPECT_EQ(overlaps(at(voxels, pose), box), least <= 0);
        EXPECT_EQ(static_cast<bool>(contact(box, at(voxels, pose))), least <= 0);
        overlapping += least <= 0 ? 1 : 0;
        far += least > 20 ? 1 : 0;
    }
    EXPECT_GT(overlapping, 90);
    EXPECT_LT(overlapping, 210);
    EXPECT_GT(far, 5);
}

}  // namespace
}  // namespace abut
