// Raycasts at meshes against an exact test of all triangles. Closed meshes are watertight for rays: at edges, vertices,
// slivers and doubled faces, with every SIMD target.

#include "../../../scenes/bumpy_ball.hpp"
#include "../../oracle/random.hpp"
#include "../../oracle/simd_targets.hpp"
#include "../../shape/meshes.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

// Double-double arithmetic (Dekker, Knuth).
struct Long {
    double high = 0, low = 0;
};
Long sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
}
Long operator+(const Long& a, const Long& b) {
    const Long s = sum(a.high, b.high);
    return sum(s.high, s.low + (a.low + b.low));
}
Long product(double a, double b) {
    const auto halves = [](double x) {
        const double scaled = 0x1.0000002p27 * x, high = scaled - (scaled - x);
        return Long{high, x - high};
    };
    const Long p = halves(a), q = halves(b);
    const double rounded = a * b;
    return {rounded, ((p.high * q.high - rounded) + p.high * q.low + p.low * q.high) + p.low * q.low};
}
Long operator*(const Long& a, const Long& b) {
    const Long p = product(a.high, b.high);
    return sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
Long operator-(const Long& a) {
    return {-a.high, -a.low};
}
Long operator-(const Long& a, const Long& b) {
    return a + -b;
}
double value(const Long& a) {
    return a.high + a.low;
}

struct LongVec {
    Long x, y, z;
};
LongVec difference(const Vec3& a, const Vec3& b) {
    const auto minus = [](float p, float q) { return sum(static_cast<double>(p), -static_cast<double>(q)); };
    return {minus(a.x, b.x), minus(a.y, b.y), minus(a.z, b.z)};
}
LongVec cross(const LongVec& a, const LongVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Long dot(const LongVec& a, const LongVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
double length(const LongVec& a) {
    return std::sqrt(value(dot(a, a)));
}

/// A line and a triangle, in numbers with thirty correct digits.
struct LineAndTriangle {
    double inside = -1;  ///< distance to the nearest edge's plane, in sizes of the triangle; negative outside
    double along = 0;    ///< in lengths of the direction
    double slope = 0;    ///< sine of the angle between the two
};
LineAndTriangle exactly(const Ray3& ray, const Triangle3& t) {
    const LongVec direction = difference(ray.direction, Vec3(0));
    const LongVec a = difference(t.a, ray.origin), b = difference(t.b, ray.origin), c = difference(t.c, ray.origin);
    const LongVec ab = difference(t.b, t.a), ac = difference(t.c, t.a), bc = difference(t.c, t.b);
    const LongVec normal = cross(ab, ac);
    const double area = length(normal), of_direction = length(direction);
    const double size = std::max({length(ab), length(ac), length(bc)});
    LineAndTriangle result;
    if (!(area > 0)) return result;
    const double whole = value(dot(normal, direction)), sign = whole < 0 ? -1 : 1;
    result.slope = std::abs(whole) / (area * of_direction);
    if (whole == 0) return result;
    // The barycentric coordinates are volumes of direction and edge; their sum is the whole volume.
    const double at_a = sign * value(dot(direction, cross(b, c))), at_b = sign * value(dot(direction, cross(c, a))),
                 at_c = sign * value(dot(direction, cross(a, b)));
    result.inside = std::min({at_a, at_b, at_c}) / (size * size * of_direction);
    result.along = value(dot(normal, a)) / whole;
    return result;
}

struct Counts {
    int rays = 0, hits = 0, undecided = 0;
};

/// The first hit over all triangles; skipped if the test of a triangle within reach is undecided.
void check_ray(const Mesh& mesh, const Ray3& ray, const QueryOptions<3>& options, Counts& counts) {
    constexpr double tolerance = 1e-9;
    double min_distance = std::numeric_limits<double>::infinity();
    std::uint32_t first = 0;
    bool undecided = false;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        const Triangle3 t = mesh.triangle(i);
        const LineAndTriangle exact = exactly(ray, t);
        if (!options.back_faces &&
            value(dot(cross(difference(t.b, t.a), difference(t.c, t.a)), difference(ray.direction, Vec3(0)))) >= 0)
            continue;
        if (exact.inside < -tolerance) continue;
        if (exact.inside < tolerance || exact.slope < 1e-5 || std::abs(exact.along) < 1e-4) undecided = true;
        if (exact.along <= 0 || exact.along > static_cast<double>(ray.length)) continue;
        if (exact.along < min_distance) {
            min_distance = exact.along;
            first = i;
        }
    }
    ++counts.rays;
    counts.undecided += undecided ? 1 : 0;
    if (undecided) return;
    const auto hit = raycast(ray, mesh, options);
    const bool expected = min_distance < std::numeric_limits<double>::infinity();
    ASSERT_EQ(hit.has_value(), expected) << first << " at " << min_distance;
    if (!hit) return;
    ++counts.hits;
    EXPECT_EQ(hit->feature.part, first) << "at " << min_distance << ", hit " << hit->distance;
    EXPECT_NEAR(static_cast<double>(hit->distance), min_distance, 1e-6 * (1 + min_distance));
    EXPECT_LT(dot(hit->normal, ray.direction), 0);
    EXPECT_EQ(hit->feature.kind, FeatureKind::face);
}

Surface bumpy_ball(oracle::Random& random, std::uint32_t rows, double roughness) {
    const scenes::BumpyBall ball = scenes::bumpy_ball(rows, 0, roughness, random);
    return {ball.points, ball.triangles};
}

/// Splits each triangle in three at a point close to one of its edges, or on it within rounding.
Surface with_slivers(oracle::Random& random, const Surface& from) {
    Surface result{from.points, {}};
    for (const glm::uvec3& t : from.triangles) {
        const auto corner = [&](int i) { return DVec<3>(from.points[t[i % 3]]); };
        const int edge = static_cast<int>(random.below(3));
        const double part = random.uniform(0.2, 0.8),
                     inwards = random.below(2) == 0 ? 0.0 : random.power_of_two(-30, -8);
        const DVec<3> on_edge = corner(edge) * (1 - part) + corner(edge + 1) * part;
        const auto middle = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(to_float(on_edge * (1 - inwards) + corner(edge + 2) * inwards));
        result.triangles.emplace_back(t[0], t[1], middle);
        result.triangles.emplace_back(t[1], t[2], middle);
        result.triangles.emplace_back(t[2], t[0], middle);
    }
    return result;
}

Surface doubled(const Surface& from) {
    Surface result = from;
    result.triangles.insert(result.triangles.end(), from.triangles.begin(), from.triangles.end());
    return result;
}

class RaycastMesh : public oracle::BySimdTarget {};

TEST_P(RaycastMesh, AgreesWithAllTrianglesDecidedExactly) {
    oracle::Random random(11);
    Counts counts;
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const double size = random.power_of_two(-10, 12);
        Surface surface = i % 3 == 0 ? random_soup(random, 150, 1, 0.7) : bumpy_ball(random, 7, 0.3);
        if (i % 3 == 2) surface = with_slivers(random, surface);
        const Vec3 middle = to_float(random.in_cube<3>() * (size * random.power_of_two(-4, 4)));
        for (Vec3& point : surface.points) point = middle + point * static_cast<float>(size);
        const Mesh mesh = surface.mesh();
        for (int k = 0; k < 60; ++k) {
            const double far = k % 4 == 0 ? 300.0 : 3.0;
            const Vec3 from = middle + to_float(random.in_cube<3>() * (size * far)),
                       to = middle + to_float(random.in_cube<3>() * size);
            Ray3 ray = Ray3::between(from, to);
            ray.length =
                k % 5 == 0 ? std::numeric_limits<float>::infinity() : ray.length * random.uniform_float(0.5, 2);
            check_ray(mesh, ray, {.back_faces = k % 3 != 0}, counts);
        }
    }
    EXPECT_GT(counts.hits, counts.rays / 4);
    EXPECT_GT(counts.rays - counts.hits - counts.undecided, counts.rays / 8);
    EXPECT_LT(counts.undecided, counts.rays / 10);
}

/// Rays from the center, and from far outside through the center, aimed at vertices, edges and random points.
void expect_no_gap(oracle::Random& random, const Surface& surface, const Vec3& middle, float far) {
    const Mesh mesh = surface.mesh();
    for (int i = 0; i < 1500; ++i) {
        const glm::uvec3& t = surface.triangles[random.below(static_cast<std::uint32_t>(surface.triangles.size()))];
        const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]);
        const double part = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.5 : random.uniform(0, 1);
        Vec3 aim = to_float(a * (1 - part) + b * part);
        if (i % 10 == 0) aim = middle + to_float(random.direction<3>() * 8.0);
        const Ray3 out{middle, to_float(unit(DVec<3>(aim) - DVec<3>(middle)))};
        ASSERT_TRUE(raycast(out, mesh)) << "from inside, " << i;
        // The ray goes to a vertex or an edge first, and then on through the center.
        const Vec3 from = to_float(DVec<3>(middle) + (DVec<3>(aim) - DVec<3>(middle)) * static_cast<double>(far));
        const auto in = raycast(Ray3::between(from, middle), mesh);
        ASSERT_TRUE(in) << "from outside, " << i;
        ASSERT_TRUE(raycast(Ray3::between(from, middle), mesh, {.back_faces = false})) << "its front, " << i;
    }
}

