// The two lower-level steps: walking within a triangle, and crossing an edge. A walk consists of them.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include "walk_check.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::near;

constexpr std::uint64_t walk_lessons_seed = 20261123;

/// Two triangles with a diagonal from (0, 0) to (1, 1), the second upright on the first where `is_folded`.
WalkMesh two(bool is_folded) {
    const Vec3 last = is_folded ? Vec3(0.5f, 0.5f, std::sqrt(0.5f)) : Vec3(0, 1, 0);
    return built({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, last}, {{0, 1, 2}, {0, 2, 3}}});
}

TEST(WalkInTriangle, EndsWithinWhereTheStepDoes) {
    const WalkedInTriangle walked = two(false).walk_in_triangle({0, {0.25f, 0.5f, 0.25f}}, Vec3(0.125f, 0.25f, 9));
    EXPECT_EQ(walked.fraction, 1);
    EXPECT_EQ(walked.side, no_walk_side);
    EXPECT_EQ(walked.end, (WalkPoint{0, {0.125f, 0.375f, 0.5f}}));
}

TEST(WalkInTriangle, StopsAtASide) {
    const WalkMesh mesh = two(false);
    // From (0.75, 0.25): to the diagonal after half of the step, to the border at x = 1 after a quarter.
    const WalkedInTriangle inner = mesh.walk_in_triangle({0, {0.25f, 0.5f, 0.25f}}, Vec3(-0.5f, 0.5f, 0));
    EXPECT_FLOAT_EQ(inner.fraction, 0.5f);
    EXPECT_EQ(inner.side, 2u);
    EXPECT_EQ(inner.end, (WalkPoint{0, {0.5f, 0, 0.5f}}));
    const WalkedInTriangle border = mesh.walk_in_triangle({0, {0.25f, 0.5f, 0.25f}}, Vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(border.fraction, 0.25f);
    EXPECT_EQ(border.side, 1u);
    EXPECT_EQ(border.end, (WalkPoint{0, {0, 0.75f, 0.25f}}));
    // Both doors.
    EXPECT_EQ(mesh.walk_in_triangle({0, {0.25f, 0.5f, 0.25f}}, Vec2(1, 0)).end, border.end);
}

TEST(WalkInTriangle, StaysOnTheSideThatItWouldLeaveAtOnce) {
    const WalkMesh mesh = two(false);
    const WalkedInTriangle out = mesh.walk_in_triangle({0, {0.5f, 0, 0.5f}}, Vec3(-0.25f, 0.25f, 0));
    EXPECT_EQ(out.fraction, 0);
    EXPECT_EQ(out.side, 2u);
    EXPECT_EQ(out.end, (WalkPoint{0, {0.5f, 0, 0.5f}}));
    const WalkedInTriangle in = mesh.walk_in_triangle({0, {0.5f, 0, 0.5f}}, Vec3(0.25f, -0.25f, 0));
    EXPECT_EQ(in.fraction, 1);
    EXPECT_EQ(in.end, (WalkPoint{0, {0.25f, 0.5f, 0.25f}}));
    const WalkedInTriangle along = mesh.walk_in_triangle({0, {0.5f, 0, 0.5f}}, Vec3(0.25f, 0.25f, 0));
    EXPECT_EQ(along.fraction, 1);
    EXPECT_EQ(along.end, (WalkPoint{0, {0.25f, 0, 0.75f}}));
}

TEST(CrossEdge, TurnsAboutTheEdge) {
    const WalkMesh mesh = two(true);
    const std::optional<EdgeCrossing> crossing = mesh.cross_edge({0, {0.5f, 0, 0.5f}});
    ASSERT_TRUE(crossing);
    EXPECT_EQ(crossing->place, (WalkPoint{1, {0.5f, 0.5f, 0}}));
    EXPECT_TRUE(near<3>(crossing->rotation * Vec3(1, 1, 0), {1, 1, 0}));
    EXPECT_TRUE(near<3>(crossing->rotation * Vec3(-1, 1, 0), {0, 0, std::sqrt(2.0f)})) << "what led to it leads up";
    EXPECT_TRUE(near<3>(crossing->rotation * mesh.normal({0, {1, 0, 0}}), mesh.normal({1, {1, 0, 0}})));
    // And back.
    const std::optional<EdgeCrossing> back = mesh.cross_edge(crossing->place);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->place, (WalkPoint{0, {0.5f, 0, 0.5f}}));
    EXPECT_TRUE(near<3>(back->rotation * (crossing->rotation * Vec3(1, 2, 3)), {1, 2, 3}));
}

