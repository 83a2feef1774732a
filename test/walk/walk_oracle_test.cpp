// Random walks over every kind of surface, compared with the oracle: a million if the environment sets ABUT_LONG, else
// a share of it. None leaves the mesh, gets stuck or ends elsewhere.

#include "../oracle/is_long.hpp"
#include "walk_check.hpp"

#include <cmath>
#include <iostream>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::uint64_t walk_oracle_seed = 20261123;

std::uint64_t walks_on_each(std::size_t surfaces) {
    return (oracle::is_long() ? 1'000'000 : 60'000) / surfaces + 1;
}

/// In the middle, on an edge, on a corner; and unusual weights.
WalkPoint random_place(const WalkMesh& mesh, oracle::Random& random) {
    const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangles().size()));
    if (!mesh.is_walkable(triangle)) return random_place(mesh, random);
    Vec3 weights;
    for (int k = 0; k < 3; ++k) weights[k] = random.uniform_float(0, 1);
    const auto k = static_cast<glm::length_t>(random.below(3));
    const double kind = random.unit();
    if (kind < 0.2) weights[k] = 0;
    if (kind < 0.1) weights[(k + 1) % 3] = 0;
    if (kind > 0.9) weights[k] *= 1e-30f;
    if (kind > 0.95) weights *= 1e-6f;
    if (weights.x + weights.y + weights.z == 0) weights.x = 1;
    return {triangle, weights};
}

/// A random direction, or along an axis, along a side or towards a corner.
Vec3 random_direction(const WalkMesh& mesh, const WalkPoint& place, oracle::Random& random) {
    const glm::uvec3 t = mesh.triangles()[place.triangle];
    const auto k = static_cast<glm::length_t>(random.below(3));
    const double kind = random.unit();
    DVec<3> direction = random.direction<3>();
    if (kind < 0.1) direction = axis<3>(static_cast<int>(k), random.chance(0.5) ? 1 : -1);
    if (kind > 0.8) direction = DVec<3>(mesh.points()[t[(k + 1) % 3]]) - DVec<3>(mesh.points()[t[k]]);
    if (kind > 0.9) direction = DVec<3>(mesh.points()[t[k]]) - DVec<3>(mesh.to_world(place));
    const double norm = length(direction);
    if (norm == 0) return {0, 0, 1};
    // Some stay exact, scaled by a power of two.
    const bool is_exact = kind > 0.8 && random.chance(0.3);
    return to_float(is_exact ? direction * std::ldexp(1.0, -std::ilogb(norm)) : direction / norm);
}

double random_length(oracle::Random& random) {
    const double kind = random.unit();
    if (kind < 0.02) return 0;
    if (kind < 0.1) return 1e-6;
    if (kind < 0.4) return 0.05;
    if (kind < 0.8) return random.uniform(0, 2);
    return kind < 0.985 ? 10 : 1000;
}

/// A walker that goes on from its last end, and begins elsewhere now and then.
WalkTally walk_at_random(const WalkMesh& mesh, const Surface& surface, std::uint64_t walks) {
    WalkCheck check(mesh, surface);
    oracle::Random random(walk_oracle_seed);
    WalkTally tally;
    WalkPoint place = random_place(mesh, random);
    for (std::uint64_t i = 0; i < walks; ++i) {
        if (random.chance(0.1)) place = random_place(mesh, random);
        const double far = random_length(random) * check.edge();
        const Vec3 step = random_direction(mesh, place, random) * static_cast<float>(far);
        const Walked walked = random.chance(0.8) ? check.check<3>(place, step, tally)
                                                 : check.check<2>(place, mesh.to_plane(place.triangle, step), tally);
        check.check_back(place, step, walked, tally);
        place = walked.place;
    }
    return tally;
}

class WalkOracle : public testing::TestWithParam<std::size_t> {};

TEST_P(WalkOracle, AgreesOnEachSurface) {
    const std::vector<NamedSurface> all = surfaces(walk_oracle_seed);
    const NamedSurface& at = all[GetParam()];
    const WalkMesh mesh = *WalkMesh::build(at.surface.points, at.surface.triangles);
    const std::uint64_t walks = walks_on_each(all.size());
    const WalkTally tally = walk_at_random(mesh, at.surface, walks);
    std::cout << at.name << " (" << described(mesh.report()) << "): " << tally.text() << "\n";
    EXPECT_EQ(tally.faults, 0u) << at.name << ", walk_oracle_seed " << walk_oracle_seed << ": " << tally.faults_text();
    EXPECT_LE(tally.open * 500, tally.walks) << "of these the oracle doesn't know enough";
    EXPECT_GT(tally.crossings, walks / 2);
    EXPECT_GT(tally.home, walks / 20);
}

TEST_P(WalkOracle, AgreesAtAllScalesAndFarFromTheOrigin) {
    const NamedSurface at = surfaces(walk_oracle_seed)[GetParam()];
    for (const double scale : {1e-3, 0.1, 30.0, 1e4})
        for (const double away : {0.0, 30.0}) {
            Surface surface = at.surface;
            for (Vec3& point : surface.points)
                point = to_float((DVec<3>(point) + DVec<3>(away, -away, 0.5 * away)) * scale);
            const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
            ASSERT_TRUE(mesh);
            const WalkTally tally = walk_at_random(*mesh, surface, walks_on_each(400));
            EXPECT_EQ(tally.faults, 0u) << at.name << " at scale " << scale << ", away by " << away
                                        << ", walk_oracle_seed " << walk_oracle_seed << ": " << tally.faults_text();
        }
}

/// Validates the oracle: in quadruple precision it has the same ends.
TEST_P(WalkOracle, IsRightItself) {
    using Quad = boost::multiprecision::cpp_bin_float_quad;
    const NamedSurface at = surfaces(walk_oracle_seed)[GetParam()];
    const WalkMesh mesh = *WalkMesh::build(at.surface.points, at.surface.triangles);
    const double size = size_of(at.surface), edge = edge_of(at.surface);
    const oracle::TriangleAdjacency triangles(mesh);
    oracle::Geodesic<long double> rough(triangles, static_cast<long double>(1e-9 * size));
    oracle::Geodesic<Quad> exact(triangles, Quad(1e-9 * size));
    oracle::Random random(walk_oracle_seed);
    for (int i = 0; i < 60; ++i) {
        const WalkPoint place = random_place(mesh, random);
        const Vec3 step = random_direction(mesh, place, random) * static_cast<float>(random.uniform(0, 30) * edge);
        const auto a = rough.walk(place, step);
        const auto b = exact.walk(place, step);
        if (a.size() != 1 || b.size() != 1) continue;
        EXPECT_LE(length(a[0].point.rounded() - b[0].point.rounded()), 1e-12 * size)
            << at.name << ", walk_oracle_seed " << walk_oracle_seed << ", item " << i;
        EXPECT_NEAR(static_cast<double>(a[0].length), static_cast<double>(b[0].length), 1e-12 * size);
        EXPECT_LE(length(a[0].direction.rounded() - b[0].direction.rounded()), 1e-12);
    }
}

std::string name_of(const testing::TestParamInfo<std::size_t>& number) {
    std::string name = surfaces(walk_oracle_seed)[number.param].name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Surfaces, WalkOracle, testing::Range(std::size_t{0}, surfaces(walk_oracle_seed).size()),
                         name_of);

}  // namespace
}  // namespace abut::test
