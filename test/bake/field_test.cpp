// Baking: problems, progress, threads, samples at special places, and a mesh that changes. field_oracle_test.cpp checks
// the samples.

#include "../oracle/field.hpp"

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "../oracle/is_long.hpp"
#include "../oracle/simd_targets.hpp"
#include <abut/bake/field.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/math/thread_pool.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/half_space.hpp>

#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using scenes::SolidMesh;

constexpr std::uint64_t field_seed = 5;
constexpr float infinity = std::numeric_limits<float>::infinity();

SolidMesh stone(std::uint32_t rows) {
    Random random(field_seed);
    scenes::BumpyBall ball = scenes::bumpy_ball(rows, 0.2, 0.02, random);
    return {std::move(ball.points), std::move(ball.triangles)};
}
SolidMesh cube() {
    return scenes::of_cubes({{"#"}});
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
template <int D>
bool same_bits(const Field<D>& a, const Field<D>& b) {
    const FieldData<D>&x = a.data(), &y = b.data();
    return x.origin == y.origin && x.cell == y.cell && x.cells == y.cells && x.surface == y.surface &&
           same_bits(x.brick, y.brick) && same_bits(x.coarse, y.coarse) && same_bits(x.distance, y.distance) &&
           same_bits(x.steps, y.steps) && same_bits(x.direction, y.direction) && same_bits(x.closest, y.closest);
}

FieldOptions<3> everything() {
    FieldOptions<3> options;
    options.lookup = FieldLookup::gradient;
    options.closest_points = true;
    return options;
}

ProblemCode code_of(const Result<Field3>& result) {
    EXPECT_FALSE(result);
    if (result) return ProblemCode::not_found;
    EXPECT_FALSE(result.problem().message.empty());
    return result.problem().code;
}

TEST(BakeField, NamesWhatIsWrong) {
    const SolidMesh mesh = cube();
    EXPECT_EQ(code_of(bake_field(std::vector<Vec3>(), std::vector<glm::uvec3>())), ProblemCode::empty_input);
    const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    EXPECT_EQ(code_of(bake_field(line, std::vector<glm::uvec3>{{0, 1, 2}})), ProblemCode::empty_input);

    SolidMesh bad = mesh;
    bad.points[3].y = std::numeric_limits<float>::quiet_NaN();
    const Result<Field3> not_finite = bake_field(bad.points, bad.triangles);
    EXPECT_EQ(code_of(not_finite), ProblemCode::not_finite);
    EXPECT_EQ(not_finite.problem().index, 3u);
    bad = mesh;
    bad.triangles[7].z = static_cast<std::uint32_t>(bad.points.size());
    const Result<Field3> out_of_range = bake_field(bad.points, bad.triangles);
    EXPECT_EQ(code_of(out_of_range), ProblemCode::index_out_of_range);
    EXPECT_EQ(out_of_range.problem().index, 7u);

    for (int i = 0; i < 6; ++i) {
        FieldOptions<3> options;
        const auto bake = [&] { return code_of(bake_field(mesh.points, mesh.triangles, options)); };
        if (i == 0) options.cell = -1;
        if (i == 1) options.cell = infinity;
        if (i == 2) options.padding = 0.5f;
        if (i == 3) options.band = 0.5f;
        if (i == 4) options.volume = Aabb3{{1, 1, 1}, {0, 0, 0}};
        if (i == 5) options.volume = Aabb3{{0, 0, 0}, {infinity, 1, 1}};
        EXPECT_EQ(bake(), ProblemCode::bad_argument) << i;
    }
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        FieldOptions<3> options;
        options.store = store;
        options.cell = 1e-5f;
        EXPECT_EQ(code_of(bake_field(mesh.points, mesh.triangles, options)), ProblemCode::too_large);
    }
    EXPECT_EQ(code_of(bake_field(HalfSpace<3>{{0, 0, 1}, 0})), ProblemCode::bad_argument);
}

