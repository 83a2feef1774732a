// No tunnelling: a ball dropped on each triangle, edge and vertex of a mesh comes to rest on it and stays above. This
// holds for meshes with gaps much smaller than the ball, slivers, doubled faces and T-junctions as well.

#include "../oracle/pair.hpp"
#include "levels.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// The drop_tolerance error of a float of this size, with that of the computation of a position.
constexpr double drop_tolerance = 1e-5;

/// Drops a ball from above a position, and again from its rest; returns the number of drops.
template <class S>
int drop(const View<3>& level, const Vec3& place, const S& shape) {
    Vec3 from = place + Vec3(0, 0, 3), motion(0, 0, -12);
    int falls = 0;
    for (int i = 0; i < 3; ++i) {
        const auto hit = sweep(at(shape, Pose3{from}), motion, level);
        EXPECT_TRUE(hit) << "fell through";
        if (!hit) return falls;
        ++falls;
        from += motion * hit->fraction;
        const Closest<3> found = closest(level, at(shape, Pose3{from}));
        EXPECT_NEAR(found.distance, 0, drop_tolerance);
        // The ground must be below.
        EXPECT_GT(hit->normal.z, 0);
        EXPECT_GE(from.z, place.z - drop_tolerance);
        motion = Vec3(0, 0, -0.1f);
    }
    return falls;
}

/// Drops a ball on each triangle, edge and vertex, which are numbered for error messages.
template <class S>
void drop_everywhere(const Surface& surface, const S& shape, int& falls) {
    const Mesh mesh = surface.mesh();
    const View<3> level = view(mesh);
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        const Triangle3 t = mesh.triangle(i);
        for (const Vec3& place : {t.a, t.b, t.c, (t.a + t.b) * 0.5f, (t.b + t.c) * 0.5f, (t.c + t.a) * 0.5f,
                                  (t.a + t.b + t.c) * (1 / 3.0f)}) {
            SCOPED_TRACE("triangle " + std::to_string(i));
            falls += drop(level, place, shape);
            if (testing::Test::HasFailure()) return;
        }
    }
}

Surface ground(oracle::Random& random, int cells) {
    return random_terrain(random, cells, 1).surface();
}

/// Triangles without shared vertices, each slightly shrunk.
Surface torn(const Surface& surface, float gap) {
    Surface result;
    for (const glm::uvec3& t : surface.triangles) {
        const Vec3 a = surface.points[t.x], b = surface.points[t.y], c = surface.points[t.z];
        const Vec3 middle = (a + b + c) * (1 / 3.0f);
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (const Vec3& corner : {a, b, c}) result.points.push_back(corner + (middle - corner) * gap);
        result.triangles.emplace_back(first, first + 1, first + 2);
    }
    return result;
}

/// A mesh with a T-junction on an edge of each triangle, doubled faces of both windings, and triangles of area 0 along
/// edges.
Surface spoiled(const Surface& surface) {
    Surface result;
    result.points = surface.points;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const glm::uvec3 t = surface.triangles[i];
        const auto cut = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back((surface.points[t.x] + surface.points[t.y]) * 0.5f);
        result.triangles.emplace_back(t.x, cut, t.z);
        result.triangles.emplace_back(cut, t.y, t.z);
        result.triangles.emplace_back(t.x, cut, t.y);
        if (i % 3 == 0) result.triangles.push_back(t);
        if (i % 5 == 0) result.triangles.emplace_back(t.z, t.y, t.x);
        if (i % 7 == 0) result.triangles.emplace_back(t.x, t.x, t.y);
    }
    return result;
}

/// A mesh stretched along x until its triangles are a thousand times as long as wide.
Surface slivers(oracle::Random& random, int cells) {
    Surface result = random_terrain(random, cells, 0.001).surface();
    for (Vec3& point : result.points) point.y *= 0.001f;
    return result;
}

const Sphere ball{{0, 0, 0}, 0.25f}, small_ball{{0, 0, 0}, 0.01f};

TEST(Drop, OnATerrain) {
    oracle::Random random(1);
    // With ABUT_LONG in the environment, the mesh has a hundred thousand triangles.
    const Surface surface = ground(random, oracle::case_count(1) > 1 ? 224 : 8);
    int falls = 0;
    drop_everywhere(surface, ball, falls);
    EXPECT_GT(falls, 2000);
}

TEST(Drop, OfOtherShapes) {
    oracle::Random random(2);
    const Surface surface = ground(random, 4);
    int falls = 0;
    drop_everywhere(surface, small_ball, falls);
    drop_everywhere(surface, Capsule<3>{{-0.3f, 0, 0}, {0.3f, 0, 0.1f}, 0.1f}, falls);
    drop_everywhere(surface, Box3{{0, 0, 0}, {0.2f, 0.3f, 0.1f}, random.rotation<3>()}, falls);
    EXPECT_EQ(falls, 3 * 3 * 7 * 32);
}

TEST(Drop, OnATornTerrain) {
    oracle::Random random(3);
    int falls = 0;
    for (const float gap : {1e-6f, 1e-5f, 1e-3f}) drop_everywhere(torn(ground(random, 4), gap), ball, falls);
    EXPECT_EQ(falls, 3 * 3 * 7 * 32);
}

