// Loaded bytes whose numbers are no distances: the load refuses them, or every answer of the field is finite.

#include "../oracle/seal.hpp"
#include "analytic.hpp"
#include <abut/field/file.hpp>
#include <abut/field/quantise.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using namespace oracle;

using Bytes = std::vector<std::byte>;

/// The offsets of the numbers in the bytes of a field.
template <int D>
struct Places {
    static constexpr std::size_t origin = 18, surface = origin + 8, cell = origin + 16 * D, step = cell + 4;
    std::size_t coarse, distance, steps, closest;

    explicit Places(const FieldData<D>& data) {
        coarse = step + 4 + 6 * 8 + 4 * data.brick.size();
        distance = coarse + 4 * data.coarse.size();
        steps = distance + 4 * data.distance.size();
        closest = steps + 2 * data.steps.size() + 2 * data.direction.size();
    }
};

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

template <int D>
Field<D> solid(FieldStore store, FieldLookup lookup, bool quantised, bool closest_points) {
    FillOptions options;
    options.store = store;
    options.lookup = lookup;
    options.closest_points = closest_points;
    options.band = 1;
    FieldData<D> data = filled_around<D>(ball<D>(DVec<D>(0.125), 1), 0.5f, 2, options);
    if (quantised) quantise(data);
    return Field<D>(std::move(data));
}
template <int D, class Visit>
void each_kind(Visit visit) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse})
        for (const FieldLookup lookup : {FieldLookup::linear, FieldLookup::gradient})
            for (const bool quantised : {false, true})
                for (const bool closest_points : {false, true})
                    visit(solid<D>(store, lookup, quantised, closest_points));
}

template <int D>
void expect_refused(const Bytes& bytes, ProblemCode code, std::size_t index) {
    const Result<Field<D>> result = load_field<D>(bytes);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.problem().code, code);
    EXPECT_EQ(result.problem().index, index);
    EXPECT_FALSE(result.problem().message.empty());
    EXPECT_EQ(result.problem().message.find('\n'), std::string::npos);
}

/// A sample of 1e38 once loaded, and `closest` descended from it to NaN.
template <int D>
void expect_named() {
    each_kind<D>([](const Field<D>& field) {
        const FieldData<D>& data = field.data();
        const Places<D> at(data);
        const Bytes bytes = save(field);
        const auto expect = [&](std::size_t place, auto value, ProblemCode code, std::size_t index) {
            Bytes changed = bytes;
            put(changed, place, value);
            seal(changed);
            expect_refused<D>(changed, code, index);
        };
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const float none : {1e38f, -1e31f, 1e18f}) {
            if (!data.coarse.empty()) expect(at.coarse + 4 * 2, none, ProblemCode::bad_format, 2);
            if (!data.distance.empty()) expect(at.distance + 4 * 5, none, ProblemCode::bad_format, 5);
        }
        if (!data.coarse.empty()) expect(at.coarse + 4 * 2, nan, ProblemCode::not_finite, 2);
        if (!data.distance.empty()) expect(at.distance + 4 * 5, nan, ProblemCode::not_finite, 5);
        if (!data.steps.empty()) expect(at.step, 1e18f, ProblemCode::bad_format, 0);
        if (!data.closest.empty()) {
            expect(at.closest + 4 * (3 * D + 1), 1e38f, ProblemCode::bad_format, 3);
            expect(at.closest + 4 * (3 * D + 1), nan, ProblemCode::not_finite, 3);
        }
        expect(at.surface, -1e38f, ProblemCode::bad_format, 0);
        expect(at.surface + 4, 1e38f, ProblemCode::bad_format, 0);
        // Samples of 16 bits are too large only where their step is.
        if (data.steps.empty()) return;
        Bytes changed = bytes;
        for (std::size_t i = 0; i < data.steps.size(); ++i) put(changed, at.steps + 2 * i, std::int16_t{1});
        put(changed, at.step, 0x1p58f);
        seal(changed);
        EXPECT_TRUE(load_field<D>(changed));
        put(changed, at.steps + 2 * 6, std::int16_t{-32768});
        seal(changed);
        expect_refused<D>(changed, ProblemCode::bad_format, 6);
    });
}

