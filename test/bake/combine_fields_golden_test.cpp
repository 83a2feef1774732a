// Combined fields have equal bits with every compiler, every -O and every SIMD target.

#include "../field/analytic.hpp"
#include <abut/bake/combine_fields.hpp>
#include <abut/field/texture.hpp>

#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace abut;

/// FNV-1a, of 32 bits at once.
class Hash {
public:
    void add(float number) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &number, sizeof bits);
        value_ = (value_ ^ bits) * 1099511628211u;
    }
    template <int D>
    void add(const Field<D>& field) {
        for (const float number : field.data().coarse) add(number);
        for (const float number : field.data().distance) add(number);
        for (int i = 0; i < D; ++i) add(field.data().surface.min[i]);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

TEST(CombineFieldsGolden, FieldsOfFields) {
    Hash hash;
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        const FieldOptions<3> options{.store = store};
        const Field3 a(oracle::filled_around(oracle::ball<3>({-0.4, 0.013, 0}, 0.7), 0.11f, 3, {.store = store}));
        const Field3 b(
            oracle::filled_around(oracle::box<3>({0.4, 0.1, 0.2}, {0.4, 0.25, 0.3}), 0.1f, 3, {.store = store}));
        hash.add(*field_union(a, b, options));
        hash.add(*field_difference(a, b, options));
        hash.add(*field_smooth_union(a, b, 0.3f, options));
        hash.add(*field_offset(a, 0.07f, options));
        hash.add(*field_redistance(*field_intersection(a, b, options), options));
    }
    EXPECT_EQ(hash.value(), 6271383485623693151u);
}

TEST(CombineFieldsGolden, ShadowsAndTextures) {
    Hash hash;
    const Field3 field(oracle::filled_around(oracle::torus({0.2, 0.1, -0.3}, 1, 0.4), 0.11f, 4));
    for (int i = 0; i < 2000; ++i) {
        const Vec3 point(-1.3f + 0.013f * static_cast<float>(i % 200), -1 + 0.1f * static_cast<float>(i / 200),
                         0.37f * static_cast<float>(i % 7) - 1);
        for (const float softness : {0.0f, 0.07f, 0.6f}) hash.add(field.shadow(point, {0.9f, 1.9f, 0.5f}, softness));
        hash.add(field.ambient_occlusion(point, {0.6f, 0.8f, 0}, 0.4f));
    }
    for (const TextureFormat format : {TextureFormat::r8_snorm, TextureFormat::r16f, TextureFormat::r32f}) {
        const auto texture = to_texture(field, format);
        for (std::size_t i = 0; i < texture->bytes.size(); ++i) hash.add(static_cast<float>(texture->bytes[i]));
        hash.add(texture->scale);
        hash.add(texture->offset);
    }
    EXPECT_EQ(hash.value(), 7557076899855811314u);
}

}  // namespace
