// Sweeps with rotation at composite shapes: the answer does not depend on the order of the parts.

#include "../../oracle/random.hpp"
#include "../../shape/meshes.hpp"
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/half_space.hpp>

#include <bit>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::Surface;

/// The triangles of a mesh in another order.
Surface shuffled(Surface surface, oracle::Random& random) {
    for (std::size_t i = surface.triangles.size(); i > 1; --i)
        std::swap(surface.triangles[i - 1], surface.triangles[random.below(static_cast<std::uint32_t>(i))]);
    return surface;
}

/// A tumbling motion past the shape, from outside or inside.
Motion3 some_motion(oracle::Random& random, double extent) {
    return {{to_float(random.in_cube<3>() * extent), random.rotation<3>()},
            to_float(random.in_cube<3>() * (2 * extent)),
            to_float(random.direction<3>() * random.uniform(0, 6))};
}

void expect_same_time(const std::optional<Hit<3>>& one, const std::optional<Hit<3>>& other, int& hits) {
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) return;
    ++hits;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(one->fraction), std::bit_cast<std::uint32_t>(other->fraction));
    EXPECT_EQ(one->started_inside, other->started_inside);
}

TEST(SweepRotatingParts, HaveTheSameTimeInAnyOrder) {
    const Box3 box{{0, 0, 0}, {0.5f, 0.2f, 0.1f}};
    const Capsule3 capsule{{-0.4f, 0, 0}, {0.5f, 0, 0}, 0.1f};
    int sweeps = 0, hits = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        // Many triangles are hit at about the same time, and some are doubled.
        Surface surface = test::random_soup(random, 60, 3, 1.5);
        surface.triangles.insert(surface.triangles.end(), surface.triangles.begin(), surface.triangles.begin() + 20);
        surface = joined(surface, test::box_surface(Vec3(-1, -0.5f, -0.2f), Vec3(1, 0, 0.3f)));
        const Mesh mesh = surface.mesh();
        const Surface small = test::box_surface(Vec3(-0.3f), Vec3(0.2f));
        const Mesh mover = small.mesh();
        for (int i = 0; i < 8; ++i) {
            const Mesh other = shuffled(surface, random).mesh(), other_mover = shuffled(small, random).mesh();
            const Motion3 motion = some_motion(random, 4), of_mesh = some_motion(random, 0.5);
            sweeps += 4;
            expect_same_time(sweep(box, motion, mesh, of_mesh), sweep(box, motion, other, of_mesh), hits);
            expect_same_time(sweep(capsule, motion, mesh), sweep(capsule, motion, other), hits);
            expect_same_time(sweep(mesh, of_mesh, box, motion), sweep(other, of_mesh, box, motion), hits);
            expect_same_time(sweep(mover, motion, mesh, of_mesh), sweep(other_mover, motion, other, of_mesh), hits);
        }
    }
    EXPECT_GT(hits, sweeps * 3 / 10);
    EXPECT_LT(hits, sweeps * 9 / 10);
}

TEST(SweepRotatingParts, OfAHalfSpaceHaveTheSameTimeInAnyOrder) {
    int sweeps = 0, hits = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const Surface surface = test::random_soup(random, 40, 1, 0.5);
        const Motion3 motion = some_motion(random, 2);
        const HalfSpace3 ground{to_float(random.direction<3>()), -2};
        ++sweeps;
        expect_same_time(sweep(surface.mesh(), motion, ground), sweep(shuffled(surface, random).mesh(), motion, ground),
                         hits);
    }
    EXPECT_GT(hits, sweeps * 2 / 10);
    EXPECT_LT(hits, sweeps * 9 / 10);
}

// The time of impact of two parts does not depend on the search limit, if it is within it.
TEST(SweepRotatingParts, AreSearchedAlikeWithAnyReach) {
    const Box3 box{{0, 0, 0}, {0.5f, 0.2f, 0.1f}};
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const RigidPath<3> a = rigid_path(some_motion(random, 1)), b = rigid_path(some_motion(random, 1));
        RotatingImpact<3> whole, cut;
        if (!time_of_impact<3>(convex(box), a, convex(box), b, {}, {}, whole)) continue;
        ++hits;
        const double later = whole.time + (1 - whole.time) * random.unit();
        for (const double reach : {whole.time, later}) {
            ASSERT_TRUE(time_of_impact<3>(convex(box), a, convex(box), b, {.reach = reach}, {}, cut));
            EXPECT_EQ(cut.time, whole.time);
            EXPECT_EQ(cut.point, whole.point);
        }
        if (whole.time > 0) {
            EXPECT_FALSE(time_of_impact<3>(convex(box), a, convex(box), b, {.reach = 0.999 * whole.time}, {}, cut));
        }
    }
    EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace abut