TEST(CrossEdge, GoesNowhereAtABorderAndWithin) {
    const WalkMesh mesh = two(false);
    EXPECT_FALSE(mesh.cross_edge({0, {0.25f, 0.5f, 0.25f}})) << "within";
    EXPECT_FALSE(mesh.cross_edge({0, {0, 0.5f, 0.5f}}));
    EXPECT_FALSE(mesh.cross_edge({0, {0.5f, 0.5f, 0}}));
    EXPECT_FALSE(mesh.cross_edge({0, {0, 1, 0}})) << "two borders";
    EXPECT_FALSE(mesh.cross_edge({0, {0, 0.5f, 0.5f}}, 1));
}

TEST(CrossEdge, AtACornerTakesTheSideWithATriangleBeyond) {
    const WalkMesh mesh = two(false);
    const std::optional<EdgeCrossing> start = mesh.cross_edge({0, {1, 0, 0}}), end = mesh.cross_edge({0, {0, 0, 1}});
    ASSERT_TRUE(start && end);
    EXPECT_EQ(start->place, (WalkPoint{1, {1, 0, 0}}));
    EXPECT_EQ(end->place, (WalkPoint{1, {0, 1, 0}}));
    EXPECT_FALSE(mesh.cross_edge({0, {1, 0, 0}}, 0)) << "a border, given by its index";

    // In the middle of a fan, corner 0 of each triangle has neighbours across both sides: the one across side 0 is
    // taken.
    const WalkMesh fan_mesh = built(fan(std::vector<double>(6, 0.0)));
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(fan_mesh.cross_edge({i, {1, 0, 0}})->place, (WalkPoint{(i + 5) % 6, {1, 0, 0}}));
        EXPECT_EQ(fan_mesh.cross_edge({i, {1, 0, 0}}, 2)->place, (WalkPoint{(i + 1) % 6, {1, 0, 0}}));
    }
}

TEST(CrossEdge, IsTheSamePointAndTurnsNormalsToNormals) {
    oracle::Random random(walk_lessons_seed);
    for (const NamedSurface& named : surfaces(walk_lessons_seed)) {
        const WalkMesh mesh = built(named.surface);
        for (int i = 0; i < 300; ++i) {
            const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangles().size()));
            const auto k = static_cast<glm::length_t>(random.below(3));
            WalkPoint place{triangle, Vec3(0)};
            place.weights[k] = 0.375f;
            place.weights[(k + 1) % 3] = 0.625f;
            const std::optional<EdgeCrossing> crossing = mesh.cross_edge(place);
            EXPECT_EQ(crossing.has_value(), mesh.beyond({triangle, static_cast<std::uint32_t>(k)}).has_value());
            if (!crossing) continue;
            EXPECT_TRUE(near<3>(mesh.to_world(crossing->place), mesh.to_world(place), 1e-6 * size_of(named.surface)));
            const Vec3 up = mesh.normal(crossing->place), turned = crossing->rotation * mesh.normal(place);
            EXPECT_TRUE(near<3>(turned, crossing->rotation.mirrored() ? -up : up, 2e-6)) << named.name;
            const Vec2 vector(0.6f, -0.8f);
            EXPECT_TRUE(near<3>(crossing->rotation * mesh.to_space(triangle, vector),
                                mesh.to_space(crossing->place.triangle, crossing->rotation * vector), 2e-6));
            EXPECT_EQ(mesh.cross_edge(crossing->place)->place, place);
        }
    }
}

/// A walk that consists of the two steps.
struct Loop {
    WalkPoint place;
    double length = 0;
    int rounds = 0;
    bool at_border = false;
};

