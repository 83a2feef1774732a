// Distance fields for shaders.

#include "field_texture.h"

#include <abut/c/detail/handles.hpp>
#include <abut/field/texture.hpp>

#include <array>
#include <span>

using namespace abut::detail;

abut_code abut_play_field_texture(const abut_field3* field, float cell, abut_buffer* out) {
    return entry({present(field, "field"), not_below_zero(cell, "cell"), present(out, "out")}, [&] {
        const auto texture = abut::to_texture(field->field, abut::TextureOptions{.cell = cell});
        if (!texture) return report(texture.problem());
        const abut::Vec3 &origin = texture->box.min, &low = texture->surface.min, &high = texture->surface.max;
        const std::array header{static_cast<float>(texture->width),
                                static_cast<float>(texture->height),
                                static_cast<float>(texture->depth),
                                texture->scale,
                                texture->offset,
                                texture->error,
                                texture->cell,
                                origin.x,
                                origin.y,
                                origin.z,
                                low.x,
                                low.y,
                                low.z,
                                high.x,
                                high.y,
                                high.z};
        const auto bytes = std::as_bytes(std::span(header));
        out->bytes.assign(bytes.begin(), bytes.end());
        out->bytes.insert(out->bytes.end(), texture->bytes.begin(), texture->bytes.end());
        return ABUT_OK;
    });
}
