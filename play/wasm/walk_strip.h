#pragma once

// Strips of triangles of a walk mesh, unfolded into the plane, as JSON.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The triangles that a walk crosses, in order: {"triangles": [{"triangle": number, "corners": three points}],
/// "borders": [points, two for each side without a neighbour], "line": [points], "space": [the same points in space]}.
/// Points of the plane are seen from above the triangle: the walk begins at the origin and goes along the second axis.
/// `from_below`: they are seen from the other side.
ABUT_API abut_code abut_play_walk_strip(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3 step,
                                        bool from_below, abut_buffer* out);

/// The triangles that the shortest path crosses, likewise; empty lists if there is no path. The points are those at
/// which the path bends in its plane, and in space those at which it bends there.
ABUT_API abut_code abut_play_path_strip(const abut_walk_mesh* mesh, abut_walk_point from, abut_walk_point to,
                                        bool from_below, abut_buffer* out);

/// The edges of a walk mesh, two points each: those of the border, or all others.
ABUT_API abut_code abut_play_walk_edges(const abut_walk_mesh* mesh, bool border, abut_buffer* out);

ABUT_C_END
