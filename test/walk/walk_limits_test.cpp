// Steps that are zero, too long or not numbers; a limit of crossings; and no allocations.

#include "../broad_phase/allocations.hpp"
#include "../oracle/expect.hpp"
#include "walk_check.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace {
int assertions = 0;  // the expected number depends on the build
}

// This program's assertion handler, which returns.
void abut::assert_failed(const char*, const char*, int) {
    ++assertions;
}

namespace abut::test {

using namespace detail;

namespace {

using oracle::near;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

class WalkLimits : public testing::Test {
protected:
    void SetUp() override { assertions = 0; }
};

TEST_F(WalkLimits, AStepOfNothingStays) {
    for (const NamedSurface& named : surfaces(1)) {
        const WalkMesh mesh = built(named.surface);
        for (const Vec3& weights : {Vec3(0.25f, 0.25f, 0.5f), Vec3(0, 0.5f, 0.5f), Vec3(0, 0, 1)}) {
            const Walked walked = mesh.walk({0, weights}, Vec3(0)), flat = mesh.walk({0, weights}, Vec2(0));
            EXPECT_EQ(walked.place, (WalkPoint{0, weights}));
            EXPECT_EQ(flat.place, (WalkPoint{0, weights}));
            for (const Walked& each : {walked, flat}) {
                EXPECT_EQ(each.length, 0);
                EXPECT_EQ(each.lost, 0);
                EXPECT_EQ(each.met, WalkMet::nothing);
                EXPECT_EQ(each.crossings, 0u);
            }
        }
    }
    EXPECT_EQ(assertions, 0);
}

TEST_F(WalkLimits, AStepThatIsNotANumberStays) {
    const WalkMesh mesh = built(flat(2, 2));
    const WalkPoint place{1, {0.25f, 0.25f, 0.5f}};
    int requested = 0;
    for (const float bad : {nan, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 step(0.5f);
            step[axis] = bad;
            const Walked walked = mesh.walk(place, step);
            EXPECT_EQ(walked.place, place) << bad << " " << axis;
            EXPECT_EQ(walked.length, 0);
            EXPECT_EQ(walked.met, WalkMet::nothing);
            EXPECT_EQ(mesh.walk(place, Vec2(bad, 0)).place, place);
            EXPECT_EQ(mesh.walk_in_triangle(place, step).end, place);
            EXPECT_EQ(mesh.walk_in_triangle(place, Vec2(0, bad)).end, place);
            requested += 4;
        }
#ifdef NDEBUG
    EXPECT_TRUE(assertions == 0 || assertions >= requested);
#else
    EXPECT_GE(assertions, requested);
#endif
}

TEST_F(WalkLimits, HugeStepsEndSomewhere) {
    // Millions of revolutions around a small ball, within the limit of crossings or with a report; the largest floats.
    oracle::Random random(20261123);
    const scenes::BumpyBall ball = scenes::bumpy_ball(6, 0.1, 0.02, random);
    const WalkMesh mesh = *WalkMesh::build(ball.points, ball.triangles);
    for (const float far : {1e3f, 1e6f, 1e9f, 1e20f, 1e30f, 3e38f}) {
        const Walked walked = mesh.walk({5, {0.25f, 0.25f, 0.5f}}, to_float(random.direction<3>()) * far);
        EXPECT_TRUE(are_valid_weights(walked.place.weights)) << far;
        EXPECT_TRUE(std::isfinite(walked.length) && std::isfinite(walked.lost)) << far;
        EXPECT_EQ(walked.met, far > 1e5f ? WalkMet::limit : WalkMet::nothing) << far;
        EXPECT_LE(walked.crossings, 1u << 20);
        EXPECT_TRUE(oracle::is_unit<3>(walked.turn * Vec3(0, 0, 1)));
        if (walked.met == WalkMet::limit) {
            EXPECT_EQ(walked.crossings, 1u << 20);
            EXPECT_GT(walked.length, 1e4f);
            EXPECT_GT(walked.lost, 0);
        }
    }
    // Against a wall, all but a little is lost.
    const WalkMesh floor = built(flat(3, 3));
    for (const float far : {1e9f, 1e30f, 3e38f}) {
        const Walked walked = floor.walk({0, {0.25f, 0.25f, 0.5f}}, Vec3(far, far * 0.5f, 0));
        EXPECT_TRUE(near<3>(floor.to_world(walked.place), {3, 3, 0}, 1e-5)) << far;
        EXPECT_EQ(walked.met, WalkMet::corner);
        EXPECT_TRUE(std::isfinite(walked.lost));
    }
    EXPECT_EQ(assertions, 0);
}

TEST_F(WalkLimits, TinyStepsAreStepsToo) {
    const WalkMesh mesh = built(box_surface({0, 0, 0}, {1, 1, 1}));
    for (const float far : {1e-6f, 1e-9f, 1e-20f, 1e-38f, 1e-44f})
        for (const Vec3& weights : {Vec3(0.25f, 0.25f, 0.5f), Vec3(0, 0.5f, 0.5f), Vec3(0, 0, 1)})
            for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
                const WalkPoint start{triangle, weights};
                const Walked walked = mesh.walk(start, Vec3(far, -far, far * 0.5f));
                EXPECT_TRUE(are_valid_weights(walked.place.weights)) << far;
                EXPECT_EQ(walked.met, WalkMet::nothing);
                EXPECT_TRUE(
                    near<3>(mesh.to_world(walked.place), mesh.to_world(start), 2 * static_cast<double>(far) + 1e-7));
            }
    EXPECT_EQ(assertions, 0);
}

TEST_F(WalkLimits, StopsAtItsLimitOfCrossings) {
    const WalkMesh mesh = built(flat(8, 1));
    for (std::uint32_t most = 0; most <= 20; ++most) {
        const WalkOptions options{.max_crossings = most};
        // Two edges each column; it begins between the column's diagonal and the next column.
        const Walked walked = mesh.walk({0, {0.25f, 0.5f, 0.25f}}, Vec3(6, 0, 0), options);
        if (most >= 12) {
            EXPECT_EQ(walked.met, WalkMet::nothing);
            EXPECT_EQ(walked.crossings, 12u);
            EXPECT_EQ(walked.lost, 0);
            continue;
        }
        EXPECT_EQ(walked.met, WalkMet::limit) << most;
        EXPECT_EQ(walked.crossings, most);
        EXPECT_FLOAT_EQ(walked.length + walked.lost, 6);
        // At the edge that the limit forbids to cross.
        const float x = mesh.to_world(walked.place).x;
        EXPECT_FLOAT_EQ(x, most % 2 == 0 ? 1 + static_cast<float>(most / 2) : 1.25f + static_cast<float>(most / 2));
        EXPECT_FLOAT_EQ(x - 0.75f, walked.length);
    }
}

TEST_F(WalkLimits, AllocatesNothing) {
    for (const NamedSurface& named : surfaces(1)) {
        const WalkMesh mesh = built(named.surface);
        const auto allow = [](const WalkSide& from, const WalkSide&) { return from.triangle % 7 != 0; };
        const WalkOptions options{.allow = allow};
        oracle::Random random(2);
        const std::size_t before = allocations();
        WalkPoint place{0, {0.25f, 0.25f, 0.5f}};
        for (int i = 0; i < 200; ++i) {
            const Vec3 step = to_float(random.direction<3>() * (20 * random.unit()));
            const Walked walked = mesh.walk(place, step);
            place = mesh.walk(walked.place, walked.turn * step, options).place;
            const WalkedInTriangle inner = mesh.walk_in_triangle(place, step);
            if (const auto crossing = mesh.cross_edge(inner.end)) place = crossing->place;
        }
        EXPECT_EQ(allocations(), before) << named.name;
    }
}

}  // namespace
}  // namespace abut::test