TEST_P(RaycastMesh, ThatIsClosedLetsNothingThrough) {
    oracle::Random random(12);
    for (const double bumps : {0.0, 0.1}) {
        const Surface ball = bumpy_ball(random, 12, bumps), slivers = with_slivers(random, ball);
        ASSERT_TRUE(slivers.mesh().closed());
        expect_no_gap(random, ball, {0, 0, 0}, 3);
        expect_no_gap(random, slivers, {0, 0, 0}, 3);
        expect_no_gap(random, doubled(slivers), {0.1f, 0.2f, -0.1f}, 1000);
    }
    // Many rays lie in the planes of its faces.
    const Surface cells = cell_surface(4, [](int x, int y, int z) { return x + y + z < 6; });
    expect_no_gap(random, cells, {1, 1, 1}, 3);
    expect_no_gap(random, cells, {1.5f, 1, 1}, 7);
    expect_no_gap(random, box_surface({-1, -1, -1}, {1, 1, 1}), {0, 0, 0}, 2);
}

TEST_P(RaycastMesh, HasTheSameBitsOnEveryUnitAndReportsTheLowestOfDoubledFaces) {
    oracle::Random random(13);
    const Surface surface = bumpy_ball(random, 10, 0.2);
    const auto count = static_cast<std::uint32_t>(surface.triangles.size());
    const Mesh once = surface.mesh(), twice = doubled(surface).mesh();
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&](float number) { hash = (hash ^ std::bit_cast<std::uint32_t>(number)) * 1099511628211u; };
    for (int i = 0; i < 2000; ++i) {
        // The numbers are drawn in statements of their own, because compilers evaluate arguments in any order.
        const Vec3 to = to_float(random.in_cube<3>());
        const Ray3 ray = Ray3::between(to_float(random.in_cube<3>() * 2.0), to);
        const auto hit = raycast(ray, once), of_two = raycast(ray, twice);
        ASSERT_EQ(hit.has_value(), of_two.has_value());
        if (!hit) continue;
        EXPECT_EQ(hit->feature, of_two->feature);
        EXPECT_LT(of_two->feature.part, count);
        EXPECT_EQ(hit->distance, of_two->distance);
        for (const float number : {hit->distance, hit->point.x, hit->point.y, hit->point.z, hit->normal.x,
                                   hit->normal.y, hit->normal.z, static_cast<float>(hit->feature.part)})
            add(number);
    }
    EXPECT_EQ(hash, 2036981826751323530u);
}

