// Looking up distances: against the same told plainly in long doubles, and against the solids themselves.

#include "analytic.hpp"
#include <abut/field/field.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut {
namespace {

using namespace oracle;

/// Linear along each axis, from a dense field's samples, as a textbook has it.
template <int D>
long double plainly(const FieldData<D>& data, const Vec<D>& point) {
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
void expect_plain(const Analytic<D>& solid, float cell) {
    const Field<D> field(filled_around<D>(solid, cell, 3));
    const Aabb<D> volume = field.volume();
    float size = cell;
    for (int a = 0; a < D; ++a)
        size = std::max({size, std::abs(volume.min[a]), std::abs(volume.max[a]), volume.max[a] - volume.min[a]});
    Random random(71);
    for (int i = 0; i < 20000; ++i) {
        const Vec<D> point = anywhere<D>(random, volume);
        const long double right = plainly(field.data(), point);
        ASSERT_NEAR(static_cast<double>(field.distance(point)), static_cast<double>(right),
                    static_cast<double>(size) * 4e-7);
        const FieldSample<D> sample = field.sample(point);
        ASSERT_EQ(sample.distance, field.distance(point));
        ASSERT_NEAR(length(DVec<D>(sample.normal)), 1, 1e-6);
    }
}

TEST(Field, IsLinearBetweenSamples) {
    expect_plain<2>(ball<2>({1, 2}, 3), 0.25f);
    expect_plain<2>(box<2>({-1, 0.5}, {2, 1}), 0.1f);
    expect_plain<3>(ball<3>({1, 2, -3}, 3), 0.25f);
    expect_plain<3>(box<3>({100, 0.5, 7}, {2, 1, 3}), 0.1f);
    expect_plain<3>(torus({0, 0, 0}, 2e-3, 1e-3), 2e-4f);
    expect_plain<3>(torus({0, 0, 0}, 2e4, 1e4), 2e3f);
}

}  // namespace
}  // namespace abut
