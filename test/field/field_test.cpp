// Look-ups of distances: against a reference in long double, and against the solids themselves.

#include "analytic.hpp"
#include <abut/field/field.hpp>
#include <abut/field/quantise.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using namespace oracle;

/// A reference: multilinear interpolation of a dense field's samples.
template <int D>
long double reference_distance(const FieldData<D>& data, const Vec<D>& point) {
    long double result = 0;
    glm::vec<D, std::uint32_t> cell;
    long double share[D];
    for (int a = 0; a < D; ++a) {
        const long double place = (static_cast<long double>(point[a]) - static_cast<long double>(data.origin[a])) /
                                  static_cast<long double>(data.cell);
        const long double last = static_cast<long double>(data.cells[a]) - 1;
        const long double low = std::clamp(std::floor(place), 0.0L, last);
        cell[a] = static_cast<std::uint32_t>(low);
        share[a] = place - low;
    }
    for (std::size_t corner = 0; corner < std::size_t{1} << D; ++corner) {
        long double weight = 1;
        std::size_t index = 0, stride = 1;
        for (int a = 0; a < D; ++a) {
            const bool upper = corner >> a & 1;
            weight *= upper ? share[a] : 1 - share[a];
            index += (cell[a] + (upper ? 1 : 0)) * stride;
            stride *= data.cells[a] + 1;
        }
        result += weight * static_cast<long double>(data.distance[index]);
    }
    return result;
}

template <int D>
Vec<D> anywhere(Random& random, const Aabb<D>& box) {
    Vec<D> result;
    for (int a = 0; a < D; ++a)
        result[a] = random.uniform_float(static_cast<double>(box.min[a]), static_cast<double>(box.max[a]));
    return result;
}

template <int D>
void expect_reference(const Analytic<D>& solid, float cell) {
    const Field<D> field(filled_around<D>(solid, cell, 3));
    const Aabb<D> volume = field.volume();
    float size = cell;
    for (int a = 0; a < D; ++a)
        size = std::max({size, std::abs(volume.min[a]), std::abs(volume.max[a]), volume.max[a] - volume.min[a]});
    Random random(71);
    for (int i = 0; i < 20000; ++i) {
        const Vec<D> point = anywhere<D>(random, volume);
        const long double right = reference_distance(field.data(), point);
        ASSERT_NEAR(static_cast<double>(field.distance(point)), static_cast<double>(right),
                    static_cast<double>(size) * 4e-7);
        const FieldSample<D> sample = field.sample(point);
        ASSERT_EQ(sample.distance, field.distance(point));
        ASSERT_NEAR(length(DVec<D>(sample.normal)), 1, 1e-6);
    }
}

TEST(Field, IsLinearBetweenSamples) {
    expect_reference<2>(ball<2>({1, 2}, 3), 0.25f);
    expect_reference<2>(box<2>({-1, 0.5}, {2, 1}), 0.1f);
    expect_reference<3>(ball<3>({1, 2, -3}, 3), 0.25f);
    expect_reference<3>(box<3>({100, 0.5, 7}, {2, 1, 3}), 0.1f);
    expect_reference<3>(torus({0, 0, 0}, 2e-3, 1e-3), 2e-4f);
    expect_reference<3>(torus({0, 0, 0}, 2e4, 1e4), 2e3f);
}