INSTANTIATE_TEST_SUITE_P(Targets, RaycastMesh, oracle::simd_targets(), oracle::simd_target_name);

TEST(RaycastMeshByHand, CountsBackFacesOnRequest) {
    const Mesh cube = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    const Ray3 through{{-1, 0.25f, 0.5f}, {1, 0, 0}, 10}, inside{{0.5f, 0.25f, 0.5f}, {1, 0, 0}, 10};
    EXPECT_EQ(raycast(through, cube)->distance, 1);
    EXPECT_EQ(raycast(through, cube, {.back_faces = false})->distance, 1);
    EXPECT_EQ(raycast(inside, cube)->distance, 0.5f);
    EXPECT_EQ(raycast(inside, cube)->feature.index, 1u);
    EXPECT_FALSE(raycast(inside, cube, {.back_faces = false}));
    // A reflection reverses the winding, but does not turn the mesh inside out.
    const auto mirrored = stretched(cube, {-1, 1, 1});
    EXPECT_EQ(raycast({{-2, 0.25f, 0.5f}, {1, 0, 0}, 10}, mirrored, {.back_faces = false})->distance, 1);
    EXPECT_FALSE(raycast({{-0.5f, 0.25f, 0.5f}, {1, 0, 0}, 10}, mirrored, {.back_faces = false}));
}

TEST(RaycastMeshByHand, ReportsAllHitsInOrder) {
    const Mesh cube = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    std::vector<Hit<3>> hits;
    raycast_all({{-1, 0.25f, 0.5f}, {1, 0, 0}, 10}, cube, hits);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_EQ(hits[0].distance, 1);
    EXPECT_EQ(hits[1].distance, 2);
    EXPECT_FLOAT_EQ(hits[1].fraction, 0.2f);
    EXPECT_EQ(hits[1].normal, Vec3(-1, 0, 0));
    raycast_all({{-1, 0.25f, 0.5f}, {1, 0, 0}, 10}, cube, hits, {.back_faces = false});
    EXPECT_EQ(hits.size(), 1u);
    raycast_all({{-1, 0.5f, 0.5f}, {1, 0, 0}, 1.5f}, cube, hits);
    ASSERT_EQ(hits.size(), 2u) << "both triangles of the edge that it hits";
    EXPECT_EQ(hits[0].distance, hits[1].distance);
    EXPECT_LT(hits[0].feature.part, hits[1].feature.part);
    raycast_all({{-1, 3, 0}, {1, 0, 0}, 10}, cube, hits);
    EXPECT_TRUE(hits.empty());
    // A convex shape or a half-space is one part.
    raycast_all({{-3, 0, 0}, {1, 0, 0}, 10}, Sphere{{0, 0, 0}, 1}, hits);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].distance, 2);
    raycast_all({{-3, 0, 0}, {1, 0, 0}, 10}, HalfSpace3{{-1, 0, 0}, 1}, hits);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].distance, 2);
    std::vector<Hit<2>> flat;
    raycast_all({{-3, 0}, {1, 0}, 10}, Circle{{0, 0}, 1}, flat);
    ASSERT_EQ(flat.size(), 1u);
    EXPECT_EQ(flat[0].distance, 2);
}

