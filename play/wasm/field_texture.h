#pragma once

// Distance fields for shaders.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// A field as a texture for abut/field/abut_field.glsl: sixteen floats, and then the texels as floats of 16 bits. The
/// floats are width, height, depth, scale, offset, error, cell, box.min, surface.min and surface.max of
/// abut::FieldTexture. `cell` is the spacing of the texels; 0: that of the field's samples.
ABUT_API abut_code abut_play_field_texture(const abut_field3* field, float cell, abut_buffer* out);

ABUT_C_END