/// A sparse field stores the samples of the dense one near the surface; elsewhere it is linear over blocks.
template <int D>
void expect_sparse_like_dense(const Analytic<D>& solid, float cell) {
    FillOptions options;
    options.store = FieldStore::sparse;
    const FieldData<D> sparse = filled_around<D>(solid, cell, 9, options);
    const Field<D> stored(sparse), all(filled<D>(solid, sparse.origin, cell, sparse.cells));
    ASSERT_LT(stored.bytes(), all.bytes());
    const auto step = static_cast<double>(cell);
    Random random(23);
    int near = 0, far = 0;
    for (int i = 0; i < 30000; ++i) {
        const Vec<D> point = anywhere<D>(random, all.volume());
        const double right = solid.distance(DVec<D>(point));
        if (std::abs(right) < 3 * step) {
            ASSERT_EQ(stored.distance(point), all.distance(point));
            ASSERT_EQ(stored.sample(point).normal, all.sample(point).normal);
            ++near;
        } else {
            ASSERT_NEAR(static_cast<double>(stored.distance(point)), right, 2 * step * brick_cells<D>);
            ASSERT_EQ(stored.distance(point) > 0, right > 0);
            ++far;
        }
    }
    EXPECT_GT(near, 3000);
    EXPECT_GT(far, 3000);
    // At the samples themselves, also at borders of cells and bricks.
    for (std::size_t i = 0; i < all.data().distance.size(); ++i) {
        const DVec<D> place = DVec<D>(sparse.origin) + DVec<D>(counted<D>(i, sparse.cells + 1u)) * step;
        if (std::abs(solid.distance(place)) > 3 * step) continue;
        ASSERT_NEAR(stored.distance(to_float<D>(place)), all.data().distance[i], 1e-4 * step);
    }
}

TEST(Field, SparseIsAsGoodNearTheSurface) {
    expect_sparse_like_dense<2>(ball<2>({1, 2}, 3), 0.1f);
    expect_sparse_like_dense<2>(box<2>({-1, 0.5}, {2, 1}), 0.05f);
    expect_sparse_like_dense<3>(ball<3>({1, 2, -3}, 3), 0.2f);
    expect_sparse_like_dense<3>(torus({0, 0, 0}, 2, 1), 0.15f);
}

/// If no difference of a distance exceeds the step's length, each partial derivative is at most 1.
template <int D>
void expect_lipschitz(const Field<D>& field, std::uint64_t seed) {
    const Aabb<D> volume = field.volume();
    Random random(seed);
    double most = 0;
    for (int i = 0; i < 50000; ++i) {
        const Vec<D> a = anywhere<D>(random, volume);
        Vec<D> b;
        for (int k = 0; k < D; ++k)
            b[k] = std::clamp(a[k] + random.uniform_float(-1, 1) * field.cell(), volume.min[k], volume.max[k]);
        const double step_length = length(DVec<D>(b) - DVec<D>(a));
        const double change = static_cast<double>(field.distance(b)) - static_cast<double>(field.distance(a));
        ASSERT_LE(std::abs(change), step_length * std::sqrt(static_cast<double>(D)) + 1e-5);
        most = std::max(most, std::abs(change) - step_length);
    }
}

TEST(Field, GrowsNoFasterThanItMay) {
    expect_lipschitz(Field2(filled_around<2>(box<2>({-1, 0.5}, {2, 1}), 0.1f, 3)), 1);
    expect_lipschitz(Field3(filled_around<3>(box<3>({-1, 0.5, 2}, {2, 1, 1}), 0.2f, 3)), 2);
    expect_lipschitz(Field3(filled_around<3>(torus({0, 0, 0}, 2, 1), 0.2f, 3)), 3);
}

TEST(Field, SixteenBitsAreRightToHalfAStep) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        FillOptions options;
        options.store = store;
        FieldData<3> data = filled_around<3>(torus({0, 0, 0}, 2, 1), 0.125f, 3, options);
        const Field3 exact(data);
        float most = 0;
        for (const float distance : data.distance) most = std::max(most, std::abs(distance));
        quantise(data);
        const Field3 rounded(data);
        EXPECT_LT(rounded.bytes(), 0.6 * static_cast<double>(exact.bytes()));
        EXPECT_NEAR(data.step, most / 32767, 1e-6 * data.step);
        Random random(31);
        float worst = 0;
        for (int i = 0; i < 30000; ++i) {
            const Vec3 point = anywhere<3>(random, exact.volume());
            worst = std::max(worst, std::abs(rounded.distance(point) - exact.distance(point)));
        }
        EXPECT_LE(worst, 0.5f * data.step + 2e-7f * most);
        EXPECT_GT(worst, 0.25f * data.step);
        quantise(data);
        EXPECT_EQ(Field3(data).distance({1, 1, 0}), rounded.distance({1, 1, 0}));
    }
    FieldData<2> nothing = filled<2>({[](const DVec<2>&) { return 0.0; }, {}}, {0, 0}, 1, glm::uvec2(3));
    quantise(nothing);
    EXPECT_EQ(Field2(nothing).distance({1, 1.5f}), 0);
    EXPECT_EQ(Field2(nothing).sample({1, 1.5f}).normal, Vec2(1, 0));
}

