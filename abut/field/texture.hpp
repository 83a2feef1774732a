#pragma once

// A field as a texture, for shaders: abut/field/abut_field.glsl looks things up in it.

#include <abut/field/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// One number a texel, in the formats that OpenGL, OpenGL ES 3.0 and WebGL 2 have.
enum class TextureFormat : std::uint8_t {
    r8_snorm,  ///< GL_R8_SNORM, GL_RED, GL_BYTE: the hardware filters it
    r16f,      ///< GL_R16F, GL_RED, GL_HALF_FLOAT: the hardware filters it
    r32f,      ///< GL_R32F, GL_RED, GL_FLOAT: WebGL 2 filters it only with OES_texture_float_linear
};

struct TextureOptions {
    TextureFormat format = TextureFormat::r16f;

    /// Distances beyond it count as it, inside as outside: with 8 bits a smaller one makes finer steps. They stay lower
    /// bounds. 0: none is cut off.
    float range = 0;

    /// How far texels are apart; 0: as the field's samples are.
    float cell = 0;
};

/// The distances at the points box.min + cell * (column, row, layer), the columns fastest, without gaps between rows
/// (GL_UNPACK_ALIGNMENT 1), in the machine's order of bytes.
template <int D>
struct FieldTexture {
    TextureFormat format = TextureFormat::r16f;
    std::uint32_t width = 0, height = 0;
    std::uint32_t depth = 1;  ///< 1 in the plane
    std::vector<std::byte> bytes;

    /// A distance is scale * texel + offset, where texels of r8_snorm are in [-1, 1] as shaders see them.
    float scale = 1, offset = 0;
    /// What no texel is farther off than, but for the rounding of a few floats. With 8 bits this is half a step; with
    /// 16 bits a texel is off by up to a 2048th of its distance, so that those at the surface are much finer; with 32
    /// bits it is 0.
    float error = 0;

    Aabb<D> box{};  ///< from the first texel to the last, at their middles
    float cell = 1;
    Aabb<D> surface{};  ///< around all places where the distance is 0; where it is so nowhere, the same as `box`
};

/// A Problem where a number of the options is negative or not finite (`bad_argument`), or there would be more than
/// 2^31 texels (`too_large`). What a graphics card takes is less: 2048 texels along an axis of space mostly, and 256 is
/// all that WebGL 2 promises.
template <int D>
Result<FieldTexture<D>> to_texture(const Field<D>& field, const TextureOptions& options = {});
template <int D>
Result<FieldTexture<D>> to_texture(const Field<D>& field, TextureFormat format) {
    return to_texture(field, TextureOptions{.format = format});
}

/// The distance of the texel with this number, as a shader sees it.
template <int D>
float texel_distance(const FieldTexture<D>& texture, std::size_t texel);

}  // namespace abut
