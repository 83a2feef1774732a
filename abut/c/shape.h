#pragma once

// Shapes: made of values and arrays, placed, rounded, stretched.

#include <abut/c/types.h>

ABUT_C_BEGIN

/// A shape of the plane, of any kind. Immutable; copies in worlds and compounds share its data.
typedef struct abut_shape2 abut_shape2;

/// A shape of space, of any kind. Immutable; copies in worlds and compounds share its data.
typedef struct abut_shape3 abut_shape3;

/// A circle or sphere. The radius is at least 0; 0 is a point.
typedef struct abut_ball2 {
    abut_vec2 center;
    float radius;
} abut_ball2;

/// A circle or sphere. The radius is at least 0; 0 is a point.
typedef struct abut_ball3 {
    abut_vec3 center;
    float radius;
} abut_ball3;

/// All points within the radius of a segment.
typedef struct abut_capsule2 {
    abut_vec2 a;
    abut_vec2 b;
    float radius;
} abut_capsule2;

/// All points within the radius of a segment.
typedef struct abut_capsule3 {
    abut_vec3 a;
    abut_vec3 b;
    float radius;
} abut_capsule3;

/// A box, rotated about its center in the plane. `half` is half the length of each edge, at least 0.
typedef struct abut_box2 {
    abut_vec2 center;
    abut_vec2 half;
    abut_turn rotation;
} abut_box2;

/// A box, rotated about its center in space. `half` is half the length of each edge, at least 0.
typedef struct abut_box3 {
    abut_vec3 center;
    abut_vec3 half;
    abut_quat rotation;
} abut_box3;

/// A line segment.
typedef struct abut_segment2 {
    abut_vec2 a;
    abut_vec2 b;
} abut_segment2;

/// A line segment.
typedef struct abut_segment3 {
    abut_vec3 a;
    abut_vec3 b;
} abut_segment3;

/// A filled triangle; in space of zero thickness and two-sided.
typedef struct abut_triangle2 {
    abut_vec2 a;
    abut_vec2 b;
    abut_vec2 c;
} abut_triangle2;

/// A filled triangle; in space of zero thickness and two-sided.
typedef struct abut_triangle3 {
    abut_vec3 a;
    abut_vec3 b;
    abut_vec3 c;
} abut_triangle3;

/// Solid where dot(normal, p) <= offset. The normal is a unit vector.
typedef struct abut_half_space2 {
    abut_vec2 normal;
    float offset;
} abut_half_space2;

/// Solid where dot(normal, p) <= offset. The normal is a unit vector.
typedef struct abut_half_space3 {
    abut_vec3 normal;
    float offset;
} abut_half_space3;

/// A cylinder with flat ends, whose centers are a and b.
typedef struct abut_cylinder {
    abut_vec3 a;
    abut_vec3 b;
    float radius;
} abut_cylinder;

/// A cone: a is the center of the base, b the apex.
typedef struct abut_cone {
    abut_vec3 a;
    abut_vec3 b;
    float radius;
} abut_cone;

/// The size of a polygon or polyhedron.
typedef struct abut_measures2 {
    uint32_t rank;  ///< 0: a point, 1: a segment, 2: an area, 3: a solid
    double area;    ///< of a polyhedron that of its surface
    double volume;  ///< 0 in the plane
    abut_vec2 centroid;
    abut_vec2 normal;  ///< of the longest edge or largest face; unit vector
} abut_measures2;

/// The size of a polygon or polyhedron.
typedef struct abut_measures3 {
    uint32_t rank;  ///< 0: a point, 1: a segment, 2: an area, 3: a solid
    double area;    ///< of a polyhedron that of its surface
    double volume;  ///< 0 in the plane
    abut_vec3 centroid;
    abut_vec3 normal;  ///< of the longest edge or largest face; unit vector
} abut_measures3;