TEST(FieldBlobNumbers, WhatIsNoDistanceIsNamed) {
    expect_named<2>();
    expect_named<3>();
}

template <int D>
bool is_unit(const Vec<D>& v) {
    return std::abs(length(DVec<D>(v)) - 1) < 1e-5;
}

template <int D>
bool answers_are_finite(const Field<D>& field, Random& random) {
    const Aabb<D> volume = field.volume();
    bool result = true;
    for (int i = 0; i < 24; ++i) {
        Vec<D> point, light;
        for (int a = 0; a < D; ++a) {
            const double low = static_cast<double>(volume.min[a]), high = static_cast<double>(volume.max[a]);
            const double beyond = i < 12 ? 0 : random.power_of_two(-100, 127);
            point[a] = random.uniform_float(low - beyond, high + beyond);
            light[a] = random.uniform_float(low - beyond, high + beyond);
        }
        const FieldSample<D> here = field.sample(point);
        result = result && std::isfinite(here.distance) && is_unit<D>(here.normal);
        FieldSample<D> batch;
        field.sample(std::span(&point, 1), std::span(&batch, 1));
        result = result && std::isfinite(batch.distance) && is_unit<D>(batch.normal);
        result = result && std::isfinite(field.distance(point)) && is_finite<D>(field.closest(point));
        const float shadow = field.shadow(point, light, 0.25f);
        const float open = field.ambient_occlusion(point, here.normal, random.uniform_float(0, 4));
        result = result && shadow >= 0 && shadow <= 1 && open >= 0 && open <= 1;
    }
    return result;
}

/// Replaces some of the numbers by others, of a few magnitudes or of all. One in eleven of the loaded fields once had
/// answers with NaN or normals of length 0.
template <int D>
void expect_refused_or_finite(std::uint64_t seed) {
    Random random(seed);
    int loaded = 0, count = 0, wrong = 0;
    for (int round = 0; round < 60; ++round)
        each_kind<D>([&](const Field<D>& field) {
            const FieldData<D>& data = field.data();
            const Places<D> at(data);
            Bytes bytes = save(field);
            const int least = random.chance(0.5) ? -149 : -20, most = random.chance(0.3) ? 127 : 20;
            const auto any = [&] {
                const double size = random.chance(0.1) ? 0 : random.power_of_two(least, most);
                return static_cast<float>(random.chance(0.5) ? size : -size);
            };
            const auto change = [&](std::size_t first, std::size_t numbers) {
                const double share = random.chance(0.3) ? 1 : random.unit() * random.unit();
                if (!random.chance(0.5)) return;
                for (std::size_t i = 0; i < numbers; ++i)
                    if (random.chance(share)) put(bytes, first + 4 * i, any());
            };
            change(at.coarse, data.coarse.size());
            change(at.distance, data.distance.size());
            change(at.closest, D * data.closest.size());
            if (random.chance(0.2)) put(bytes, at.cell, std::abs(any()));
            if (!data.steps.empty() && random.chance(0.5)) put(bytes, at.step, std::abs(any()));
            if (random.chance(0.2)) put(bytes, at.origin + 16 * random.below(D), any());
            for (std::size_t i = 0; i < data.steps.size() && random.chance(0.9); ++i)
                put(bytes, at.steps + 2 * i, static_cast<std::int16_t>(random.bits()));
            seal(bytes);
            ++count;
            const Result<Field<D>> again = load_field<D>(bytes);
            if (!again) return;
            ++loaded;
            if (answers_are_finite<D>(*again, random) || ++wrong > 5) return;
            ADD_FAILURE() << "seed " << seed << ", field " << count;
        });
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(loaded, count / 4);
    EXPECT_LT(loaded, count * 4 / 5);
}

TEST(FieldBlobNumbers, WhatIsLoadedHasFiniteAnswers) {
    expect_refused_or_finite<2>(31);
    expect_refused_or_finite<3>(32);
}

}  // namespace
}  // namespace abut
