// Every stored sample against all triangles, by brute force in long double: distance and sign. 1,000 samples of a mesh,
// 8,000 if the environment sets ABUT_LONG; half of them of a sparse field, half of a dense one.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "../oracle/field.hpp"
#include "../oracle/is_long.hpp"
#include <abut/bake/field.hpp>

#include <array>
#include <numeric>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::FieldTruth;
using oracle::Random;
using oracle::StoredSample;
using scenes::SolidMesh;

constexpr std::uint64_t seed = 20240607;

std::size_t sample_count() {
    return oracle::is_long() ? 4000 : 500;
}

SolidMesh stone(std::uint32_t rows, double waves, double roughness, Random& random) {
    scenes::BumpyBall ball = scenes::bumpy_ball(rows, waves, roughness, random);
    return {std::move(ball.points), std::move(ball.triangles)};
}

/// The mesh without so many triangles, no two of which share a corner.
SolidMesh with_holes(SolidMesh mesh, std::size_t count, Random& random) {
    std::vector<bool> used(mesh.points.size());
    while (count > 0) {
        const auto at = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        const glm::uvec3 gone = mesh.triangles[at];
        if (used[gone.x] || used[gone.y] || used[gone.z]) continue;
        for (int i = 0; i < 3; ++i) used[gone[i]] = true;
        mesh.triangles.erase(mesh.triangles.begin() + at);
        --count;
    }
    return mesh;
}

/// Reverses each triangle with a probability, so that the winding is inconsistent.
SolidMesh with_flips(SolidMesh mesh, double share, Random& random) {
    for (glm::uvec3& triangle : mesh.triangles)
        if (random.chance(share)) std::swap(triangle.y, triangle.z);
    return mesh;
}

/// Each triangle with separate corners, as files often have them.
SolidMesh unwelded(const SolidMesh& mesh) {
    SolidMesh result;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (int i = 0; i < 3; ++i) result.points.push_back(mesh.points[triangle[i]]);
        result.triangles.emplace_back(first, first + 1, first + 2);
    }
    return result;
}

struct Compared {
    std::size_t inside = 0, wrong = 0, undecided = 0;
    double farthest = 0;  ///< the largest error of a distance
};

/// Checks random samples. A sign is wrong only if the winding number differs from one half by more than
/// `half_tolerance`, and the sample isn't within rounding of the surface.
template <int D, class Truth>
Compared compare(const Field<D>& field, const Truth& truth, double rounding, Random& random) {
    constexpr double half_tolerance = 1e-6;
    const std::vector<StoredSample<D>> samples = oracle::stored_samples(field);
    Compared result;
    for (std::size_t i = 0; i < sample_count(); ++i) {
        const StoredSample<D>& sample = samples[random.below(static_cast<std::uint32_t>(samples.size()))];
        const FieldTruth found = truth(sample.position);
        result.inside += sample.distance < 0;
        result.farthest = std::max(result.farthest, std::abs(std::abs(sample.distance) - found.distance));
        if (found.distance <= rounding) continue;
        if (std::abs(std::abs(found.winding) - 0.5) < half_tolerance)
            ++result.undecided;
        else if ((sample.distance < 0) != found.inside())
            ++result.wrong;
    }
    return result;
}

struct Case {
    std::string name;
    SolidMesh baked;
    SolidMesh surface;  ///< the mesh that the baker must bake equally
    bool closed = true;
};