/// The shape of a tile of a tile map. Low and high are the ends of an axis.
typedef enum abut_tile {
    ABUT_TILE_EMPTY = 0,
    ABUT_TILE_FULL = 1,
    ABUT_TILE_HALF_LOW_X = 2,  ///< the half of the tile at its low x
    ABUT_TILE_HALF_HIGH_X = 3,
    ABUT_TILE_HALF_LOW_Y = 4,
    ABUT_TILE_HALF_HIGH_Y = 5,
    ABUT_TILE_SLOPE_LOW_X_LOW_Y = 6,  ///< the triangle at the corner of low x and low y
    ABUT_TILE_SLOPE_HIGH_X_LOW_Y = 7,
    ABUT_TILE_SLOPE_LOW_X_HIGH_Y = 8,
    ABUT_TILE_SLOPE_HIGH_X_HIGH_Y = 9,
    ABUT_TILE_ONE_WAY_LOW_X = 10,  ///< only the edge at low x; it stops motion along +x that comes from outside
    ABUT_TILE_ONE_WAY_HIGH_X = 11,
    ABUT_TILE_ONE_WAY_LOW_Y = 12,
    ABUT_TILE_ONE_WAY_HIGH_Y = 13
} abut_tile;

/// A circle or sphere as a shape.
ABUT_API abut_code abut_shape2_ball(abut_ball2 ball, abut_shape2** out);
ABUT_API abut_code abut_shape3_ball(abut_ball3 ball, abut_shape3** out);

/// A capsule as a shape.
ABUT_API abut_code abut_shape2_capsule(abut_capsule2 capsule, abut_shape2** out);
ABUT_API abut_code abut_shape3_capsule(abut_capsule3 capsule, abut_shape3** out);

/// A box as a shape.
ABUT_API abut_code abut_shape2_box(abut_box2 box, abut_shape2** out);
ABUT_API abut_code abut_shape3_box(abut_box3 box, abut_shape3** out);

/// An axis-aligned box as a shape. No coordinate of `max` is below that of `min`.
ABUT_API abut_code abut_shape2_aabb(abut_aabb2 box, abut_shape2** out);
ABUT_API abut_code abut_shape3_aabb(abut_aabb3 box, abut_shape3** out);

/// A segment as a shape.
ABUT_API abut_code abut_shape2_segment(abut_segment2 segment, abut_shape2** out);
ABUT_API abut_code abut_shape3_segment(abut_segment3 segment, abut_shape3** out);

/// A triangle as a shape.
ABUT_API abut_code abut_shape2_triangle(abut_triangle2 triangle, abut_shape2** out);
ABUT_API abut_code abut_shape3_triangle(abut_triangle3 triangle, abut_shape3** out);

/// A half-space as a shape. Two of them are no pair for any question.
ABUT_API abut_code abut_shape2_half_space(abut_half_space2 half_space, abut_shape2** out);
ABUT_API abut_code abut_shape3_half_space(abut_half_space3 half_space, abut_shape3** out);

/// A cylinder as a shape.
ABUT_API abut_code abut_shape3_cylinder(abut_cylinder cylinder, abut_shape3** out);

/// A cone as a shape.
ABUT_API abut_code abut_shape3_cone(abut_cone cone, abut_shape3** out);

/// The convex hull of points in the plane, in any order. With a limit of at least 3 on its vertices it may be larger
/// and contains all points; 0 is no limit.
ABUT_API abut_code abut_shape2_polygon(ABUT_ARRAY(count) const abut_vec2* points, uint32_t stride, uint32_t count,
                                       uint32_t max_vertices, abut_shape2** out);

/// The convex hull of points in space, in any order. With a limit of at least 4 on its vertices it may be larger and
/// contains all points; 0 is no limit.
ABUT_API abut_code abut_shape3_polyhedron(ABUT_ARRAY(count) const abut_vec3* points, uint32_t stride, uint32_t count,
                                          uint32_t max_vertices, abut_shape3** out);

/// A polyline of at least two points, or three if it is closed. If it is one-sided, rays, sweeps and contacts hit it
/// only from the right side of its direction.
ABUT_API abut_code abut_shape2_chain(ABUT_ARRAY(count) const abut_vec2* points, uint32_t stride, uint32_t count,
                                     bool closed, bool one_sided, abut_shape2** out);