TEST(Drop, OnDoubledFacesAndTJunctions) {
    oracle::Random random(4);
    int falls = 0;
    drop_everywhere(spoiled(ground(random, 4)), ball, falls);
    drop_everywhere(spoiled(torn(ground(random, 4), 1e-6f)), small_ball, falls);
    EXPECT_GT(falls, 4000);
}

TEST(Drop, OnSlivers) {
    oracle::Random random(5);
    int falls = 0;
    drop_everywhere(slivers(random, 5), ball, falls);
    drop_everywhere(slivers(random, 5), small_ball, falls);
    EXPECT_EQ(falls, 2 * 3 * 7 * 50);
}

/// Rotating shapes come to rest as well, and don't fall through.
TEST(Drop, Turning) {
    oracle::Random random(6);
    const Mesh mesh = spoiled(ground(random, 4)).mesh();
    const Box3 box{{0, 0, 0}, {0.2f, 0.3f, 0.1f}};
    int rounds = 0;
    for (int seed = 0; seed < oracle::case_count(60); ++seed) {
        SCOPED_TRACE(seed);
        const Vec3 place(random.uniform_float(0.5, 3.5), random.uniform_float(0.5, 3.5), 0);
        const Pose3 from{place + Vec3(0, 0, 3), random.rotation<3>()}, to{place + Vec3(0, 0, -3), random.rotation<3>()};
        const auto hit = sweep(box, from, to, mesh, Pose3{}, Pose3{});
        ASSERT_TRUE(hit);
        const Pose3 then = pose_at(Motion3::between(from, to), hit->fraction);
        EXPECT_NEAR(closest(at(box, then), mesh).distance, 0, 2 * drop_tolerance);
        EXPECT_GT(then.position.z, 0);
        ++rounds;
    }
    EXPECT_EQ(rounds, oracle::case_count(60));
}

/// Ground with an underside as a SolidBsp: made of its faces, whose cells have T-junctions, or of columns with a slope
/// on top.
TEST(Drop, OnSolids) {
    oracle::Random random(8);
    int falls = 0;
    for (int round = 0; round < 3; ++round) {
        const Terrain terrain = random_terrain(random, 6, 1);
        const Surface faces = terrain.solid(-3), above = terrain.surface();
        std::vector<HalfSpace3> sides;
        std::vector<std::uint32_t> ends;
        for (const glm::uvec3& t : above.triangles) {
            const DVec<3> a(above.points[t.x]), b(above.points[t.y]), c(above.points[t.z]);
            const auto add = [&](const DVec<3>& out, const DVec<3>& on) {
                const DVec<3> normal = normalized(out);
                sides.push_back({to_float(normal), static_cast<float>(dot(normal, on))});
            };
            const DVec<3> up(0, 0, 1);
            add(cross(b - a, c - a), a);
            for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) add(cross(to - from, up), from);
            sides.push_back({{0, 0, -1}, 3});
            ends.push_back(static_cast<std::uint32_t>(sides.size()));
        }
        for (const SolidBsp3& solid :
             {*SolidBsp3::build(faces.points, faces.triangles), *SolidBsp3::from_brushes(sides, ends)})
            for (const glm::uvec3& t : above.triangles) {
                const Vec3 a = above.points[t.x], b = above.points[t.y], c = above.points[t.z];
                for (const Vec3& place :
                     {a, b, c, (a + b) * 0.5f, (b + c) * 0.5f, (c + a) * 0.5f, (a + b + c) * (1 / 3.0f)})
                    for (const Sphere& one : {ball, small_ball}) falls += drop(view(solid), place, one);
                if (HasFailure()) return;
            }
    }
    EXPECT_EQ(falls, 3 * 2 * 72 * 7 * 2 * 3);
}

/// Drops on height fields and chains.
TEST(Drop, OnAHeightFieldAndAChain) {
    oracle::Random random(7);
    const Level<3> field = random_height_field(random);
    int falls = 0;
    for (const LevelPart<3>& part : field.parts) {
        const Convex<3>& t = std::get<Convex<3>>(part.view);
        for (std::size_t i = 0; i < 3; ++i)
            falls += drop(field.shape.view(), (t.own[i] + t.own[(i + 1) % 3]) * 0.5f, ball);
    }
    EXPECT_GT(falls, 50);
    std::vector<Vec2> points;
    for (int i = 0; i < 40; ++i) points.emplace_back(static_cast<float>(i), random.uniform_float(0, 3));
    for (const bool one_sided : {false, true}) {
        const Chain chain =
            *Chain::build(std::vector<Vec2>(points.rbegin(), points.rend()), false, {.one_sided = one_sided});
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            for (const Vec2& place : {points[i], (points[i] + points[i + 1]) * 0.5f}) {
                const Circle above{{place.x, 9}, 0.25f};
                const auto hit = sweep(above, Vec2(0, -12), chain);
                ASSERT_TRUE(hit) << place.x;
                EXPECT_GE(9 - 12 * hit->fraction, place.y);
                EXPECT_NEAR(closest(at(above, Pose2{{0, -12 * hit->fraction}}), chain).distance, 0, drop_tolerance);
            }
    }
}

}  // namespace
}  // namespace abut::test