TEST(BakeField, EveryCallOfProgressCanCancel) {
    const SolidMesh mesh = stone(9);
    int calls = 0, fine_calls = 0;
    double before = 0;
    FieldOptions<3> options;
    const auto all = [&](double done) {
        ++calls;
        EXPECT_GE(done, before);
        EXPECT_LE(done, 1);
        before = done;
        return true;
    };
    options.progress = FunctionRef<bool(double)>(all);
    ASSERT_TRUE(bake_field(mesh.points, mesh.triangles, options));
    EXPECT_EQ(before, 1);
    EXPECT_GT(calls, 20);
    for (int stop = 1; stop <= calls; stop += 1 + calls / 40) {
        int called = 0;
        const auto some = [&](double) { return ++called < stop; };
        options.progress = FunctionRef<bool(double)>(some);
        EXPECT_EQ(code_of(bake_field(mesh.points, mesh.triangles, options)), ProblemCode::cancelled) << stop;
        EXPECT_EQ(called, stop);
        ++fine_calls;
    }
    EXPECT_GT(fine_calls, 10);
}

TEST(BakeField, ThreadsChangeNoBit) {
    SolidMesh mesh = stone(9);
    for (int holes = 0; holes < 2; ++holes) {
        for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
            FieldOptions<3> options = everything();
            options.store = store;
            const Result<Field3> alone = bake_field(mesh.points, mesh.triangles, options);
            ThreadPool threads(4);
            options.executor = &threads;
            const Result<Field3> together = bake_field(mesh.points, mesh.triangles, options);
            ASSERT_TRUE(alone && together);
            EXPECT_TRUE(same_bits(*alone, *together));
        }
        mesh.triangles.resize(mesh.triangles.size() - 5);
    }
}

class FieldByVectorUnit : public oracle::BySimdTarget {};
INSTANTIATE_TEST_SUITE_P(All, FieldByVectorUnit, oracle::simd_targets(), oracle::simd_target_name);

TEST_P(FieldByVectorUnit, ChangesNoBit) {
    const SolidMesh mesh = stone(15);
    const std::vector<Vec2> outline{{0, 0}, {4, 1}, {3, 5}, {2, 1.5f}, {-1, 3}};
    const auto bake = [&] { return bake_field(mesh.points, mesh.triangles, everything()); };
    const auto bake_flat = [&] { return bake_field(outline); };
    const Result<Field3> here = bake();
    const Result<Field2> flat_here = bake_flat();
    const oracle::ForcedSimdTarget scalar(oracle::supported_simd_targets().back());
    const Result<Field3> there = bake();
    const Result<Field2> flat_there = bake_flat();
    ASSERT_TRUE(here && there && flat_here && flat_there);
    EXPECT_TRUE(same_bits(*here, *there));
    EXPECT_TRUE(same_bits(*flat_here, *flat_there));
}

TEST(BakeField, SamplesOnTheSurfaceHaveNormals) {
    for (const bool inside_out : {false, true}) {
        SolidMesh mesh = cube();
        if (inside_out)
            for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
        FieldOptions<3> options = everything();
        options.store = FieldStore::dense;
        options.cell = 0.25f;
        options.volume = Aabb3{Vec3(-0.5f), Vec3(1.5f)};
        const Result<Field3> field = bake_field(mesh.points, mesh.triangles, options);
        ASSERT_TRUE(field);
        const FieldData<3>& data = field->data();
        int on_it = 0;
        for (std::size_t i = 0; i < data.distance.size(); ++i) {
            const auto number = static_cast<std::uint32_t>(i);
            const Vec3 p = Vec3(-0.5f) + 0.25f * Vec3(glm::uvec3(number % 9, number / 9 % 9, number / 81));
            const Vec3 normal = unpacked<3>(data.direction[i]);  // right to a degree
            EXPECT_NEAR(data.distance[i], dot(DVec<3>(p - data.closest[i]), DVec<3>(normal)), 1e-3);
            if (data.distance[i] != 0) continue;
            ++on_it;
            // Out of the cube; at its edges and corners by one of the faces there.
            const Vec3 out = p + 0.1f * normal;
            EXPECT_FALSE(contains(Aabb3{Vec3(0), Vec3(1)}, out)) << p.x << ' ' << p.y << ' ' << p.z;
        }
        EXPECT_EQ(on_it, 5 * 5 * 5 - 3 * 3 * 3);
    }
}

