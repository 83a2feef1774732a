// Borders, doors and corners: where a walk slides, and where it stops.

#include "../oracle/expect.hpp"
#include "walk_check.hpp"
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

/// The squares of a floor of 4 x 4 without one of them.
WalkMesh without(std::uint32_t hole_column, std::uint32_t hole_row) {
    return built(sheet(
        4, 4, [](std::uint32_t column, std::uint32_t row) { return DVec<3>(column, row, 0); },
        [&](std::uint32_t column, std::uint32_t row) { return column != hole_column || row != hole_row; }));
}

struct Expected {
    Vec3 end;
    double length, lost;
    WalkMet met;
};

void expect(const WalkMesh& mesh, const Walked& walked, const Expected& expected) {
    EXPECT_TRUE(near<3>(mesh.to_world(walked.place), expected.end, 2e-6));
    EXPECT_NEAR(walked.length, expected.length, 1e-5);
    EXPECT_NEAR(walked.lost, expected.lost, 1e-5);
    EXPECT_EQ(walked.met, expected.met);
    EXPECT_EQ(walked.met == WalkMet::nothing, walked.side == WalkSide{});
    EXPECT_TRUE(are_valid_weights(walked.place.weights));
}

Walked walk(const WalkMesh& mesh, const Vec3& from, const Vec3& step, const WalkOptions& options = {}) {
    return mesh.walk(mesh.nearest(from), step, options);
}

TEST(WalkBorder, SlidesAlongAWall) {
    const WalkMesh mesh = built(flat(4, 4));
    // To the wall after 2.5 of 5; then 3/5 of what is left, along it.
    expect(mesh, walk(mesh, {2, 0.5f, 0}, {4, 3, 0}), {{4, 3.5f, 0}, 4, 1, WalkMet::border});
    expect(mesh, walk(mesh, {2, 3.5f, 0}, {4, -3, 0}), {{4, 0.5f, 0}, 4, 1, WalkMet::border});
    expect(mesh, walk(mesh, {2, 0.5f, 0}, {-4, 3, 0}), {{0, 3.5f, 0}, 4, 1, WalkMet::border});
    expect(mesh, walk(mesh, {0.5f, 2, 0}, {3, 4, 0}), {{3.5f, 4, 0}, 4, 1, WalkMet::border});
}

TEST(WalkBorder, TellsTheFirstBorderThatItMet) {
    const WalkMesh mesh = built(flat(4, 4));
    // Side 1 of the first triangle in the square at column 3, row 2 is at x = 4.
    const std::uint32_t first = 2 * (4 * 2 + 3);
    EXPECT_EQ(walk(mesh, {3, 1.75f, 0}, {2, 1.5f, 0}).side, (WalkSide{first, 1}));
    EXPECT_EQ(walk(mesh, {3, 1.75f, 0}, {2, 3.5f, 0}).side, (WalkSide{first + 8, 1})) << "the first, not the last";
}

TEST(WalkBorder, StopsInACorner) {
    const WalkMesh mesh = built(flat(4, 4));
    // 2.5 to the wall, 0.5 along it, and the next wall turns in.
    expect(mesh, walk(mesh, {2, 2, 0}, {4, 3, 0}), {{4, 4, 0}, 3, 2, WalkMet::corner});
    expect(mesh, walk(mesh, {2, 2, 0}, {400, 300, 0}), {{4, 4, 0}, 3, 497, WalkMet::corner});
    // Straight into the corner.
    expect(mesh, walk(mesh, {2, 2, 0}, {3, 3, 0}),
           {{4, 4, 0}, std::sqrt(8.0), std::sqrt(18.0) - std::sqrt(8.0), WalkMet::corner});
    // And away from it.
    for (const std::uint32_t triangle : {30u, 31u}) {
        const WalkPoint corner{triangle, triangle == 30 ? Vec3(0, 0, 1) : Vec3(0, 1, 0)};
        ASSERT_EQ(mesh.to_world(corner), Vec3(4, 4, 0));
        expect(mesh, mesh.walk(corner, Vec3(1, 1, 0)), {{4, 4, 0}, 0, std::sqrt(2.0), WalkMet::corner});
        expect(mesh, mesh.walk(corner, Vec3(-1, -1, 0)), {{3, 3, 0}, std::sqrt(2.0), 0, WalkMet::nothing});
        expect(mesh, mesh.walk(corner, Vec3(-1, -2, 0)), {{3, 2, 0}, std::sqrt(5.0), 0, WalkMet::nothing});
        expect(mesh, mesh.walk(corner, Vec3(-3, 4, 0)), {{1, 4, 0}, 3, 2, WalkMet::border});
        expect(mesh, mesh.walk(corner, Vec3(4, -3, 0)), {{4, 1, 0}, 3, 2, WalkMet::border});
    }
}