/// A grid of tiles, row by row from low y. Each is an abut_tile.
ABUT_API abut_code abut_shape2_tile_map(ABUT_ARRAY(count) const uint8_t* tiles, uint32_t count, uint32_t columns,
                                        abut_vec2 cell, abut_shape2** out);

/// A grid of nx by ny by nz voxels. Voxel (x, y, z) has the number x + nx * (y + ny * z) and is solid if its byte is
/// not 0.
ABUT_API abut_code abut_shape3_voxel_map(ABUT_ARRAY(nx* ny* nz) const uint8_t* solid, uint32_t nx, uint32_t ny,
                                         uint32_t nz, abut_vec3 cell, abut_shape3** out);

/// A triangle mesh; three point numbers a triangle. A closed one is solid in `contains` only.
ABUT_API abut_code abut_shape3_mesh(ABUT_ARRAY(point_count) const abut_vec3* points, uint32_t stride,
                                    uint32_t point_count, ABUT_ARRAY(3 * triangle_count) const uint32_t* triangles,
                                    uint32_t triangle_count, abut_shape3** out);

/// A closed mesh as a solid in every question. WRONG_SHAPE if the shape is no mesh.
ABUT_API abut_code abut_shape3_solid(const abut_shape3* mesh, abut_shape3** out);

/// A terrain of heights along z over a grid, `columns` heights in a row. `holes` are the numbers of cells without
/// triangles.
ABUT_API abut_code abut_shape3_height_field(ABUT_ARRAY(count) const float* heights, uint32_t count, uint32_t columns,
                                            abut_vec2 cell, ABUT_ARRAY(hole_count) const uint32_t* holes,
                                            uint32_t hole_count, abut_shape3** out);

/// Several shapes as one; answers name the number of the child. No half-spaces and no fields.
ABUT_API abut_code abut_shape2_compound(ABUT_ARRAY(count) const abut_shape2* const* children, uint32_t count,
                                        abut_shape2** out);
ABUT_API abut_code abut_shape3_compound(ABUT_ARRAY(count) const abut_shape3* const* children, uint32_t count,
                                        abut_shape3** out);

/// A solid level of segments, with the solid on their left.
ABUT_API abut_code abut_shape2_solid_bsp(ABUT_ARRAY(point_count) const abut_vec2* points, uint32_t stride,
                                         uint32_t point_count, ABUT_ARRAY(2 * face_count) const uint32_t* faces,
                                         uint32_t face_count, abut_shape2** out);

/// A solid level of triangles, counter-clockwise seen from the open side.
ABUT_API abut_code abut_shape3_solid_bsp(ABUT_ARRAY(point_count) const abut_vec3* points, uint32_t stride,
                                         uint32_t point_count, ABUT_ARRAY(3 * face_count) const uint32_t* faces,
                                         uint32_t face_count, abut_shape3** out);

/// A solid level of brushes: brush k is the intersection of the half-spaces from ends[k - 1] (0 for k = 0) up to
/// ends[k].
ABUT_API abut_code abut_shape2_solid_bsp_from_brushes(ABUT_ARRAY(side_count) const abut_half_space2* sides,
                                                      uint32_t side_count, ABUT_ARRAY(brush_count) const uint32_t* ends,
                                                      uint32_t brush_count, abut_shape2** out);
ABUT_API abut_code abut_shape3_solid_bsp_from_brushes(ABUT_ARRAY(side_count) const abut_half_space3* sides,
                                                      uint32_t side_count, ABUT_ARRAY(brush_count) const uint32_t* ends,
                                                      uint32_t brush_count, abut_shape3** out);

/// The shape at a pose, which is applied after the shape's own position.
ABUT_API abut_code abut_shape2_at(const abut_shape2* shape, abut_pose2 pose, abut_shape2** out);
ABUT_API abut_code abut_shape3_at(const abut_shape3* shape, abut_pose3 pose, abut_shape3** out);

