// The turn of a walk: frames carried around a tip, a saddle, and along a twisted strip.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::near;

constexpr double whole_turn = 6.283185307179586;

/// A walker that carries vectors, in the frame of the triangle and in space.
struct Carrier {
    const WalkMesh& mesh;
    WalkPoint place;
    Vec2 in_plane;
    Vec3 in_space;
    bool mirrored = false;

    void go(const Vec3& step) {
        const Walked walked = mesh.walk(place, step);
        EXPECT_EQ(walked.met, WalkMet::nothing);
        in_plane = walked.turn * in_plane;
        in_space = walked.turn * in_space;
        mirrored = mirrored != walked.turn.mirrored();
        place = walked.place;
    }
    void go_to(const Vec3& point) { go(point - mesh.to_world(place)); }
};

/// The angle by which vectors turn that are carried once around the middle of a fan, counter-clockwise from above.
struct Turned {
    double in_plane = 0, in_space = 0;
};

Turned carried_round(const WalkMesh& mesh, std::uint32_t triangles) {
    const Vec3 middle{0.5f, 0.25f, 0.25f};
    const Vec2 first{0.6f, 0.8f};
    Carrier carrier{mesh, {0, middle}, first, mesh.to_space(0, first)};
    for (std::uint32_t i = 1; i <= triangles; ++i) {
        // A little over the side between the two, then to the middle of the next.
        carrier.go((mesh.to_world({i - 1, {0.5f, 0, 0.5f}}) - mesh.to_world(carrier.place)) * 1.01f);
        carrier.go_to(mesh.to_world({i % triangles, middle}));
        EXPECT_EQ(carrier.place.triangle, i % triangles);
    }
    const auto angle = [&](const DVec<2>& to) {
        return std::atan2(cross(DVec<2>(first), to), dot(DVec<2>(first), to));
    };
    return {angle(DVec<2>(carrier.in_plane)), angle(DVec<2>(mesh.to_plane(0, carrier.in_space)))};
}

/// A mesh of the triangles at point 0.
double angle_round(const Surface& surface) {
    double sum = 0;
    for (const glm::uvec3& t : surface.triangles) {
        const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
        sum += std::acos(dot(normalized(b - a), normalized(c - a)));
    }
    return sum;
}

TEST(WalkTurn, RoundATipItTurnsByWhatIsMissing) {
    for (const double depth : {0.1, 0.5, 1.0, 3.0}) {
        const Surface cone = fan(std::vector<double>(9, -depth));
        const Turned turned = carried_round(*WalkMesh::build(cone.points, cone.triangles), 9);
        const double missing = whole_turn - angle_round(cone);
        ASSERT_GT(missing, 0.01);
        EXPECT_NEAR(std::remainder(turned.in_plane - missing, whole_turn), 0, 1e-5) << depth;
        EXPECT_NEAR(std::remainder(turned.in_space - missing, whole_turn), 0, 1e-5) << depth;
    }
}

TEST(WalkTurn, AroundASaddleItTurnsInReverse) {
    const Surface saddle = fan({0.5, -0.5, 0.5, -0.5, 0.5, -0.5, 0.5, -0.5});
    const Turned turned = carried_round(*WalkMesh::build(saddle.points, saddle.triangles), 8);
    const double excess = angle_round(saddle) - whole_turn;
    ASSERT_GT(excess, 0.1);
    EXPECT_NEAR(std::remainder(turned.in_plane + excess, whole_turn), 0, 1e-5);
    EXPECT_NEAR(std::remainder(turned.in_space + excess, whole_turn), 0, 1e-5);
}

TEST(WalkTurn, OnAFloorItTurnsNothing) {
    const Surface floor = fan(std::vector<double>(6, 0.0));
    const Turned turned = carried_round(*WalkMesh::build(floor.points, floor.triangles), 6);
    EXPECT_NEAR(turned.in_plane, 0, 1e-6);
    EXPECT_NEAR(turned.in_space, 0, 1e-6);
}