TEST(WalkBorder, StopsHeadOn) {
    const WalkMesh mesh = built(flat(4, 4));
    for (const Vec3& start : {Vec3(2, 2, 0), Vec3(2.5f, 1.25f, 0), Vec3(1.1f, 2.7f, 0), Vec3(3, 3.3f, 0)}) {
        expect(mesh, walk(mesh, start, {7, 0, 0}), {{4, start.y, 0}, 4 - start.x, 3 + start.x, WalkMet::corner});
        expect(mesh, walk(mesh, start, {-7, 0, 0}), {{0, start.y, 0}, start.x, 7 - start.x, WalkMet::corner});
        expect(mesh, walk(mesh, start, {0, 7, 0}), {{start.x, 4, 0}, 4 - start.y, 3 + start.y, WalkMet::corner});
        expect(mesh, walk(mesh, start, {0, -7, 0}), {{start.x, 0, 0}, start.y, 7 - start.y, WalkMet::corner});
    }
    // A walker at the wall stays there, and can walk away from it.
    for (const float y : {0.0f, 0.3f, 1.0f, 2.5f}) {
        expect(mesh, walk(mesh, {4, y, 0}, {2, 0, 0}), {{4, y, 0}, 0, 2, WalkMet::corner});
        expect(mesh, walk(mesh, {4, y, 0}, {-2, 0, 0}), {{2, y, 0}, 2, 0, WalkMet::nothing});
    }
}

TEST(WalkBorder, StopsHeadOnWhereThatIsOnlyRounded) {
    // The rim of the hills goes up and down. The step is perpendicular to it, but not exactly in floats.
    oracle::Random random(20261123);
    const scenes::Terrain terrain = scenes::random_terrain(64, random);
    const WalkMesh mesh = *WalkMesh::build(terrain.points, terrain.triangles);
    int stops = 0;
    for (std::uint32_t triangle = 0; triangle < mesh.triangles().size(); ++triangle)
        for (std::uint32_t side = 0; side < 3; ++side) {
            if (mesh.beyond({triangle, side})) continue;
            const glm::uvec3 t = mesh.triangles()[triangle];
            const auto k = static_cast<glm::length_t>(side);
            const Vec3 from = mesh.points()[t[k]], to = mesh.points()[t[(k + 1) % 3]];
            const Vec3 out = from.x == to.x ? Vec3(from.x, 0, 0) : Vec3(0, 0, from.z);
            const Walked walked = mesh.walk({triangle, {0.25f, 0.25f, 0.5f}}, out);
            EXPECT_EQ(walked.met, WalkMet::corner) << triangle;
            EXPECT_EQ(walked.side, (WalkSide{triangle, side}));
            EXPECT_EQ(walked.place.triangle, triangle);
            ++stops;
        }
    EXPECT_EQ(stops, 4 * 64);
}

TEST(WalkBorder, WalksAlongAWallWithoutLosingAnything) {
    const WalkMesh mesh = built(flat(4, 4));
    const auto ends = [&](const Vec3& from, const Vec3& step) {
        const Walked walked = walk(mesh, from, step);
        EXPECT_TRUE(near<3>(mesh.to_world(walked.place), from + step, 2e-6));
        EXPECT_NEAR(walked.length, length(DVec<3>(step)), 1e-5);
        EXPECT_NEAR(walked.lost, 0, 1e-6);
    };
    for (const float at : {0.25f, 0.3f, 1.0f, 1.1f})
        for (const float by : {0.1f, 0.5f, 1.0f, 2.0f, 2.7f}) {
            ends({4, at, 0}, {0, by, 0});
            ends({4, 4 - at, 0}, {0, -by, 0});
            ends({0, at, 0}, {0, by, 0});
            ends({at, 0, 0}, {by, 0, 0});
            ends({4 - at, 4, 0}, {-by, 0, 0});
        }
}

TEST(WalkBorder, StartsToSlideFromWhereItStands) {
    // Out over the wall at the start, at all angles, the smallest too.
    const WalkMesh mesh = built(flat(4, 4));
    for (const float at : {0.3f, 1.0f, 1.55f})
        for (const float out : {1e-12f, 1e-9f, 1e-6f, 1e-3f, 0.5f, 1.0f, 3.0f}) {
            const double requested = std::sqrt(1 + static_cast<double>(out) * static_cast<double>(out));
            const auto slides = [&](const Vec3& from, const Vec3& step, const Vec3& end) {
                const Walked walked = walk(mesh, from, step);
                // A loss by rounding may be reported as zero.
                expect(mesh, walked, {end, 1, requested - 1, out < 1e-6f ? walked.met : WalkMet::border});
            };
            slides({4, at, 0}, {out, 1, 0}, {4, at + 1, 0});
            slides({at, 4, 0}, {1, out, 0}, {at + 1, 4, 0});
            slides({0, 4 - at, 0}, {-out, -1, 0}, {0, 3 - at, 0});
        }
}

