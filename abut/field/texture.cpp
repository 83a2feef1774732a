#include <abut/field/half.hpp>
#include <abut/field/texture.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace abut {
namespace {

/// Steps between the lowest and the highest distance in 8 bits. It leaves capacity for the offset, which is rounded to
/// a step so that 0 is represented exactly.
constexpr double steps_in_8_bits = 252;

template <class T>
void append(std::vector<std::byte>& bytes, T value) {
    const auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <int D>
glm::vec<D, std::uint32_t> texels_along(const Field<D>& field, double cell) {
    const detail::FieldData<D>& data = field.data();
    glm::vec<D, std::uint32_t> result;
    for (int i = 0; i < D; ++i) {
        // A partial last cell is rounded up, except for rounding errors.
        const double cells = static_cast<double>(data.cell) * data.cells[i] / cell;
        result[i] = static_cast<std::uint32_t>(std::min(std::ceil(cells * (1 - 1e-6)), 0x1p31)) + 1;
    }
    return result;
}

/// The distances at all texels, row by row.
template <int D>
std::vector<float> distances(const Field<D>& field, const glm::vec<D, std::uint32_t>& size, double cell) {
    std::size_t rows = size[1];
    if constexpr (D == 3) rows *= size[2];
    std::vector<float> result(size[0] * rows);
    std::vector<Vec<D>> row(size[0]);
    const detail::DVec<D> origin(field.data().origin);
    for (std::size_t r = 0; r < rows; ++r) {
        detail::DVec<D> at(0.0);
        at[1] = static_cast<double>(r % size[1]);
        if constexpr (D == 3) at[2] = static_cast<double>(r / size[1]);
        for (std::size_t i = 0; i < row.size(); ++i) {
            at[0] = static_cast<double>(i);
            row[i] = Vec<D>(origin + cell * at);
        }
        field.distance(row, std::span(result).subspan(r * row.size(), row.size()));
    }
    return result;
}

}  // namespace

template <int D>
Result<FieldTexture<D>> to_texture(const Field<D>& field, const TextureOptions& options) {
    for (const float number : {options.range, options.cell})
        if (!(number >= 0) || !std::isfinite(number))
            return Problem{ProblemCode::bad_argument, "an option of a texture is negative or not finite"};

    FieldTexture<D> texture;
    texture.format = options.format;
    texture.cell = options.cell > 0 ? options.cell : field.cell();
    const double cell = texture.cell;
    const glm::vec<D, std::uint32_t> size = texels_along(field, cell);
    double texels = 1;
    for (int i = 0; i < D; ++i) texels *= size[i];
    if (texels > 0x1p31) return Problem{ProblemCode::too_large, "a texture of more than 2^31 texels"};
    texture.width = size[0];
    texture.height = size[1];
    if constexpr (D == 3) texture.depth = size[2];
    texture.box.min = field.data().origin;
    for (int i = 0; i < D; ++i)
        texture.box.max[i] = static_cast<float>(static_cast<double>(texture.box.min[i]) + cell * (size[i] - 1));

    // An empty box cannot be passed to a shader.
    texture.surface = field.data().surface;
    if (texture.surface == Aabb<D>::empty()) texture.surface = texture.box;

    std::vector<float> values = distances(field, size, cell);
    if (options.range > 0)
        for (float& value : values) value = std::clamp(value, -options.range, options.range);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const double low = *lowest, high = *highest, largest = std::max(std::abs(low), std::abs(high));

    switch (options.format) {
        case TextureFormat::r8_snorm: {
            // If all distances are equal, any step is valid.
            const double step = high > low ? (high - low) / steps_in_8_bits : std::max(largest, 1e-30) / 127;
            const double middle = std::nearbyint(0.5 * (low + high) / step);
            texture.scale = static_cast<float>(127 * step);
            texture.offset = static_cast<float>(middle * step);
            texture.error = static_cast<float>(0.5 * step);
            for (const float value : values)
                append(texture.bytes, static_cast<std::int8_t>(std::clamp(
                                          std::nearbyint(static_cast<double>(value) / step - middle), -127.0, 127.0)));
            break;
        }
        case TextureFormat::r16f: {
            // Dividing by a power of two is exact; the largest distance becomes a number in [0.5, 1).
            int exponent = 0;
            std::frexp(largest, &exponent);
            exponent = std::clamp(exponent, -100, 100);
            texture.scale = static_cast<float>(std::ldexp(1.0, exponent));
            texture.error = static_cast<float>(std::max(largest / 2048, std::ldexp(1.0, exponent - 25)));
            for (const float value : values) append(texture.bytes, detail::half_of(value / texture.scale));
            break;
        }
        case TextureFormat::r32f:
            for (const float value : values) append(texture.bytes, value);
            break;
    }
    return texture;
}

template <int D>
float texel_distance(const FieldTexture<D>& texture, std::size_t texel) {
    detail::enter_library();
    float value = 0;
    const std::byte* from = texture.bytes.data();
    if (texture.format == TextureFormat::r8_snorm) {
        value = std::max(static_cast<float>(static_cast<std::int8_t>(from[texel])) / 127.0f, -1.0f);
    } else if (texture.format == TextureFormat::r16f) {
        std::uint16_t half = 0;
        std::memcpy(&half, from + 2 * texel, sizeof half);
        value = detail::float_of(half);
    } else {
        std::memcpy(&value, from + 4 * texel, sizeof value);
    }
    return texture.scale * value + texture.offset;
}

template Result<FieldTexture<2>> to_texture(const Field<2>&, const TextureOptions&);
template Result<FieldTexture<3>> to_texture(const Field<3>&, const TextureOptions&);
template float texel_distance(const FieldTexture<2>&, std::size_t);
template float texel_distance(const FieldTexture<3>&, std::size_t);

}  // namespace abut