TEST(BakeField, ASheetEnclosesNextToNothing) {
    // A Moebius strip has no outside. Where it is bent, the winding number close to it is a little more than 0.5 on one
    // side: 3 % of the samples.
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    constexpr std::uint32_t steps = 48;
    for (std::uint32_t i = 0; i < steps; ++i) {
        const double around = 6.283185307179586 * i / steps;
        for (const double across : {-0.25, 0.25}) {
            const double radius = 1 + across * std::cos(around / 2);
            points.emplace_back(radius * std::cos(around), radius * std::sin(around), across * std::sin(around / 2));
        }
        const std::uint32_t a = 2 * i, b = 2 * i + 1;
        const bool last = i + 1 == steps;
        const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : b + 2;
        triangles.emplace_back(a, c, b);
        triangles.emplace_back(b, c, d);
    }
    FieldReport report;
    FieldOptions<3> options = everything();
    options.report = &report;
    const Result<Field3> field = bake_field(points, triangles, options);
    ASSERT_TRUE(field);
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.gaps, 2 * steps + 1);  // its border, and where it is sewn with inconsistent winding
    const std::vector<oracle::StoredSample<3>> samples = oracle::stored_samples(*field);
    std::size_t inside = 0;
    for (const oracle::StoredSample<3>& sample : samples) {
        inside += sample.distance < 0;
        EXPECT_GT(sample.distance, -1.5 * static_cast<double>(field->cell()));
    }
    EXPECT_LT(inside, samples.size() / 25);
}

/// Triangles without shared edges have signs by their winding numbers: 2,000 of a ball, a third of it removed.
TEST(BakeField, SoupsAreReportedExactly) {
    SolidMesh mesh = stone(27);
    Random random(field_seed);
    SolidMesh soup;
    for (const glm::uvec3& t : mesh.triangles) {
        if (random.chance(0.3)) continue;
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (int i = 0; i < 3; ++i) {
            soup.points.push_back(mesh.points[t[i]]);
            for (int k = 0; k < 3; ++k) soup.points.back()[k] += random.uniform_float(-0.003, 0.003);
        }
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
    FieldReport report;
    FieldOptions<3> options;
    options.cell = 0.15f;
    options.report = &report;
    const Result<Field3> field = bake_field(soup.points, soup.triangles, options);
    ASSERT_TRUE(field);
    EXPECT_EQ(report.gaps, 3 * soup.triangles.size());
    const oracle::TriangleTruth truth(soup.points, soup.triangles);
    const std::vector<oracle::StoredSample<3>> samples = oracle::stored_samples(*field);
    int inside = 0, wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto& sample = samples[random.below(static_cast<std::uint32_t>(samples.size()))];
        const double winding = std::abs(truth.winding(sample.position));
        inside += winding >= 0.5;
        wrong += (sample.distance < 0) != (winding >= 0.5);
    }
    EXPECT_GT(inside, 100);
    EXPECT_LT(inside, 900);
    EXPECT_EQ(wrong, 0);
}

/// Flat holes along planes of samples: up to 8 of 2,900 samples in such a plane once had the other sign. The counted
/// line was on one side of the hole, the solid angle on the other.
TEST(BakeField, SamplesInWhatClosesHolesHaveTheirSign) {
    Random random(field_seed);
    const SolidMesh house = scenes::house();
    SolidMesh open{house.points, {}};
    for (const glm::uvec3& t : house.triangles)
        if (!random.chance(0.12)) open.triangles.push_back(t);
    FieldOptions<3> options;
    options.cell = 0.5f;
    options.volume = Aabb3{Vec3(-1), Vec3(10)};
    options.store = FieldStore::dense;
    const Result<Field3> field = bake_field(open.points, open.triangles, options);
    ASSERT_TRUE(field);
    const oracle::TriangleTruth truth(open.points, open.triangles);
    int compared = 0, inside = 0;
    for (const oracle::StoredSample<3>& sample : oracle::stored_samples(*field)) {
        if (std::abs(sample.distance) < 1e-3 || random.chance(oracle::is_long() ? 0 : 0.8)) continue;
        const double winding = std::abs(truth.winding(sample.position));
        if (std::abs(winding - 0.5) < 1e-9) continue;
        ++compared;
        inside += winding > 0.5;
        EXPECT_EQ(sample.distance<0, winding> 0.5)
            << sample.position.x << ' ' << sample.position.y << ' ' << sample.position.z << ": " << winding;
    }
    EXPECT_GT(compared, 1000);
    EXPECT_GT(inside, 30);
}