TEST(WalkBorder, GoesOnAsItBeganPastACornerThatIsReflex) {
    // The square from (2, 1) to (3, 2) is missing. To (2, 1.75) half of the length, up to (2, 2), then on in the old
    // direction.
    const WalkMesh mesh = without(2, 1);
    const DVec<2> direction = normalized(DVec<2>(2, 1.5));
    const double to_wall = 1.25, left = 2.5 - to_wall, slid = 0.25, used = slid / direction.y, rest = left - used;
    const Vec3 end(static_cast<float>(2 + direction.x * rest), static_cast<float>(2 + direction.y * rest), 0);
    expect(mesh, walk(mesh, {1, 1, 0}, {2, 1.5f, 0}), {end, to_wall + slid + rest, used - slid, WalkMet::border});
    // The mirror image.
    const Vec3 below(static_cast<float>(2 + direction.x * rest), static_cast<float>(1 - direction.y * rest), 0);
    expect(mesh, walk(mesh, {1, 2, 0}, {2, -1.5f, 0}), {below, to_wall + slid + rest, used - slid, WalkMet::border});
}

TEST(WalkBorder, StartsFromACornerThatIsReflex) {
    // The floor spans three quarters around (2, 2). The walk starts from each of its triangles there, in all
    // directions.
    const WalkMesh mesh = without(2, 1);
    int starts = 0;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        for (int k = 0; k < 3; ++k) {
            Vec3 weights(0);
            weights[k] = 1;
            if (mesh.to_world({i, weights}) != Vec3(2, 2, 0)) continue;
            for (int turn = 1; turn < 48; ++turn) {
                // From +x, counter-clockwise, to -y; along these two themselves it may run into a wall's end.
                const DVec<2> direction = scenes::on_circle(turn / 16.0) * 0.75;
                const Walked walked = mesh.walk({i, weights}, to_float(DVec<3>(direction.x, direction.y, 0)));
                const Vec3 end = Vec3(2, 2, 0) + to_float(DVec<3>(direction.x, direction.y, 0));
                EXPECT_TRUE(near<3>(mesh.to_world(walked.place), end, 2e-6)) << i << " " << turn;
                EXPECT_NEAR(walked.length, 0.75, 1e-6);
                EXPECT_NEAR(walked.lost, 0, 1e-6);
                ++starts;
            }
        }
    EXPECT_EQ(starts, 47 * 5);
}

TEST(WalkBorder, SlidesOnWhereAWallTurnsInALittle) {
    // A floor within eight walls: from the right one to the upper right one, and along that by its cosine.
    const Surface floor = fan(std::vector<double>(8, 0.0));
    const WalkMesh mesh = built(floor);
    const DVec<2> corner = scenes::on_circle(0.5), next = scenes::on_circle(1), right = scenes::on_circle(0);
    const DVec<2> first = normalized(corner - right), second = normalized(next - corner);
    const DVec<2> middle = (right + corner) * 0.5, direction = normalized(normalized(middle) + first * 3.0);
    const DVec<2> start = middle - direction * 0.25;
    const double to_corner = length(corner - middle), cosine = dot(direction, first),
                 next_cosine = dot(direction, second);
    ASSERT_GT(next_cosine, 0.1);
    const double requested = 0.9, left = requested - 0.25 - to_corner / cosine, slid = left * next_cosine;
    ASSERT_GT(left, 0.1);
    ASSERT_LT(slid, length(next - corner));
    const DVec<2> end = corner + second * slid;
    const Vec3 from = to_float(DVec<3>(start.x, start.y, 0)),
               step = to_float(DVec<3>(direction.x, direction.y, 0) * requested);
    const double walked = 0.25 + to_corner + slid;
    expect(mesh, walk(mesh, from, step),
           {to_float(DVec<3>(end.x, end.y, 0)), walked, requested - walked, WalkMet::border});
}

TEST(WalkBorder, SlidesRoundTheRimOfATube) {
    // Straight up around the corner: at the rim the whole rest of the length is left.
    const std::uint32_t sides = 16;
    const WalkMesh mesh = built(tube(sides, 3));
    const auto around = [&](std::uint32_t side) { return scenes::on_circle(4.0 * (side % sides) / sides); };
    double round = 0;
    for (std::uint32_t side = 0; side < sides; ++side) round += length(around(side + 1) - around(side));
    const DVec<2> along = normalized(around(1) - around(0)), middle = (around(0) + around(1)) * 0.5;
    const DVec<3> step = DVec<3>(along.x, along.y, 0) * (3 * round) + DVec<3>(0, 0, 5);
    const WalkPoint start = mesh.nearest(to_float(DVec<3>(middle.x, middle.y, 0.3)));
    const Walked walked = mesh.walk(start, to_float(step));
    EXPECT_TRUE(near<3>(mesh.to_world(walked.place), to_float(DVec<3>(middle.x, middle.y, 0.6)), 1e-4));
    EXPECT_EQ(walked.met, WalkMet::border);
    EXPECT_NEAR(walked.length + walked.lost, length(step), 1e-4);
}

