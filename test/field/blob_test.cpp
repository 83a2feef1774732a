// Saving and loading of fields.

#include "../oracle/seal.hpp"
#include "analytic.hpp"
#include <abut/field/file.hpp>
#include <abut/field/quantise.hpp>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace abut {
namespace {

using namespace oracle;

using Bytes = std::vector<std::byte>;

detail::FieldData<3> small_torus(FieldStore store) {
    FillOptions options;
    options.store = store;
    options.closest_points = true;
    options.band = 1;
    return filled_around<3>(torus({0.5, 0, 0}, 2, 0.75), 0.25f, 2, options);
}

detail::FieldData<2> small_disc() {
    FillOptions options;
    options.lookup = FieldLookup::gradient;
    return filled_around<2>(ball<2>({0.5, 0.25}, 1), 0.25f, 2, options);
}

std::uint64_t hash_of(const Bytes& bytes) {
    std::uint64_t result = 0xcbf29ce484222325u;
    for (const std::byte b : bytes) result = (result ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    return result;
}

template <class T>
void write_at(Bytes& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

template <int D>
ProblemCode code_of(const Bytes& bytes) {
    const Result<Field<D>> result = load_field<D>(bytes);
    EXPECT_FALSE(result);
    if (result) return ProblemCode::cancelled;
    EXPECT_FALSE(result.problem().message.empty());
    EXPECT_EQ(result.problem().message.find('\n'), std::string::npos);
    return result.problem().code;
}

template <int D>
void expect_same(const detail::FieldData<D>& data) {
    const Field<D> field(data);
    const Bytes bytes = save(field);
    const Result<Field<D>> again = load_field<D>(bytes);
    ASSERT_TRUE(again) << again.problem().message;
    EXPECT_EQ(save(*again), bytes);
    EXPECT_EQ(again->bytes(), field.bytes());
    EXPECT_EQ(again->volume(), field.volume());
    EXPECT_EQ(bounds(*again), bounds(field));
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        Vec<D> point;
        for (int a = 0; a < D; ++a) point[a] = random.uniform_float(-4, 4);
        ASSERT_EQ(again->distance(point), field.distance(point));
        ASSERT_EQ(again->sample(point).normal, field.sample(point).normal);
        ASSERT_EQ(again->closest(point), field.closest(point));
    }
}

TEST(FieldBlob, IsTheSameFieldAgain) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        detail::FieldData<3> data = small_torus(store);
        expect_same(data);
        quantise(data);
        expect_same(data);
    }
    expect_same(small_disc());
}

TEST(FieldBlob, HasTheSameBytesOnEveryMachine) {
    // A few exact numbers, so that the test pins only the layout.
    detail::FieldData<2> data;
    data.origin = {-1, 2};
    data.cell = 0.5f;
    data.cells = {2, 1};
    data.surface = {{-0.5f, 2}, {0, 2.5f}};
    data.distance = {1, 0.5f, 0.25f, -0.5f, 0, 3};
    const Bytes bytes = save(Field2(data));
    EXPECT_EQ(bytes.size(), 8u + 8 + 2 + 2 * 16 + 8 + 6 * 8 + 6 * 4 + 8);
    EXPECT_EQ(hash_of(bytes), 11659891956186467268u);
}

TEST(FieldBlob, CutShortOrDamagedIsRefused) {
    const Bytes whole = save(Field3(small_torus(FieldStore::sparse)));
    const Bytes bytes = save(Field2(small_disc()));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        ASSERT_EQ(code_of<2>(cut), ProblemCode::bad_format) << size;
    }
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes damaged = bytes;
        damaged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        ASSERT_EQ(code_of<2>(damaged), ProblemCode::bad_format) << bit;
    }
    Bytes longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_EQ(code_of<2>(longer), ProblemCode::bad_format);
    EXPECT_EQ(code_of<3>(bytes), ProblemCode::bad_format);
    EXPECT_EQ(code_of<2>(whole), ProblemCode::bad_format);
}

