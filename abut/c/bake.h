#pragma once

// Slow work before the game starts: decomposition into convex parts.

#include <abut/c/shape.h>

ABUT_C_BEGIN

/// A list of shapes of the plane, which owns them.
typedef struct abut_shapes2 abut_shapes2;

/// A list of shapes of space, which owns them.
typedef struct abut_shapes3 abut_shapes3;

/// The options of the decomposition of meshes.
typedef struct abut_decompose_options {
    uint32_t max_parts;     ///< at least 1; by default 32
    uint32_t max_vertices;  ///< of a part, above 3; 0: no limit; by default 64
    double concavity;       ///< how far parts may be from convex, as a share of half the longest side; by default 0.05
} abut_decompose_options;

/// Writes the defaults.
ABUT_API abut_code abut_decompose_options_default(abut_decompose_options* out);

/// Decomposes an outline with holes into convex polygons. Ring k has the points from ends[k - 1] (0 for k = 0) up to
/// ends[k]: the first is the outline, the others are holes. `concavity` is a length: 0 is exact, else parts may be less
/// and extend beyond the outline.
ABUT_API abut_code abut_decompose_outline(ABUT_ARRAY(point_count) const abut_vec2* points, uint32_t stride,
                                          uint32_t point_count, ABUT_ARRAY(ring_count) const uint32_t* ends,
                                          uint32_t ring_count, double concavity, abut_shapes2** out);

/// Decomposes a mesh into convex polyhedra that cover it. WRONG_SHAPE if the shape is no mesh.
ABUT_API abut_code abut_decompose_mesh(const abut_shape3* mesh, ABUT_OPTIONAL const abut_decompose_options* options,
                                       abut_shapes3** out);

/// The number of shapes.
ABUT_API abut_code abut_shapes2_size(const abut_shapes2* shapes, uint32_t* out);
ABUT_API abut_code abut_shapes3_size(const abut_shapes3* shapes, uint32_t* out);

/// A new handle of the shape at an index.
ABUT_API abut_code abut_shapes2_get(const abut_shapes2* shapes, uint32_t index, abut_shape2** out);
ABUT_API abut_code abut_shapes3_get(const abut_shapes3* shapes, uint32_t index, abut_shape3** out);

/// All shapes as one.
ABUT_API abut_code abut_shapes2_compound(const abut_shapes2* shapes, abut_shape2** out);
ABUT_API abut_code abut_shapes3_compound(const abut_shapes3* shapes, abut_shape3** out);

/// Frees a list and its shapes.
ABUT_API void abut_shapes2_release(ABUT_OPTIONAL abut_shapes2* shapes);
ABUT_API void abut_shapes3_release(ABUT_OPTIONAL abut_shapes3* shapes);

ABUT_C_END
