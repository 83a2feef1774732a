// A batch of look-ups gives the bits of single ones, with each SIMD target; and single ones equal a reference.

#include "../oracle/simd_targets.hpp"
#include "analytic.hpp"
#include <abut/field/look_up/look_up.hpp>
#include <abut/field/look_up/stencil.hpp>
#include <abut/field/quantise.hpp>

#include <bit>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using namespace oracle;

class FieldBatch : public BySimdTarget {};

/// Points inside and outside, on borders of cells and bricks, and invalid ones.
template <int D>
std::vector<Vec<D>> points_of(const Field<D>& field, std::size_t count, bool with_odd) {
    const Aabb<D> volume = field.volume();
    const auto cell = static_cast<double>(field.cell());
    Random random(count + 7);
    std::vector<Vec<D>> result(count);
    for (Vec<D>& point : result) {
        const std::uint32_t kind = random.below(with_odd ? 12 : 9);
        for (int a = 0; a < D; ++a) {
            const auto low = static_cast<double>(volume.min[a]), high = static_cast<double>(volume.max[a]);
            point[a] = random.uniform_float(low, high);
            if (kind == 6) point[a] = static_cast<float>(low + cell * random.below(field.data().cells[a] + 1));
            if (kind == 7 && a == 0) point[a] = static_cast<float>(low + cell * 4 * random.below(5));
            if (kind == 8) point[a] = random.chance(0.5) ? volume.min[a] : volume.max[a];
            if (kind == 9) point[a] = random.uniform_float(low - 20 * cell, high + 20 * cell);
            if (kind == 10) point[a] = std::nextafter(volume.max[a], 2 * volume.max[a]);
#ifdef NDEBUG
            if (kind == 11 && a == 1) point[a] = std::numeric_limits<float>::quiet_NaN();
#endif
        }
    }
    return result;
}

template <class T>
bool same_bits(const T& a, const T& b) {
    return std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(a) ==
           std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(b);
}

template <int D>
void expect_same(const Field<D>& field) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{7}, std::size_t{16},
                                    std::size_t{63}, std::size_t{64}, std::size_t{65}, std::size_t{3000}})
        for (const bool with_odd : {false, true}) {
            const std::vector<Vec<D>> points = points_of(field, count, with_odd);
            std::vector<float> distances(count + 1, 77);
            std::vector<FieldSample<D>> samples(count + 1);
            samples[count].distance = 77;
            field.distance(std::span<const Vec<D>>(points), std::span(distances).first(count));
            field.sample(std::span<const Vec<D>>(points), std::span(samples).first(count));
            ASSERT_EQ(distances[count], 77);
            ASSERT_EQ(samples[count].distance, 77);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_TRUE(same_bits(distances[i], field.distance(points[i]))) << i;
                const FieldSample<D> one = field.sample(points[i]);
                ASSERT_TRUE(same_bits(samples[i].distance, one.distance)) << i;
                ASSERT_TRUE(same_bits(samples[i].normal, one.normal)) << i;
                if constexpr (D == 3)
                    if (field.data().lookup == FieldLookup::gradient && contains(field.volume(), points[i])) {
                        const FieldSample<3> reference = gradient_sample_reference(field.data(), points[i]);
                        ASSERT_EQ(reference.distance, one.distance) << i;
                        ASSERT_EQ(reference.normal, one.normal) << i;
                    }
                if (field.data().lookup == FieldLookup::linear && contains(field.volume(), points[i])) {
                    const FieldSample<D> reference = linear_sample(field.data(), points[i]);
                    ASSERT_TRUE(same_bits(reference.distance, one.distance)) << i;
                    ASSERT_TRUE(same_bits(reference.normal, one.normal)) << i;
                }
            }
        }
}

template <int D>
void expect_same_of(const Analytic<D>& solid, float cell) {
    for (const FieldLookup lookup : {FieldLookup::linear, FieldLookup::gradient})
        for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
            FillOptions options;
            options.store = store;
            options.lookup = lookup;
            options.band = 1;
            detail::FieldData<D> data = filled_around<D>(solid, cell, 5, options);
            expect_same(Field<D>(data));
            quantise(data);
            expect_same(Field<D>(data));
        }
}

TEST_P(FieldBatch, IsBitByBitTheSame) {
    expect_same_of<2>(ball<2>({1, 2}, 3), 0.25f);
    expect_same_of<2>(box<2>({-1, 0.5}, {2, 1}), 0.1f);
    expect_same_of<3>(torus({0, 0, 0}, 2, 1), 0.25f);
    expect_same_of<3>(turned(box<3>({1, 0, 0}, {2, 1, 0.5}), {1, 2, 3}, {0, 1, 0}), 0.2f);
}

/// A golden value for every compiler at every optimisation level.
TEST(FieldBits, AreTheSameEverywhere) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](float number) { hash = (hash ^ std::bit_cast<std::uint32_t>(number)) * 0x100000001b3u; };
    const Analytic<3> solid = turned(box<3>({1, 0, 0}, {2, 1, 0.5}), {1, 2, 3}, {0, 1, 0});
    for (unsigned kind = 0; kind < 16; ++kind) {
        FillOptions options;
        options.store = kind & 1 ? FieldStore::sparse : FieldStore::dense;
        options.lookup = kind & 2 ? FieldLookup::gradient : FieldLookup::linear;
        options.closest_points = kind & 4;
        options.band = 1;
        detail::FieldData<3> data = filled_around<3>(solid, 0.25f, 3, options);
        if (kind & 8) quantise(data);
        const Field3 field(data);
        for (const Vec3& point : points_of(field, 500, false)) {
            for (const Vec3& place : {point, point * 3.0f}) {
                const FieldSample<3> sample = field.sample(place);
                const Vec3 closest = field.closest(place);
                add(sample.distance);
                for (int a = 0; a < 3; ++a) {
                    add(sample.normal[a]);
                    add(closest[a]);
                }
            }
        }
    }
    EXPECT_EQ(hash, 14807128934385571994u);
}

INSTANTIATE_TEST_SUITE_P(Each, FieldBatch, simd_targets(), simd_target_name);

}  // namespace
}  // namespace abut