std::vector<Case> cases(Random& random) {
    const std::uint32_t rows = oracle::is_long() ? 24 : 9;
    const SolidMesh ball = stone(rows, 0.2, 0.03, random), knot = scenes::knotted_tube(4 * rows, 8),
                    house = scenes::house();
    std::vector<Case> result;
    const auto add = [&](std::string name, SolidMesh mesh) { result.push_back({std::move(name), mesh, mesh, true}); };
    add("ball", ball);
    add("knot", knot);
    add("house", house);
    add("inside out", inside_out(knot));
    add("in the other", together(moved(ball, 2, Vec3(0)), inside_out(moved(ball, 1, Vec3(0)))));
    add("across itself", together(ball, moved(ball, 0.9f, {0.7f, 0.2f, -0.1f})));
    add("twice", together(ball, ball));
    add("rough", stone(rows, 0.2, 0.6, random));
    add("far away", moved(ball, 1, {1e4f, -1e4f, 3e3f}));
    add("tiny", moved(ball, 1e-3f, Vec3(0)));
    add("large", moved(ball, 1e4f, Vec3(0)));
    add("own corners", unwelded(ball));
    result.push_back({"some turned", with_flips(ball, 0.1, random), ball, true});
    const SolidMesh holes = with_holes(ball, 5, random);
    result.push_back({"five holes", holes, holes, false});
    result.push_back({"five holes, some turned", with_flips(holes, 0.1, random), holes, false});
    SolidMesh most = ball;
    most.triangles.resize(most.triangles.size() * 3 / 5);
    result.push_back({"most of it", most, most, false});
    return result;
}

float longest_side(const SolidMesh& mesh) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& point : mesh.points) box = merged(box, Aabb3{point, point});
    const Vec3 side = box.max - box.min;
    return std::max({side.x, side.y, side.z});
}

