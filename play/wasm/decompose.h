#pragma once

// Decompositions with their reports, as JSON.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The convex parts of a mesh. An object with `report`, which has the members of abut::DecomposeReport, and `parts`: of
/// each its `points`, `triangles`, `centroid` and `volume`. WRONG_SHAPE if the shape is no mesh.
ABUT_API abut_code abut_play_decompose_mesh(const abut_shape3* mesh,
                                            ABUT_OPTIONAL const abut_decompose_options* options, abut_buffer* out);

/// The convex parts of an outline with holes, in rings as abut_decompose_outline takes them. An object with `report`,
/// which has the members of abut::OutlineReport, and `parts`: of each its `points` and `centroid`.
ABUT_API abut_code abut_play_decompose_outline(ABUT_ARRAY(point_count) const abut_vec2* points, uint32_t stride,
                                               uint32_t point_count, ABUT_ARRAY(ring_count) const uint32_t* ends,
                                               uint32_t ring_count, bool conforming, double concavity,
                                               abut_buffer* out);

ABUT_C_END