TEST(FieldBlob, TellsItsDimension) {
    Bytes bytes = save(Field2(small_disc()));
    EXPECT_EQ(field_dimension(bytes), 2);
    EXPECT_EQ(field_dimension(save(Field3(small_torus(FieldStore::sparse)))), 3);
    EXPECT_EQ(field_dimension(std::span(bytes).first(16)), 2) << "the rest isn't read";
    for (std::size_t size = 0; size < 16; ++size) EXPECT_EQ(field_dimension(std::span(bytes).first(size)), 0) << size;
    for (std::size_t i = 0; i < 16; ++i) {
        Bytes other = bytes;
        other[i] ^= std::byte{4};
        EXPECT_EQ(field_dimension(other), 0) << i;
    }
}

TEST(FieldBlob, WhatItSaysOfItselfIsChecked) {
    const Bytes bytes = save(Field2(small_disc()));
    constexpr std::size_t version = 8, store = 16, lookup = 17, origin = 18, cells = 22, surface = 26, cell = 50,
                          step = 54;
    constexpr std::size_t counts = 58, numbers = counts + 48;
    const auto changed = [&](std::size_t at, auto value) {
        Bytes result = bytes;
        write_at(result, at, value);
        seal(result);
        return code_of<2>(result);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    Bytes same = bytes;
    seal(same);
    EXPECT_EQ(same, bytes);
    EXPECT_EQ(changed(version, 2u), ProblemCode::bad_format);
    EXPECT_EQ(changed(store, std::uint8_t{1}), ProblemCode::bad_format);
    EXPECT_EQ(changed(store, std::uint8_t{7}), ProblemCode::bad_format);
    EXPECT_EQ(changed(lookup, std::uint8_t{9}), ProblemCode::bad_format);
    EXPECT_EQ(changed(origin, nan), ProblemCode::not_finite);
    EXPECT_EQ(changed(origin, 1e38f), ProblemCode::bad_format);
    EXPECT_EQ(changed(cells, 0u), ProblemCode::bad_format);
    EXPECT_EQ(changed(cells, 0xffffffffu), ProblemCode::bad_format);
    EXPECT_EQ(changed(cells, 5u), ProblemCode::bad_format);
    EXPECT_EQ(changed(surface, infinity), ProblemCode::bad_format);
    EXPECT_EQ(changed(surface, 100.0f), ProblemCode::bad_format);
    EXPECT_EQ(changed(step, 1.0f), ProblemCode::bad_format);
    EXPECT_EQ(changed(step, -0.0f), ProblemCode::bad_format);
    EXPECT_EQ(changed(cell, 0.0f), ProblemCode::bad_format);
    EXPECT_EQ(changed(cell, -1.0f), ProblemCode::bad_format);
    EXPECT_EQ(changed(cell, nan), ProblemCode::not_finite);
    for (std::size_t i = 0; i < 6; ++i)
        for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{1000}, std::uint64_t{1} << 40, UINT64_MAX})
            EXPECT_EQ(changed(counts + 8 * i, count), ProblemCode::bad_format);
    EXPECT_EQ(changed(numbers + 12, nan), ProblemCode::not_finite);
    EXPECT_EQ(changed(numbers + 12, -infinity), ProblemCode::not_finite);
}

TEST(FieldBlob, ABrickThatIsntThereIsRefused) {
    const detail::FieldData<3> data = small_torus(FieldStore::sparse);
    Bytes bytes = save(Field3(data));
    constexpr std::size_t bricks = 8 + 8 + 2 + 3 * 16 + 8 + 48;
    write_at(bytes, bricks, static_cast<std::uint32_t>(data.distance.size() / detail::brick_samples<3>));
    seal(bytes);
    EXPECT_EQ(code_of<3>(bytes), ProblemCode::bad_format);
}

}  // namespace
}  // namespace abut
