#pragma once

// Walk meshes: places on a surface, walks over it, and shortest paths.

#include <abut/c/types.h>

ABUT_C_BEGIN

/// A triangle mesh to walk on. Immutable.
typedef struct abut_walk_mesh abut_walk_mesh;

/// A place: a triangle and barycentric weights, nonnegative and not all 0.
typedef struct abut_walk_point {
    uint32_t triangle;
    abut_vec3 weights;
} abut_walk_point;

/// A side of a triangle: side k goes from corner k to the next. The triangle is 0xffffffff if there is none.
typedef struct abut_walk_side {
    uint32_t triangle;
    uint32_t side;
} abut_walk_side;

/// What a walk met.
typedef enum abut_walk_met {
    ABUT_WALK_MET_NOTHING = 0,  ///< the whole step was walked straight
    ABUT_WALK_MET_BORDER = 1,   ///< slid along a border, and lost some of its length
    ABUT_WALK_MET_CORNER = 2,   ///< stopped at a border head-on or in a corner
    ABUT_WALK_MET_LIMIT = 3     ///< stopped after the maximum number of edges
} abut_walk_met;

/// The result of a walk.
typedef struct abut_walked {
    abut_walk_point place;
    abut_vec3 position;   ///< of the place, in space
    float length;         ///< walked length
    float lost;           ///< the rest of the step
    uint32_t met;         ///< an abut_walk_met
    abut_walk_side side;  ///< the first border, if any
    abut_quat turn;       ///< rotates the walker's frame and directions as the walk did
    abut_flag mirrored;   ///< 1 if the walker now stands on the side opposite to the normal, as on a Moebius strip
    uint32_t crossings;   ///< edges crossed
} abut_walked;

/// Faults of the input triangles and how they were treated.
typedef struct abut_walk_mesh_report {
    uint32_t duplicates;
    uint32_t flat;
    uint32_t left_out;
    uint32_t turned;
    uint32_t non_manifold_edges;
    uint32_t mirrored;
    uint32_t border;
    uint32_t non_manifold_vertices;
    uint32_t components;
} abut_walk_mesh_report;

/// The options of a path.
typedef struct abut_walk_path_options {
    abut_flag nearest_reachable;  ///< leads to the nearest reachable place if the end is none; by default 0
    uint32_t area_cost_count;     ///< by default 0
    const float* area_costs;      ///< the cost per unit of length for each area; further areas cost 1; by default null
} abut_walk_path_options;

/// A path: its measures. The points are written beside it.
typedef struct abut_walk_path {
    abut_flag found;    ///< 1, or 0 if there is no path: then all else is 0
    abut_flag reached;  ///< 0 if the path ends at the nearest reachable place
    double length;      ///< along the surface
    double cost;        ///< the sum of each segment's length times the cost of its area
} abut_walk_path;

/// Builds a walk mesh of three point numbers a triangle. `normals`, one for each point, are for `smooth_normal`;
/// `areas`, one for each triangle, for the costs of paths.
ABUT_API abut_code abut_walk_mesh_build(ABUT_ARRAY(point_count) const abut_vec3* points, uint32_t stride,
                                        uint32_t point_count, ABUT_ARRAY(3 * triangle_count) const uint32_t* triangles,
                                        uint32_t triangle_count,
                                        ABUT_OPTIONAL ABUT_ARRAY(point_count) const abut_vec3* normals,
                                        ABUT_OPTIONAL ABUT_ARRAY(triangle_count) const uint8_t* areas,
                                        abut_walk_mesh** out);

/// Frees a walk mesh.
ABUT_API void abut_walk_mesh_release(ABUT_OPTIONAL abut_walk_mesh* mesh);

/// What `build` changed.
ABUT_API abut_code abut_walk_mesh_get_report(const abut_walk_mesh* mesh, abut_walk_mesh_report* out);

/// The place closest to a point.
ABUT_API abut_code abut_walk_mesh_nearest(const abut_walk_mesh* mesh, abut_vec3 point, abut_walk_point* out);

/// The places closest to many points.
ABUT_API abut_code abut_walk_mesh_nearest_many(const abut_walk_mesh* mesh, ABUT_ARRAY(count) const abut_vec3* points,
                                               uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_walk_point* out);

/// The first place along a ray, such as the floor below a point. `found` is false if there is none; then `out` is as it
/// was.
ABUT_API abut_code abut_walk_mesh_nearest_along(const abut_walk_mesh* mesh, abut_ray3 ray, abut_walk_point* out,
                                                bool* found);

/// The position of a place in space.
ABUT_API abut_code abut_walk_mesh_to_world(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out);

/// The unit normal of the triangle of a place.
ABUT_API abut_code abut_walk_mesh_normal(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out);

/// The interpolated unit normal of the corners of a place.
ABUT_API abut_code abut_walk_mesh_smooth_normal(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out);

/// Walks straight over the surface from a place, by a step in space, and slides along borders.
ABUT_API abut_code abut_walk_mesh_walk(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3 step,
                                       abut_walked* out);

/// Many walks, each from its place by its step.
ABUT_API abut_code abut_walk_mesh_walk_many(const abut_walk_mesh* mesh, ABUT_ARRAY(count) const abut_walk_point* places,
                                            uint32_t place_stride, ABUT_ARRAY(count) const abut_vec3* steps,
                                            uint32_t step_stride, uint32_t count, ABUT_ARRAY(count) abut_walked* out);

/// A shortest path between two places. `points` receives where it begins, bends and ends, and `places` the same points
/// on the mesh if it isn't null.
ABUT_API abut_code abut_walk_mesh_path(const abut_walk_mesh* mesh, abut_walk_point from, abut_walk_point to,
                                       ABUT_OPTIONAL const abut_walk_path_options* options, abut_walk_path* out,
                                       ABUT_ARRAY(capacity) abut_vec3* points,
                                       ABUT_OPTIONAL ABUT_ARRAY(capacity) abut_walk_point* places, uint32_t capacity,
                                       uint32_t* count);

/// Writes the mesh as a file, the same on every machine.
ABUT_API abut_code abut_walk_mesh_save(const abut_walk_mesh* mesh, abut_buffer* out);

/// The mesh that `save` has written.
ABUT_API abut_code abut_walk_mesh_load(ABUT_ARRAY(size) const uint8_t* bytes, size_t size, abut_walk_mesh** out);

ABUT_C_END