Loop walk_by_hand(const WalkMesh& mesh, const WalkPoint& start, Vec3 step) {
    Loop loop{start};
    for (; loop.rounds < 10'000; ++loop.rounds) {
        const WalkedInTriangle walked = mesh.walk_in_triangle(loop.place, step);
        loop.place = walked.end;
        const Vec2 in_plane = mesh.to_plane(walked.end.triangle, step);
        loop.length += static_cast<double>(walked.fraction) * length(DVec<2>(in_plane));
        if (walked.side == no_walk_side) return loop;
        const std::optional<EdgeCrossing> crossing = mesh.cross_edge(loop.place, walked.side);
        if (!crossing) {
            loop.at_border = true;
            return loop;
        }
        loop.place = crossing->place;
        step = crossing->rotation * (step * (1 - walked.fraction));
    }
    return loop;
}

TEST(WalkLessons, ALoopOfTheTwoIsAWalk) {
    for (const NamedSurface& named : surfaces(walk_lessons_seed)) {
        const WalkMesh mesh = built(named.surface);
        const double edge = edge_of(named.surface), size = size_of(named.surface);
        const oracle::TriangleAdjacency triangles(mesh);
        // Positions are floats, so a path may pass a corner this near on its other side.
        oracle::Geodesic<long double> geodesic(triangles, static_cast<long double>(3e-5 * size));
        oracle::Random random(walk_lessons_seed);
        int same = 0, borders = 0;
        for (int i = 0; i < 600; ++i) {
            const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangles().size()));
            const float a = random.uniform_float(0.1, 1), b = random.uniform_float(0.1, 1);
            const WalkPoint start{triangle, {a, b, 0.5f}};
            const DVec<3> direction = random.direction<3>();
            const Vec3 step = to_float(direction * (edge * random.uniform(0, 12)));
            const Loop loop = walk_by_hand(mesh, start, step);
            EXPECT_LT(loop.rounds, 1000) << named.name << ", walk_lessons_seed " << walk_lessons_seed << ", item " << i;
            EXPECT_TRUE(are_valid_weights(loop.place.weights));
            const auto ends = geodesic.walk(start, step);
            if (ends.size() != 1 || ends[0].near_corner) continue;
            const Walked walked = mesh.walk(start, step);
            EXPECT_EQ(loop.at_border, walked.met != WalkMet::nothing)
                << named.name << ", walk_lessons_seed " << walk_lessons_seed << ", " << i;
            borders += loop.at_border;
            if (loop.at_border) continue;
            ++same;
            EXPECT_TRUE(near<3>(mesh.to_world(loop.place), mesh.to_world(walked.place), 1e-5 * size))
                << named.name << ", walk_lessons_seed " << walk_lessons_seed << ", item " << i;
            EXPECT_NEAR(loop.length, walked.length, 1e-5 * size);
        }
        EXPECT_GT(same, 5) << named.name;
        EXPECT_EQ(borders > 0, mesh.report().border > 0) << named.name;
    }
}

TEST(WalkLessons, ALoopOfTheTwoNeverRunsForEver) {
    // Exactly along edges and through corners, from corners, in every triangle.
    for (const NamedSurface& named : surfaces(walk_lessons_seed)) {
        const WalkMesh mesh = built(named.surface);
        oracle::Random random(walk_lessons_seed);
        for (std::uint32_t triangle = 0; triangle < mesh.triangles().size(); ++triangle) {
            if (!mesh.is_walkable(triangle)) continue;
            const glm::uvec3 t = mesh.triangles()[triangle];
            const auto k = static_cast<glm::length_t>(random.below(3));
            const Vec3 along = mesh.points()[t[(k + 1) % 3]] - mesh.points()[t[k]];
            WalkPoint corner{triangle, Vec3(0)}, side{triangle, Vec3(0)};
            corner.weights[k] = 1;
            side.weights[k] = side.weights[(k + 1) % 3] = 0.5f;
            for (const WalkPoint& start : {corner, side})
                for (const float far : {1.0f, -1.0f, 7.5f, -7.5f}) {
                    const Loop loop = walk_by_hand(mesh, start, along * far);
                    EXPECT_LT(loop.rounds, 2000) << named.name << ", triangle " << triangle << ", corner " << k;
                }
        }
    }
}

}  // namespace
}  // namespace abut::test
