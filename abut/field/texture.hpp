#pragma once

// A field as a texture for shaders; abut/field/abut_field.glsl reads it.

#include <abut/field/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Single-channel formats of OpenGL, OpenGL ES 3.0 and WebGL 2.
enum class TextureFormat : std::uint8_t {
    r8_snorm,  ///< GL_R8_SNORM, GL_RED, GL_BYTE: the hardware filters it
    r16f,      ///< GL_R16F, GL_RED, GL_HALF_FLOAT: the hardware filters it
    r32f,      ///< GL_R32F, GL_RED, GL_FLOAT: WebGL 2 filters it only with OES_texture_float_linear
};

struct TextureOptions {
    TextureFormat format = TextureFormat::r16f;

    /// Distances are clamped to this magnitude. With 8 bits a smaller range has finer steps. Clamped distances are
    /// lower bounds. 0: no clamping.
    float range = 0;

    /// The spacing of texels; 0: that of the field's samples.
    float cell = 0;
};

/// The distances at the points box.min + cell * (column, row, layer), columns fastest, without padding between rows
/// (GL_UNPACK_ALIGNMENT 1), in the machine's byte order.
template <int D>
struct FieldTexture {
    TextureFormat format = TextureFormat::r16f;
    std::uint32_t width = 0, height = 0;
    std::uint32_t depth = 1;  ///< 1 in 2D
    std::vector<std::byte> bytes;

    /// distance = scale * texel + offset, where texels of r8_snorm are in [-1, 1], as in a shader.
    float scale = 1, offset = 0;
    /// Maximum error of a texel, except for the rounding of a few floats. With 8 bits it is half a step. With 16 bits
    /// an error is up to a 2048th of the distance, so it is much smaller near the surface. With 32 bits it is 0.
    float error = 0;

    Aabb<D> box{};  ///< from the center of the first texel to that of the last
    float cell = 1;
    Aabb<D> surface{};  ///< bounds of the zero level set; equal to `box` if it is empty
};

/// Converts a field to a texture. A Problem if an option is negative or not finite (`bad_argument`), or if there would
/// be more than 2^31 texels (`too_large`). Graphics cards have lower limits: mostly 2048 texels along an axis in 3D,
/// and WebGL 2 guarantees only 256.
template <int D>
Result<FieldTexture<D>> to_texture(const Field<D>& field, const TextureOptions& options = {});
template <int D>
Result<FieldTexture<D>> to_texture(const Field<D>& field, TextureFormat format) {
    return to_texture(field, TextureOptions{.format = format});
}

/// The distance of a texel as a shader reads it.
template <int D>
float texel_distance(const FieldTexture<D>& texture, std::size_t texel);

}  // namespace abut