TEST(WalkTurn, OnceRoundAMoebiusStripIsMirrored) {
    constexpr std::uint32_t columns = 24, rows = 3;
    for (const std::uint32_t half_turns : {1u, 2u, 3u}) {
        const Surface strip = twisted_strip(columns, rows, half_turns);
        const WalkMesh mesh = *WalkMesh::build(strip.points, strip.triangles);
        // The diagonal of the middle row's square is its middle.
        const auto middle = [&](std::uint32_t column) {
            return mesh.to_world({2 * (columns + column % columns), {0.5f, 0, 0.5f}});
        };
        const WalkPoint start = mesh.nearest(middle(0));
        const Vec3 up = mesh.normal(start);
        Carrier carrier{mesh, start, {1, 0}, up};
        for (std::uint32_t round = 1; round <= 2; ++round) {
            for (std::uint32_t column = 1; column <= columns; ++column) {
                for (int i = 0; i < 3; ++i) carrier.go_to(middle(column));
                EXPECT_TRUE(near<3>(mesh.to_world(carrier.place), middle(column), 1e-3));
                const Vec3 here = mesh.normal(carrier.place);
                EXPECT_TRUE(near<3>(carrier.in_space, carrier.mirrored ? -here : here, 1e-4));
            }
            const bool is_turned = half_turns % 2 == 1 && round == 1;
            EXPECT_EQ(carrier.mirrored, is_turned) << half_turns << " " << round;
            if (carrier.place.triangle == start.triangle) {
                EXPECT_TRUE(near<3>(carrier.in_space, is_turned ? -up : up, 1e-3));
            }
        }
    }
}

TEST(WalkTurn, IsARotationOfSpace) {
    // The quaternion rotates as the turn does, by pi about any axis as well.
    constexpr std::uint64_t seed = 20261123;
    oracle::Random random(seed);
    int half_turns = 0;
    for (const NamedSurface& named : surfaces(seed)) {
        const WalkMesh mesh = *WalkMesh::build(named.surface.points, named.surface.triangles);
        const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
        for (int i = 0; i < 400; ++i) {
            const WalkPoint place{random.below(count), {0.5f, 0.25f, 0.25f}};
            Vec3 step = to_float(random.direction<3>() * (edge_of(named.surface) * random.uniform(0, 20)));
            if (i % 4 == 0) step = mesh.to_space(place.triangle, {static_cast<float>(i), 0});
            const WalkTurn turn = mesh.walk(place, step).turn;
            const glm::quat in_space = turn.in_space();
            half_turns += std::abs(in_space.w) < 1e-3f;
            EXPECT_NEAR(length(in_space), 1, 1e-6);
            for (const Vec3& vector : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, -2, 3)})
                EXPECT_TRUE(near<3>(turn * vector, rotate(in_space, vector), 3e-6))
                    << named.name << ", seed " << seed << ", item " << i;
        }
    }
    EXPECT_GT(half_turns, 50);
}

TEST(WalkTurn, AZeroStepDoesNotRotate) {
    const Surface floor = flat(2, 2);
    const WalkMesh mesh = *WalkMesh::build(floor.points, floor.triangles);
    const WalkTurn turn = mesh.walk({0, {0.5f, 0.25f, 0.25f}}, Vec3(0)).turn;
    EXPECT_EQ(turn * Vec3(1, 2, 3), Vec3(1, 2, 3));
    EXPECT_EQ(turn * Vec2(1, 2), Vec2(1, 2));
    EXPECT_EQ(turn.in_space(), glm::quat(1, 0, 0, 0));
    EXPECT_EQ(turn.in_plane(), Turn{});
    EXPECT_FALSE(turn.mirrored());
    EXPECT_EQ(WalkTurn{} * Vec3(1, 2, 3), Vec3(1, 2, 3));
    EXPECT_EQ(WalkTurn{}.in_space(), glm::quat(1, 0, 0, 0));
}

}  // namespace
}  // namespace abut::test