TEST(RaycastMeshByHand, ReportsEachHitUntilItIsStopped) {
    oracle::Random random(14);
    const Mesh mesh = random_soup(random, 400, 1, 1).mesh();
    int stopped = 0;
    for (int i = 0; i < 100; ++i) {
        const Ray3 ray = Ray3::between(to_float(random.in_cube<3>() * 2.0), to_float(random.in_cube<3>()));
        std::vector<Hit<3>> hits;
        raycast_all(ray, mesh, hits);
        for (std::size_t k = 1; k < hits.size(); ++k) EXPECT_LE(hits[k - 1].distance, hits[k].distance);
        std::size_t alone = 0;
        for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
            const auto hit = raycast(ray, mesh.triangle(t));
            if (!hit) continue;
            ++alone;
            const auto same = std::find_if(hits.begin(), hits.end(),
                                           [t](const Hit<3>& candidate) { return candidate.feature.part == t; });
            ASSERT_NE(same, hits.end()) << t;
            EXPECT_EQ(same->distance, hit->distance);
        }
        EXPECT_EQ(hits.size(), alone);
        const auto first = raycast(ray, mesh);
        ASSERT_EQ(first.has_value(), !hits.empty());
        if (!first) continue;
        EXPECT_EQ(first->feature, hits[0].feature);
        std::size_t visits = 0;
        each_hit(ray, mesh, [&](const Hit<3>&) { return ++visits < 2; });
        EXPECT_EQ(visits, std::min<std::size_t>(hits.size(), 2));
        stopped += visits < hits.size() ? 1 : 0;
        float nearest = std::numeric_limits<float>::infinity();
        each_hit(ray, mesh, [&](const Hit<3>& hit) { return nearest = std::min(nearest, hit.distance); });
        EXPECT_EQ(nearest, first->distance);
        std::size_t all = 0;
        each_hit(ray, mesh, [&](const Hit<3>&) { ++all; });
        EXPECT_EQ(all, hits.size());
    }
    EXPECT_GT(stopped, 20);
}

TEST(RaycastMeshByHand, LeavesTheSurfaceThatItStartsOn) {
    const Mesh cube = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    for (const Vec3 start : {Vec3(1, 0.25f, 0.5f), Vec3(1, 0.5f, 0.5f), Vec3(1, 1, 0.5f)}) {
        EXPECT_FALSE(raycast({start, {0.6f, 0.8f, 0}}, cube)) << "outwards";
        EXPECT_FALSE(raycast({start, {0, 0.6f, 0.8f}, 0.1f}, cube)) << "along";
        const auto in = raycast({start, {-0.8f, -0.6f, 0}}, cube);
        ASSERT_TRUE(in) << "the other side";
        EXPECT_GT(in->distance, 0.2f);
    }
    EXPECT_FALSE(raycast({{0.5f, 0.25f, 0.5f}, {1, 0, 0}, 0}, cube)) << "of length zero";
    EXPECT_TRUE(raycast({{0.5f, 0.25f, 0.5f}, {1, 0, 0}, 0.5f}, cube)) << "as long as it is far";
    EXPECT_FALSE(raycast({{-1, 1.5f, 0.5f}, {1, 0, 0}}, cube)) << "beside, in parallel";
    EXPECT_FALSE(raycast({{0.5f, 0.25f, 0.5f}, {0, 0, 1}, 0.4999f}, cube));
}

// Coordinates whose triple products overflow or underflow in float.
TEST(RaycastMeshByHand, TakesSizesThatFloatsCannotMultiply) {
    for (const float size : {1e-30f, 1e-13f, 1e13f, 1e30f}) {
        const Mesh cube = box_surface(Vec3(0), Vec3(size)).mesh();
        const auto in = raycast({{-size, 0.25f * size, 0.5f * size}, {1, 0, 0}}, cube);
        ASSERT_TRUE(in) << size;
        EXPECT_EQ(in->distance, size);
        EXPECT_FALSE(raycast({{-size, 1.25f * size, 0.5f * size}, {1, 0, 0}}, cube)) << size;
    }
}

}  // namespace
}  // namespace abut::test