/// Inside, the interpolated distance is never below that to the planes of a convex solid.
TEST(Field, NothingSolidIsOutsideOfItsBounds) {
    for (const bool quantised : {false, true}) {
        FieldData<3> data = filled_around<3>(turned(box<3>({1, 0, 0}, {2, 1, 0.2}), {1, 2, 3}, {0, 1, 0}), 0.25f, 3);
        if (quantised) quantise(data);
        const Field3 field(data);
        Random random(41);
        int solid = 0;
        for (int i = 0; i < 200000; ++i) {
            const Vec3 point = anywhere<3>(random, field.volume());
            if (field.distance(point) > 0) continue;
            ++solid;
            ASSERT_TRUE(contains(bounds(field), point));
        }
        EXPECT_GT(solid, 100);
    }
}

/// By descent, from inside and outside; and by the closest points of the corners.
TEST(Field, ClosestIsOnTheSurface) {
    const Analytic<3> solid = torus({0, 0, 0}, 2, 1);
    for (const bool stored : {false, true})
        for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
            FillOptions options;
            options.closest_points = stored;
            options.store = store;
            options.band = 1;
            const Field3 field(filled_around<3>(solid, 0.1f, 3, options));
            Random random(53);
            for (int i = 0; i < 3000; ++i) {
                const Vec3 point = anywhere<3>(random, field.volume());
                const Vec3 found = field.closest(point);
                ASSERT_LT(std::abs(solid.distance(DVec<3>(found))), 0.01);
                // Within the error of the interpolation of the closest point, except at the torus' axis and ring, where
                // there are many.
                const double distance = std::abs(solid.distance(DVec<3>(point)));
                ASSERT_LT(length(DVec<3>(found) - DVec<3>(point)), distance + (store == FieldStore::dense ? 0.1 : 0.3));
            }
        }
}

/// With stored closest points, the search finds edges and corners that the interpolation rounds off.
TEST(Field, ClosestFindsEdgesByTheCornersOfCells) {
    const Analytic<3> solid = turned(box<3>({0, 0, 0}, {2, 1, 0.5}), {1, 2, 3}, {0, 1, 0});
    FillOptions options;
    options.closest_points = true;
    const FieldData<3> data = filled_around<3>(solid, 0.1f, 3, options);
    FieldData<3> bare = data;
    bare.closest = {};
    const Field3 stored(data), walking(bare);
    EXPECT_GT(stored.bytes(), 3.9 * static_cast<double>(walking.bytes()));
    Random random(59);
    double stored_error = 0, walking_error = 0;
    int near = 0;
    while (near < 5000) {
        const Vec3 point = anywhere<3>(random, stored.volume());
        const DVec<3> place(point);
        const double distance = solid.distance(place);
        if (std::abs(distance) > 0.2) continue;
        ++near;
        const auto error = [&](const Field3& field) {
            const DVec<3> found(field.closest(point));
            const double off = solid.distance(found), farther = length(found - place) - std::abs(distance);
            return off * off + farther * farther;
        };
        stored_error += error(stored);
        walking_error += error(walking);
        ASSERT_LT(std::abs(solid.distance(DVec<3>(stored.closest(point)))), 0.04);
    }
    EXPECT_LT(stored_error, 0.1 * walking_error);
}

}  // namespace
}  // namespace abut
