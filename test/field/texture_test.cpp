#include "../oracle/random.hpp"
#include "analytic.hpp"
#include <abut/field/half.hpp>
#include <abut/field/texture.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace {

using namespace abut;
using namespace abut::detail;

Field3 ball_field(float cell = 0.1f) {
    return Field3(oracle::filled_around(oracle::ball<3>({0.3, -0.2, 0.1}, 1), cell, 4));
}

template <int D>
Vec<D> place(const FieldTexture<D>& texture, std::size_t texel) {
    DVec<D> at(0.0);
    at[0] = static_cast<double>(texel % texture.width);
    at[1] = static_cast<double>(texel / texture.width % texture.height);
    if constexpr (D == 3) at[2] = static_cast<double>(texel / texture.width / texture.height);
    return Vec<D>(DVec<D>(texture.box.min) + static_cast<double>(texture.cell) * at);
}

template <int D>
void check_errors(const Field<D>& field, const TextureOptions& options) {
    const auto texture = to_texture(field, options);
    ASSERT_TRUE(texture);
    const std::size_t texels = std::size_t{texture->width} * texture->height * texture->depth;
    const std::size_t size = options.format == TextureFormat::r8_snorm ? 1
                             : options.format == TextureFormat::r16f   ? 2
                                                                       : 4;
    ASSERT_EQ(texture->bytes.size(), texels * size);
    float most = 0;
    for (std::size_t i = 0; i < texels; ++i) {
        float right = field.distance(place(*texture, i));
        if (options.range > 0) right = std::clamp(right, -options.range, options.range);
        const float error = std::abs(texel_distance(*texture, i) - right);
        const float bound = options.format == TextureFormat::r16f
                                ? std::max(std::abs(right) / 2048, texture->scale * 0x1p-25f)
                                : texture->error;
        ASSERT_LE(error, bound * 1.0001f + 4e-7f) << "texel " << i << " of " << right;
        most = std::max(most, error);
    }
    EXPECT_LE(most, texture->error * 1.0001f + 4e-7f);
    if (options.format != TextureFormat::r32f) {
        EXPECT_GT(most, 0.25f * texture->error) << "a bound that says something";
    }
}

TEST(FieldTexture, HalvesAreTheNearest) {
    // All of them, back and forth.
    for (std::uint32_t half = 0; half < 0x7c00u; ++half) {
        const float value = float_of(static_cast<std::uint16_t>(half));
        ASSERT_EQ(half_of(value), half);
        ASSERT_EQ(half_of(-value), half | 0x8000u);
        // A value between two steps goes to the nearer one, and from the middle to the even one.
        const float next = half + 1 < 0x7c00u ? float_of(static_cast<std::uint16_t>(half + 1)) : 65536.0f;
        const float middle = 0.5f * (value + next);
        ASSERT_EQ(half_of(middle), half % 2 == 0 ? half : half + 1);
        ASSERT_EQ(half_of(std::nextafter(middle, 0.0f)), half);
        ASSERT_EQ(half_of(std::nextafter(middle, 1e30f)), half + 1);
    }
    EXPECT_EQ(float_of(0x3c00), 1.0f);
    EXPECT_EQ(float_of(0x0001), 0x1p-24f);
    EXPECT_EQ(float_of(0xfbff), -65504.0f);
    EXPECT_EQ(half_of(1e30f), 0x7c00u);
    EXPECT_EQ(half_of(0x1p-26f), 0u);
}

TEST(FieldTexture, TexelsAreOffByLessThanTheBound) {
    const Field3 field = ball_field();
    const Field2 flat(oracle::filled_around(oracle::box<2>({5, 7}, {2, 1}), 0.13f, 3));
    for (const TextureFormat format : {TextureFormat::r8_snorm, TextureFormat::r16f, TextureFormat::r32f})
        for (const float range : {0.0f, 0.3f})
            for (const float cell : {0.0f, 0.07f}) {
                check_errors(field, {.format = format, .range = range, .cell = cell});
                check_errors(flat, {.format = format, .range = range, .cell = cell});
            }
}

TEST(FieldTexture, NothingThatIsInsideGetsOut) {
    // A texel has the wrong sign only where the distance is about 0.
    const Field3 field = ball_field();
    for (const TextureFormat format : {TextureFormat::r8_snorm, TextureFormat::r16f}) {
        const auto texture = to_texture(field, format);
        ASSERT_TRUE(texture);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < std::size_t{texture->width} * texture->height * texture->depth; ++i) {
            const float right = field.distance(place(*texture, i));
            inside += right < 0;
            EXPECT_GE(right * texel_distance(*texture, i), -0x1p-20f) << "or the same sign";
        }
        EXPECT_GT(inside, 1000u);
    }
}

TEST(FieldTexture, CoversTheVolume) {
    const Field3 field = ball_field();
    for (const float cell : {0.0f, 0.03f, 0.17f, 0.1f}) {
        const auto texture = to_texture(field, {.cell = cell});
        ASSERT_TRUE(texture);
        const Aabb3 volume = field.volume();
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(texture->box.min[i], volume.min[i]);
            EXPECT_GE(texture->box.max[i], volume.max[i] - 1e-5f);
            EXPECT_LT(texture->box.max[i], volume.max[i] + texture->cell);
        }
    }
    EXPECT_EQ(to_texture(field)->width, field.data().cells.x + 1);
    EXPECT_EQ(to_texture(Field2(oracle::filled_around(oracle::ball<2>({0, 0}, 1), 0.1f, 3)))->depth, 1u);
}

TEST(FieldTexture, TheSameEverywhere) {
    FieldData<2> data;
    data.cells = {1, 1};
    data.surface = {{0, 0}, {1, 1}};
    data.distance = {2, 2, 2, 2};
    const Field2 field(data);
    const auto eight = to_texture(field, TextureFormat::r8_snorm), sixteen = to_texture(field, TextureFormat::r16f);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(texel_distance(*eight, i), 2, 1e-5);
        EXPECT_EQ(texel_distance(*sixteen, i), 2);
    }
    FieldData<2> free = data;
    free.surface = Aabb2::empty();
    const auto nothing = to_texture(Field2(free));
    EXPECT_EQ(nothing->surface, nothing->box);
}

TEST(FieldTexture, BadOptionsAreNamed) {
    const Field3 field = ball_field();
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const float bad : {-1.0f, nan, infinite}) {
        EXPECT_EQ(to_texture(field, {.range = bad}).problem().code, ProblemCode::bad_argument);
        EXPECT_EQ(to_texture(field, {.cell = bad}).problem().code, ProblemCode::bad_argument);
    }
    EXPECT_EQ(to_texture(field, {.cell = 1e-5f}).problem().code, ProblemCode::too_large);
    EXPECT_EQ(to_texture(field, {.cell = 1e-30f}).problem().code, ProblemCode::too_large);
}

}  // namespace