/// All points within a radius of the shape.
ABUT_API abut_code abut_shape2_rounded(const abut_shape2* shape, float radius, abut_shape2** out);
ABUT_API abut_code abut_shape3_rounded(const abut_shape3* shape, float radius, abut_shape3** out);

/// The shape scaled along each axis, about the origin. A negative factor mirrors, 0 flattens. WRONG_SHAPE for a shape
/// that was stretched and then rounded: stretch first, round last.
ABUT_API abut_code abut_shape2_stretched(const abut_shape2* shape, abut_vec2 scale, abut_shape2** out);
ABUT_API abut_code abut_shape3_stretched(const abut_shape3* shape, abut_vec3 scale, abut_shape3** out);

/// A polygon or polyhedron inside a convex shape, no point of which is farther from it than the tolerance, a length
/// above 0. WRONG_SHAPE if the shape isn't convex.
ABUT_API abut_code abut_shape2_polytope(const abut_shape2* shape, float tolerance, abut_shape2** out);
ABUT_API abut_code abut_shape3_polytope(const abut_shape3* shape, float tolerance, abut_shape3** out);

/// The points that are in both, as a polygon or polyhedron; null if there are none. Both are polytopes: boxes,
/// segments, triangles, polygons, polyhedra, and those placed or stretched; else WRONG_SHAPE, and `polytope` makes one.
ABUT_API abut_code abut_shape2_intersection(const abut_shape2* a, const abut_shape2* b, abut_shape2** out);
ABUT_API abut_code abut_shape3_intersection(const abut_shape3* a, const abut_shape3* b, abut_shape3** out);

/// All points p + q, p in A and q in B, of two polytopes; NOT_FINITE if some are beyond the range of floats.
ABUT_API abut_code abut_shape2_minkowski_sum(const abut_shape2* a, const abut_shape2* b, abut_shape2** out);
ABUT_API abut_code abut_shape3_minkowski_sum(const abut_shape3* a, const abut_shape3* b, abut_shape3** out);

/// All points p - q, p in A and q in B, of two polytopes; NOT_FINITE if some are beyond the range of floats.
ABUT_API abut_code abut_shape2_minkowski_difference(const abut_shape2* a, const abut_shape2* b, abut_shape2** out);
ABUT_API abut_code abut_shape3_minkowski_difference(const abut_shape3* a, const abut_shape3* b, abut_shape3** out);

/// The bounding box. That of a half-space is infinite.
ABUT_API abut_code abut_shape2_bounds(const abut_shape2* shape, abut_aabb2* out);
ABUT_API abut_code abut_shape3_bounds(const abut_shape3* shape, abut_aabb3* out);

/// The vertices of a polygon or polyhedron, or the points of a chain or mesh; WRONG_SHAPE for others, also placed ones.
ABUT_API abut_code abut_shape2_points(const abut_shape2* shape, ABUT_ARRAY(capacity) abut_vec2* out, uint32_t capacity,
                                      uint32_t* count);
ABUT_API abut_code abut_shape3_points(const abut_shape3* shape, ABUT_ARRAY(capacity) abut_vec3* out, uint32_t capacity,
                                      uint32_t* count);

/// Three point numbers for each triangle of a mesh, or of the faces of a polyhedron; WRONG_SHAPE for others. The
/// capacity and the count are in triangles.
ABUT_API abut_code abut_shape3_triangles(const abut_shape3* shape, ABUT_ARRAY(3 * capacity) uint32_t* out,
                                         uint32_t capacity, uint32_t* count);

/// The size of a polygon or polyhedron; WRONG_SHAPE for others.
ABUT_API abut_code abut_shape2_measures(const abut_shape2* shape, abut_measures2* out);
ABUT_API abut_code abut_shape3_measures(const abut_shape3* shape, abut_measures3* out);

/// Frees the handle. Copies in worlds and compounds stay.
ABUT_API void abut_shape2_release(ABUT_OPTIONAL abut_shape2* shape);
ABUT_API void abut_shape3_release(ABUT_OPTIONAL abut_shape3* shape);

ABUT_C_END
