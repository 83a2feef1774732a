// Distances, normals and soft shadows of a signed distance field in a shader, from the texture that `to_texture` of
// abut/field/texture.hpp makes. For GLSL ES 3.00 (WebGL 2, OpenGL ES 3.0) and GLSL 3.30 or later; put it after your
// #version line.
//
//   #define ABUT_2D             before it: a 2D field; all positions and normals are vec2
//   #define ABUT_FIELD_FILTER   before it: the hardware interpolates. The texture must have GL_LINEAR. It takes one
//                               fetch instead of eight; most cards round the position in a cell to 1/256. Not for
//                               r32f in WebGL 2 without OES_texture_float_linear.
//   #define ABUT_SHADOW_STEPS n before it: maximum number of steps of a shadow ray (default 256); obstacles behind
//                               them cast no shadow
//
// The texture has no mipmaps: set GL_TEXTURE_MIN_FILTER to GL_NEAREST or GL_LINEAR. Set the uniforms from the
// FieldTexture:
//   abut_texture            the texture's unit
//   abut_origin             box.min
//   abut_cell               cell
//   abut_decode             scale, offset
//   abut_surface_min, _max  surface.min, surface.max
//
// All positions and directions are in the frame in which the field was baked.

#ifndef ABUT_SHADOW_STEPS
#define ABUT_SHADOW_STEPS 256
#endif

#ifdef GL_ES
precision highp float;
precision highp int;
#endif

#ifdef ABUT_2D
#define ABUT_VEC vec2
#define ABUT_IVEC ivec2
uniform highp sampler2D abut_texture;
#else
#define ABUT_VEC vec3
#define ABUT_IVEC ivec3
uniform highp sampler3D abut_texture;
#endif
uniform highp ABUT_VEC abut_origin;
uniform highp float abut_cell;
uniform highp vec2 abut_decode;
uniform highp ABUT_VEC abut_surface_min;
uniform highp ABUT_VEC abut_surface_max;

// --- internal --------------------------------------------------------------------------------------------------------

float abut_texel(ABUT_IVEC at) {
    return abut_decode.x * texelFetch(abut_texture, at, 0).r + abut_decode.y;
}

// The position in cells, clamped to the volume.
ABUT_VEC abut_place(ABUT_VEC p) {
    return clamp((p - abut_origin) / abut_cell, ABUT_VEC(0.0), ABUT_VEC(textureSize(abut_texture, 0) - 1));
}
ABUT_IVEC abut_low(ABUT_VEC place) {
    return min(ABUT_IVEC(place), textureSize(abut_texture, 0) - 2);
}

#ifdef ABUT_2D
float abut_fetched(ABUT_VEC place) {
    ABUT_IVEC low = abut_low(place);
    ABUT_VEC t = place - ABUT_VEC(low);
    return mix(mix(abut_texel(low), abut_texel(low + ivec2(1, 0)), t.x),
               mix(abut_texel(low + ivec2(0, 1)), abut_texel(low + ivec2(1, 1)), t.x), t.y);
}
// The gradient per cell.
ABUT_VEC abut_slope(ABUT_VEC place) {
    ABUT_IVEC low = abut_low(place);
    ABUT_VEC t = place - ABUT_VEC(low);
    float a = abut_texel(low), b = abut_texel(low + ivec2(1, 0));
    float c = abut_texel(low + ivec2(0, 1)), d = abut_texel(low + ivec2(1, 1));
    return vec2(mix(b - a, d - c, t.y), mix(c, d, t.x) - mix(a, b, t.x));
}
#else
// The distances at four corners of a cell, in one layer.
vec4 abut_layer(ABUT_IVEC low) {
    return vec4(abut_texel(low), abut_texel(low + ivec3(1, 0, 0)), abut_texel(low + ivec3(0, 1, 0)),
                abut_texel(low + ivec3(1, 1, 0)));
}
float abut_fetched(ABUT_VEC place) {
    ABUT_IVEC low = abut_low(place);
    ABUT_VEC t = place - ABUT_VEC(low);
    vec4 layer = mix(abut_layer(low), abut_layer(low + ivec3(0, 0, 1)), t.z);
    vec2 row = mix(layer.xy, layer.zw, t.y);
    return mix(row.x, row.y, t.x);
}
// The gradient per cell.
ABUT_VEC abut_slope(ABUT_VEC place) {
    ABUT_IVEC low = abut_low(place);
    ABUT_VEC t = place - ABUT_VEC(low);
    vec4 lower = abut_layer(low), upper = abut_layer(low + ivec3(0, 0, 1)), layer = mix(lower, upper, t.z);
    vec4 rise = upper - lower;
    return vec3(mix(layer.y - layer.x, layer.w - layer.z, t.y), mix(layer.z - layer.x, layer.w - layer.y, t.x),
                mix(mix(rise.x, rise.y, t.x), mix(rise.z, rise.w, t.x), t.y));
}
#endif

