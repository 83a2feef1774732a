#pragma once

// Signed distance fields: sampled once, evaluated anywhere.

#include <abut/c/shape.h>

ABUT_C_BEGIN

/// A signed distance field of the plane. Immutable.
typedef struct abut_field2 abut_field2;

/// A signed distance field of space. Immutable.
typedef struct abut_field3 abut_field3;

/// How a field is baked.
typedef struct abut_field_options {
    float cell;                ///< the side of a cell; 0: a 64th of the longest side of the bounding box; by default 0
    float padding;             ///< from the bounding box to the border of the volume, in cells; by default 3
    float band;                ///< half the width of the band that a sparse field stores, in cells; by default 3
    abut_flag dense;           ///< stores all samples, and not only those near the surface; by default 0
    abut_flag gradients;       ///< edges stay sharp, for more memory and time; by default 0
    abut_flag quantised;       ///< stores samples in 16 bits; by default 0
    abut_flag closest_points;  ///< stores the closest point of each sample as well; by default 0
} abut_field_options;

/// A signed distance and the direction of its steepest increase, a unit vector.
typedef struct abut_field_sample2 {
    float distance;
    abut_vec2 normal;
} abut_field_sample2;

/// A signed distance and the direction of its steepest increase, a unit vector.
typedef struct abut_field_sample3 {
    float distance;
    abut_vec3 normal;
} abut_field_sample3;

/// Writes the defaults.
ABUT_API abut_code abut_field_options_default(abut_field_options* out);

/// Bakes the field of a shape with a finite bounding box. A mesh is a surface, inside where its winding number says so.
ABUT_API abut_code abut_field2_bake(const abut_shape2* shape, ABUT_OPTIONAL const abut_field_options* options,
                                    abut_field2** out);
ABUT_API abut_code abut_field3_bake(const abut_shape3* shape, ABUT_OPTIONAL const abut_field_options* options,
                                    abut_field3** out);

/// Bakes the field of a region in the plane. Ring k has the points from ends[k - 1] (0 for k = 0) up to ends[k]: the
/// first is the outline, the others are holes.
ABUT_API abut_code abut_field2_bake_outline(ABUT_ARRAY(point_count) const abut_vec2* points, uint32_t stride,
                                            uint32_t point_count, ABUT_ARRAY(ring_count) const uint32_t* ends,
                                            uint32_t ring_count, ABUT_OPTIONAL const abut_field_options* options,
                                            abut_field2** out);

/// Frees a field.
ABUT_API void abut_field2_release(ABUT_OPTIONAL abut_field2* field);
ABUT_API void abut_field3_release(ABUT_OPTIONAL abut_field3* field);

/// The signed distance at a point.
ABUT_API abut_code abut_field2_distance(const abut_field2* field, abut_vec2 point, float* out);
ABUT_API abut_code abut_field3_distance(const abut_field3* field, abut_vec3 point, float* out);

/// The signed distance and its direction at a point.
ABUT_API abut_code abut_field2_sample(const abut_field2* field, abut_vec2 point, abut_field_sample2* out);
ABUT_API abut_code abut_field3_sample(const abut_field3* field, abut_vec3 point, abut_field_sample3* out);

/// A closest point of the surface.
ABUT_API abut_code abut_field2_closest(const abut_field2* field, abut_vec2 point, abut_vec2* out);
ABUT_API abut_code abut_field3_closest(const abut_field3* field, abut_vec3 point, abut_vec3* out);

/// The share of a light that arrives at a point, in [0, 1]. `softness` is the light's radius divided by its distance.
ABUT_API abut_code abut_field2_shadow(const abut_field2* field, abut_vec2 point, abut_vec2 light, float softness,
                                      float* out);
ABUT_API abut_code abut_field3_shadow(const abut_field3* field, abut_vec3 point, abut_vec3 light, float softness,
                                      float* out);

/// The openness at a point of the surface along its normal up to a distance, in [0, 1].
ABUT_API abut_code abut_field2_ambient_occlusion(const abut_field2* field, abut_vec2 point, abut_vec2 normal,
                                                 float reach, float* out);
ABUT_API abut_code abut_field3_ambient_occlusion(const abut_field3* field, abut_vec3 point, abut_vec3 normal,
                                                 float reach, float* out);

/// The signed distances at many points.
ABUT_API abut_code abut_field2_distance_many(const abut_field2* field, ABUT_ARRAY(count) const abut_vec2* points,
                                             uint32_t stride, uint32_t count, ABUT_ARRAY(count) float* out);
ABUT_API abut_code abut_field3_distance_many(const abut_field3* field, ABUT_ARRAY(count) const abut_vec3* points,
                                             uint32_t stride, uint32_t count, ABUT_ARRAY(count) float* out);

/// The signed distances and their directions at many points.
ABUT_API abut_code abut_field2_sample_many(const abut_field2* field, ABUT_ARRAY(count) const abut_vec2* points,
                                           uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_field_sample2* out);
ABUT_API abut_code abut_field3_sample_many(const abut_field3* field, ABUT_ARRAY(count) const abut_vec3* points,
                                           uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_field_sample3* out);

/// The closest points of many points.
ABUT_API abut_code abut_field2_closest_many(const abut_field2* field, ABUT_ARRAY(count) const abut_vec2* points,
                                            uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_vec2* out);
ABUT_API abut_code abut_field3_closest_many(const abut_field3* field, ABUT_ARRAY(count) const abut_vec3* points,
                                            uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_vec3* out);

/// The shares of a light that arrive at many points.
ABUT_API abut_code abut_field2_shadow_many(const abut_field2* field, ABUT_ARRAY(count) const abut_vec2* points,
                                           uint32_t stride, uint32_t count, abut_vec2 light, float softness,
                                           ABUT_ARRAY(count) float* out);
ABUT_API abut_code abut_field3_shadow_many(const abut_field3* field, ABUT_ARRAY(count) const abut_vec3* points,
                                           uint32_t stride, uint32_t count, abut_vec3 light, float softness,
                                           ABUT_ARRAY(count) float* out);

/// The box that contains the samples.
ABUT_API abut_code abut_field2_volume(const abut_field2* field, abut_aabb2* out);
ABUT_API abut_code abut_field3_volume(const abut_field3* field, abut_aabb3* out);

/// The side of a cell.
ABUT_API abut_code abut_field2_cell(const abut_field2* field, float* out);
ABUT_API abut_code abut_field3_cell(const abut_field3* field, float* out);

/// The field as a shape, solid where the distance is at most 0.
ABUT_API abut_code abut_field2_shape(const abut_field2* field, abut_shape2** out);
ABUT_API abut_code abut_field3_shape(const abut_field3* field, abut_shape3** out);

/// Writes the field as a file, the same on every machine.
ABUT_API abut_code abut_field2_save(const abut_field2* field, abut_buffer* out);
ABUT_API abut_code abut_field3_save(const abut_field3* field, abut_buffer* out);

/// The field that `save` has written.
ABUT_API abut_code abut_field2_load(ABUT_ARRAY(size) const uint8_t* bytes, size_t size, abut_field2** out);
ABUT_API abut_code abut_field3_load(ABUT_ARRAY(size) const uint8_t* bytes, size_t size, abut_field3** out);

ABUT_C_END