/// A bump on the ball: equal samples, most of them not computed again.
TEST(RebakeField, IsTheSameAsBakingAllOfIt) {
    const SolidMesh before = stone(21);
    SolidMesh after = before;
    Aabb3 changed = Aabb3::empty();
    for (Vec3& p : after.points)
        if (p.x > 0.85f) p *= 1.2f;
    for (const glm::uvec3& t : before.triangles) {
        if (after.points[t.x] == before.points[t.x] && after.points[t.y] == before.points[t.y] &&
            after.points[t.z] == before.points[t.z])
            continue;
        for (int i = 0; i < 3; ++i)
            for (const Vec3& p : {before.points[t[i]], after.points[t[i]]}) changed = merged(changed, Aabb3{p, p});
    }
    ASSERT_LT(changed.min.x, changed.max.x);
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        FieldOptions<3> options = everything();
        options.store = store;
        options.cell = 0.0625f;
        options.volume = Aabb3{Vec3(-2), Vec3(2)};
        const Result<Field3> old = bake_field(before.points, before.triangles, options);
        const Result<Field3> whole = bake_field(after.points, after.triangles, options);
        ASSERT_TRUE(old && whole);
        EXPECT_FALSE(same_bits(*old, *whole));
        const Result<Field3> again = rebake_field(*old, changed, after.points, after.triangles, options);
        ASSERT_TRUE(again);
        EXPECT_TRUE(same_bits(*again, *whole));
    }
}

TEST(RebakeField, OtherOptionsAreRefused) {
    const SolidMesh mesh = cube();
    const Result<Field3> field = bake_field(mesh.points, mesh.triangles);
    ASSERT_TRUE(field);
    FieldOptions<3> options;
    EXPECT_TRUE(rebake_field(*field, Aabb3{Vec3(0), Vec3(1)}, mesh.points, mesh.triangles, options));
    options.store = FieldStore::dense;
    EXPECT_EQ(code_of(rebake_field(*field, Aabb3{Vec3(0), Vec3(1)}, mesh.points, mesh.triangles, options)),
              ProblemCode::bad_argument);
}

TEST(BakeField, ShapesAreSampledByQueries) {
    const Result<Field3> ball = bake_field(Sphere{{1, 2, 3}, 2}, FieldOptions<3>{.cell = 0.25f});
    ASSERT_TRUE(ball);
    for (const oracle::StoredSample<3>& sample : oracle::stored_samples(*ball))
        EXPECT_NEAR(sample.distance, length(sample.position - DVec<3>(1, 2, 3)) - 2, 1e-5);
}

TEST(BakeField, SixteenBitsAreWithinHalfAStep) {
    const SolidMesh mesh = stone(9);
    FieldOptions<3> options;
    const Result<Field3> whole = bake_field(mesh.points, mesh.triangles, options);
    options.quantised = true;
    const Result<Field3> small = bake_field(mesh.points, mesh.triangles, options);
    ASSERT_TRUE(whole && small);
    EXPECT_LT(small->bytes(), whole->bytes() * 2 / 3);
    const auto& large = whole->data().distance;
    ASSERT_EQ(small->data().steps.size(), large.size());
    const auto step = static_cast<double>(small->data().step);
    for (std::size_t i = 0; i < large.size(); ++i)
        EXPECT_NEAR(small->data().steps[i] * step, static_cast<double>(large[i]), 0.500001 * step);
}

}  // namespace
}  // namespace abut