float abut_within(ABUT_VEC place) {
#ifdef ABUT_FIELD_FILTER
    ABUT_VEC at = (place + 0.5) / ABUT_VEC(textureSize(abut_texture, 0));
    return abut_decode.x * texture(abut_texture, at).r + abut_decode.y;
#else
    return abut_fetched(place);
#endif
}

// --- public functions ------------------------------------------------------------------------------------------------

// The signed distance. Outside the volume it is a lower bound, up to interpolation.
float abut_distance(ABUT_VEC p) {
    ABUT_VEC place = abut_place(p);
    float within = abut_within(place);
    float away = length(p - (abut_origin + abut_cell * place));
    if (away <= 1e-5 * abut_cell) return within;
    // The surface lies behind the plane through the volume's nearest point, and in its bounding box. A solid that the
    // volume cuts ends at its border.
    ABUT_VEC high = abut_origin + abut_cell * ABUT_VEC(textureSize(abut_texture, 0) - 1);
    bool cut = any(lessThan(abut_surface_min, abut_origin)) || any(greaterThan(abut_surface_max, high));
    float free = within < 0.0 && cut ? 0.0 : max(abs(within) - abut_cell, 0.0);
    float to_box = length(p - clamp(p, abut_surface_min, abut_surface_max));
    return (within < 0.0 && !cut ? -1.0 : 1.0) * max(length(vec2(away, free)), to_box);
}

// The unit direction of the steepest increase; outside the volume, that of its nearest point.
ABUT_VEC abut_normal(ABUT_VEC p) {
    ABUT_VEC slope = abut_slope(abut_place(p));
    float size = length(slope);
    ABUT_VEC first = ABUT_VEC(0.0);
    first.x = 1.0;
    return size > 1e-3 * abut_cell ? slope / size : first;
}

// The share of a light that arrives at a point, in [0, 1], as Field::shadow computes it. `softness` is the radius of the
// light divided by its distance; 0 makes hard shadows.
float abut_shadow(ABUT_VEC p, ABUT_VEC light, float softness) {
    ABUT_VEC to_light = light - p;
    float light_distance = length(to_light);
    float here = abut_distance(p);
    if (here < -abut_cell) return 0.0;
    if (light_distance == 0.0) return here > 0.0 ? 1.0 : 0.0;
    float at_light = abut_distance(light);
    if (at_light <= 0.0) return 0.0;

    // The minimum squared slope, clearance / distance along the ray: by parabolas in 1 / distance through the last three
    // samples, bounded below by the free balls of the last two (Aaltonen). x = 1 / distance, y = squared slope,
    // z = distance.
    float minimum = at_light / light_distance * (at_light / light_distance);
    vec3 first = vec3(0.0), second = vec3(0.0), last = vec3(0.0);
    ABUT_VEC direction = to_light / light_distance;
    float along = abut_cell;
    for (int i = 0; i < ABUT_SHADOW_STEPS; ++i) {
        if (along >= light_distance) break;
        float clear = abut_distance(p + direction * along);
        if (clear <= 0.0) return 0.0;
        first = second;
        second = last;
        float slope = clear / along;
        last = vec3(1.0 / along, slope * slope, along);
        minimum = min(minimum, last.y);
        if (i >= 2) {
            float after = last.z * (last.y - 1.0), before = second.z * (second.y - 1.0);
            float bend = (before - after) / (second.x - last.x), x = 0.5 * (bend * second.x - before);
            float rise = (last.y - second.y) / (last.x - second.x);
            float curve = (rise - (second.y - first.y) / (second.x - first.x)) / (last.x - first.x);
            float lowest = 0.5 * (second.x + last.x - rise / curve);
            if (bend > 0.0 && x > bend * last.x && x < bend * second.x && curve > 0.0 && lowest > last.x &&
                lowest < first.x) {
                float square = last.y + (lowest - last.x) * (rise + (lowest - second.x) * curve);
                float candidate = max(square, 1.0 - x * x / bend);
                if (candidate > 0.0) minimum = min(minimum, candidate);
            }
        }
        along += max(0.7 * clear, 0.5 * abut_cell);
    }
    if (minimum >= softness * softness) return 1.0;
    float share = sqrt(minimum) / softness;
    return share * share * (3.0 - 2.0 * share);
}
