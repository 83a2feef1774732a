// Every baked field loads again after saving, bit by bit, however inconsistent its signs are.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field.hpp>
#include <abut/field/file.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using scenes::SolidMesh;

/// The largest change of the distance between neighbouring samples, in cells; for a dense field.
template <int D>
double steepest(const Field<D>& field) {
    const detail::FieldData<D>& data = field.data();
    glm::vec<D, std::size_t> stride(1);
    for (int a = 1; a < D; ++a) stride[a] = stride[a - 1] * (data.cells[a - 1] + 1);
    double result = 0;
    for (std::size_t i = 0; i < data.distance.size(); ++i)
        for (int a = 0; a < D; ++a) {
            if (i / stride[a] % (data.cells[a] + 1) == data.cells[a]) continue;
            const float rise = std::abs(data.distance[i + stride[a]] - data.distance[i]);
            result = std::max(result, static_cast<double>(rise / data.cell));
        }
    return result;
}

template <int D>
void expect_loads(const Result<Field<D>>& field) {
    ASSERT_TRUE(field) << field.problem().message;
    const std::vector<std::byte> bytes = save(*field);
    const Result<Field<D>> again = load_field<D>(bytes);
    ASSERT_TRUE(again) << again.problem().message;
    EXPECT_EQ(save(*again), bytes);
}

/// Bakes it with each combination of options; returns the dense field of distances alone.
template <int D, class Bake>
Field<D> baked(Bake bake) {
    FieldOptions<D> options;
    for (const FieldStore store : {FieldStore::sparse, FieldStore::dense})
        for (const FieldLookup lookup : {FieldLookup::gradient, FieldLookup::linear})
            for (const bool quantised : {true, false}) {
                options.store = store;
                options.lookup = lookup;
                options.quantised = quantised;
                options.cell = 0.25f;
                expect_loads<D>(bake(options));
            }
    return *bake(options);
}

SolidMesh without_some(const SolidMesh& mesh, double share, oracle::Random& random) {
    SolidMesh result{mesh.points, {}};
    for (const glm::uvec3& t : mesh.triangles)
        if (!random.chance(share)) result.triangles.push_back(t);
    return result;
}

/// A guessed sign may change far from the surface.
TEST(LoadBaked, OpenMeshes) {
    oracle::Random random(11);
    const scenes::BumpyBall ball = scenes::bumpy_ball(10, 0.2, 0.02, random);
    const SolidMesh stone{ball.points, ball.triangles};
    double most = 0;
    for (const double share : {0.0, 0.1, 0.5}) {
        const SolidMesh open = without_some(stone, share, random);
        const Field3 field =
            baked<3>([&](const FieldOptions<3>& options) { return bake_field(open.points, open.triangles, options); });
        EXPECT_TRUE(share > 0 || steepest(field) < 1.001) << steepest(field);
        most = std::max(most, steepest(field));
    }
    std::printf("a sample to the next: up to %.2f cells\n", most);
    EXPECT_GT(most, 1.5) << "a limit on slopes would do";
}

TEST(LoadBaked, Outlines) {
    const std::vector<Vec2> star{{0, 2}, {1.2f, -1.7f}, {-1.9f, 0.6f}, {1.9f, 0.6f}, {-1.2f, -1.7f}};
    const std::vector<std::vector<Vec2>> holes{{{0, 0.5f}, {0.5f, -0.5f}, {-0.5f, -0.5f}},
                                               {{0, 0}, {3, 0}, {3, 0.25f}}};
    baked<2>([&](const FieldOptions<2>& options) { return bake_field(star, holes, options); });
}

/// A solid that the volume cuts ends there: towards the sample beside it the distance falls to 0.
template <int D>
void expect_combined() {
    FieldOptions<D> cut;
    cut.cell = 0.25f;
    cut.volume = Aabb<D>{Vec<D>(-1.0f), Vec<D>(1.0f)};
    const Field<D> ground = *bake_field(Ball<D>{Vec<D>(0.0f), 4}, cut);
    FieldOptions<D> whole;
    whole.cell = 0.25f;
    const Field<D> crate = *bake_field(Box<D>{Vec<D>(1.5f), Vec<D>(0.75f), {}}, whole);
    double most = 0;
    const auto expect = [&](auto bake) { most = std::max(most, steepest(baked<D>(bake))); };
    using Options = FieldOptions<D>;
    expect([&](const Options& options) { return field_union(ground, crate, options); });
    expect([&](const Options& options) { return field_difference(crate, ground, options); });
    expect([&](const Options& options) { return field_intersection(ground, crate, options); });
    expect([&](const Options& options) { return field_smooth_union(ground, crate, 1.0f, options); });
    expect([&](const Options& options) { return field_offset(ground, 0.5f, options); });
    expect([&](const Options& options) { return field_redistance(crate, options); });
    std::printf("a sample to the next: up to %.2f cells\n", most);
    EXPECT_GT(most, 4) << "a limit on slopes would do";
}

TEST(LoadBaked, CombinedFields) {
    expect_combined<2>();
    expect_combined<3>();
}

/// Too small, too large or too far for a field to load again, and still baked.
TEST(LoadBaked, BeyondItsLimitsIsRefused) {
    const auto code_of = [](float size, const FieldOptions<2>& options) {
        const Result<Field2> field = bake_field(Ball<2>{Vec2(0.0f), size}, options);
        if (field) expect_loads(field);
        return field ? ProblemCode::cancelled : field.problem().code;
    };
    EXPECT_EQ(code_of(1e-27f, {}), ProblemCode::cancelled);
    EXPECT_EQ(code_of(1e29f, {}), ProblemCode::cancelled);
    EXPECT_EQ(code_of(1e-32f, {}), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(1e33f, {}), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(1, {.volume = Aabb2{{1e33f, 1e33f}, {1.1e33f, 1.1e33f}}}), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(1, {.cell = 1e-20f, .volume = Aabb2{{30, 30}, {30, 30}}}), ProblemCode::bad_argument);
    EXPECT_EQ(code_of(1, {.cell = 0.5f, .volume = Aabb2{{0, 0}, {1e7f, 0}}}), ProblemCode::too_large);
}

}  // namespace
}  // namespace abut