TEST(FieldOracle, KnowsACube) {
    const SolidMesh cube = scenes::of_cubes({{"#"}});
    const oracle::TriangleTruth truth(cube.points, cube.triangles);
    EXPECT_NEAR(truth.winding({0.5, 0.25, 0.75}), 1, 1e-15);
    EXPECT_NEAR(truth.winding({1.5, 0.25, 0.75}), 0, 1e-15);
    EXPECT_NEAR(truth.distance({0.5, 0.25, 0.75}), 0.25, 1e-15);
    EXPECT_NEAR(truth.distance({2, 2, 2}), std::sqrt(3.0), 1e-15);
    EXPECT_NEAR(truth.distance({2, 2, 0.5}), std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(truth.distance({0.25, 0.5, -3}), 3, 1e-15);
    SolidMesh open = cube;
    open.triangles.resize(10);  // without its top
    EXPECT_NEAR(oracle::TriangleTruth(open.points, open.triangles).winding({0.5, 0.5, 0.5}), 5.0 / 6, 1e-15);
}

TEST(FieldOracle, KnowsASquareWithAHole) {
    const std::vector<Vec2> square{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    const std::vector<std::vector<Vec2>> hole{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
    const oracle::OutlineTruth truth(square, hole);
    EXPECT_TRUE(truth({0.5, 0.5}).inside());
    EXPECT_FALSE(truth({1.5, 1.5}).inside());
    EXPECT_FALSE(truth({-1, 1.5}).inside());
    EXPECT_NEAR(truth({1.5, 1.25}).distance, 0.25, 1e-15);
    EXPECT_NEAR(truth({4, 4}).distance, std::sqrt(2.0), 1e-15);
}

TEST(FieldOracle, SamplesAreExact) {
    Random random(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const Case& one : cases(random)) {
        SCOPED_TRACE(one.name);
        const oracle::TriangleTruth truth(one.surface.points, one.surface.triangles);
        for (const FieldStore store : {FieldStore::sparse, FieldStore::dense}) {
            FieldReport report;
            FieldOptions<3> options;
            options.store = store;
            options.cell = longest_side(one.baked) / (oracle::is_long() ? 20 : 14);
            options.report = &report;
            const Result<Field3> field = bake_field(one.baked.points, one.baked.triangles, options);
            ASSERT_TRUE(field) << field.problem().message;
            EXPECT_EQ(report.closed, one.closed);
            EXPECT_EQ(report.gaps == 0, one.closed);
            // Distances are rounded to floats. So are the corners, but the reference has the rounded ones too.
            const double rounding = 1e-6 * static_cast<double>(longest_side(one.baked));
            const Compared found = compare<3>(*field, truth, rounding, random);
            EXPECT_EQ(found.wrong, 0u);
            EXPECT_LE(found.farthest, rounding);
            EXPECT_LT(found.undecided, sample_count() / 100);
            if (store == FieldStore::dense) {
                EXPECT_GT(found.inside, sample_count() / 100) << "no sample of an inside proves nothing";
                EXPECT_LT(found.inside, sample_count() * 9 / 10);
            }
        }
    }
}

TEST(FieldOracle, OutlinesAreExact) {
    Random random(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto star = [&](std::uint32_t corners, const DVec<2>& center, double least, double most) {
        std::vector<Vec2> ring;
        for (std::uint32_t i = 0; i < corners; ++i)
            ring.push_back(to_float(center + scenes::on_circle(4.0 * i / corners) * random.uniform(least, most)));
        return ring;
    };
    for (int i = 0; i < 20; ++i) {
        const std::vector<Vec2> outline = star(3 + random.below(200), {0, 0}, 0.5, 3);
        std::vector<std::vector<Vec2>> holes;
        for (std::uint32_t count = random.below(4); count > 0; --count) {
            const DVec<2> center = random.in_cube<2>();
            holes.push_back(star(3 + random.below(20), center, 0.1, 0.6));
            if (random.chance(0.5)) std::reverse(holes.back().begin(), holes.back().end());
        }
        const oracle::OutlineTruth truth(outline, holes);
        for (const FieldStore store : {FieldStore::sparse, FieldStore::dense}) {
            FieldOptions<2> options;
            options.store = store;
            const Result<Field2> field = bake_field(outline, holes, options);
            ASSERT_TRUE(field) << field.problem().message;
            const Compared found = compare<2>(*field, truth, 1e-5, random);
            EXPECT_EQ(found.wrong, 0u);
            EXPECT_LE(found.farthest, 1e-5);
            EXPECT_GT(found.inside, sample_count() / 100);
        }
    }
}

/// The errors between the samples, at points no farther than a cell from the surface, in cells.
struct NearError {
    double root_mean_square = 0, largest = 0, wrong_side = 0;
};

NearError near_error(const Field3& field, const SolidMesh& mesh, Random& random) {
    const oracle::TriangleTruth truth(mesh.points, mesh.triangles);
    const double cell = static_cast<double>(field.cell());
    const std::size_t count = oracle::is_long() ? 20'000 : 600;
    NearError result;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::uvec3& t = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
        const DVec<3> a(mesh.points[t.x]), b(mesh.points[t.y]), c(mesh.points[t.z]);
        double u = random.unit(), v = random.unit();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const double away = random.uniform(-cell, cell);
        const Vec3 point = to_float(a + (b - a) * u + (c - a) * v + normalized(cross(b - a, c - a)) * away);
        const double exact = truth(DVec<3>(point)).signed_distance();
        const double found = static_cast<double>(field.distance(point)), error = std::abs(found - exact) / cell;
        result.root_mean_square += error * error;
        result.largest = std::max(result.largest, error);
        result.wrong_side += (found < 0) != (exact < 0);
    }
    result.root_mean_square = std::sqrt(result.root_mean_square / static_cast<double>(count));
    result.wrong_side /= static_cast<double>(count);
    return result;
}

TEST(FieldOracle, ErrorsNearTheSurfaceAreSmall) {
    Random random(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SolidMesh smooth = stone(oracle::is_long() ? 24 : 16, 0.1, 0, random), edges = scenes::house();
    for (const SolidMesh* mesh : {&smooth, &edges}) {
        const Result<Field3> field = bake_field(mesh->points, mesh->triangles);
        ASSERT_TRUE(field) << field.problem().message;
        const NearError error = near_error(*field, *mesh, random);
        RecordProperty("error", std::to_string(error.root_mean_square) + " cells root mean square, " +
                                    std::to_string(error.largest) + " at most");
        EXPECT_LT(error.root_mean_square, 0.06);
        EXPECT_GT(error.root_mean_square, 1e-4) << "samples alone can't know it so well";
        EXPECT_LT(error.largest, 1);
        EXPECT_LT(error.wrong_side, 0.05);
    }
}

}  // namespace
}  // namespace abut