TEST(WalkBorder, ADoorThatIsClosedIsABorder) {
    // Only row 1 connects columns 1 and 2.
    const WalkMesh mesh = built(flat(4, 4));
    const auto column = [](std::uint32_t triangle) { return triangle / 2 % 4; };
    const auto row = [](std::uint32_t triangle) { return triangle / 8; };
    int requested = 0;
    const auto allow = [&](const WalkSide& from, const WalkSide& to) {
        ++requested;
        EXPECT_EQ(mesh.beyond(from), to);
        const std::uint32_t a = column(from.triangle), b = column(to.triangle);
        return std::min(a, b) != 1 || std::max(a, b) != 2 || row(from.triangle) == 1;
    };
    const WalkOptions options{.allow = allow};
    expect(mesh, walk(mesh, {1, 2.5f, 0}, {3, 0, 0}, options), {{2, 2.5f, 0}, 1, 2, WalkMet::corner});
    expect(mesh, walk(mesh, {3.5f, 2.5f, 0}, {-3, 0, 0}, options), {{2, 2.5f, 0}, 1.5, 1.5, WalkMet::corner});
    expect(mesh, walk(mesh, {1, 1.5f, 0}, {2.5f, 0, 0}, options), {{3.5f, 1.5f, 0}, 2.5, 0, WalkMet::nothing});
    expect(mesh, walk(mesh, {1, 2.25f, 0}, {4, 3, 0}, options), {{2, 4, 0}, 2.25, 2.75, WalkMet::corner});
    EXPECT_GT(requested, 0);
    // Along it down to the door, and through.
    const double to_wall = 0.5 / 0.8, to_post = (2.5 - 0.6 * to_wall - 2) / 0.6, rest = 1 - to_wall - to_post;
    const Vec3 end(static_cast<float>(2 + 0.8 * rest), static_cast<float>(2 - 0.6 * rest), 0);
    expect(mesh, walk(mesh, {1.5f, 2.5f, 0}, {0.8f, -0.6f, 0}, options),
           {end, 1 - 0.4 * to_post, 0.4 * to_post, WalkMet::border});
}

TEST(WalkBorder, SomeEdgesAreOneWay) {
    const WalkMesh mesh = built(flat(4, 4));
    // Down is allowed, up is not.
    const auto allow = [&](const WalkSide& from, const WalkSide& to) { return to.triangle / 8 <= from.triangle / 8; };
    const WalkOptions options{.allow = allow};
    expect(mesh, walk(mesh, {1.3f, 1.5f, 0}, {0, 2, 0}, options), {{1.3f, 2, 0}, 0.5, 1.5, WalkMet::corner});
    expect(mesh, walk(mesh, {1.3f, 2.5f, 0}, {0, -2, 0}, options), {{1.3f, 0.5f, 0}, 2, 0, WalkMet::nothing});
}

TEST(WalkBorder, RandomDoorsAgreeWithTheOracle) {
    constexpr std::uint64_t seed = 20261124;
    for (const NamedSurface& named : surfaces(seed)) {
        const WalkMesh mesh = built(named.surface);
        // A third of the edges is closed, some in one direction only.
        const auto is_open = [](const WalkSide& from, const WalkSide& to) {
            oracle::Random random(std::uint64_t{from.triangle} << 32 | to.triangle << 2 | from.side);
            return random.chance(0.7);
        };
        WalkCheck check(mesh, named.surface, is_open);
        const WalkOptions options{.allow = is_open};
        oracle::Random random(seed);
        WalkTally tally;
        WalkPoint place;
        for (int i = 0; i < 1500; ++i) {
            if (i % 5 == 0) {
                const float a = random.uniform_float(0, 1), b = random.uniform_float(0, 1);
                place = {random.below(static_cast<std::uint32_t>(mesh.triangles().size())), {a, b, 0.5f}};
            }
            const Vec3 step = to_float(random.direction<3>() * (random.uniform(0, 5) * check.edge()));
            place = check.check<3>(place, step, tally, options).place;
        }
        EXPECT_EQ(tally.faults, 0u) << named.name << ", seed " << seed << ": " << tally.faults_text();
        EXPECT_GT(tally.slid, 300u);
        EXPECT_GT(tally.stopped, 100u);
    }
}

}  // namespace
}  // namespace abut::test
