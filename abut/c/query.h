#pragma once

// The questions about shapes, one by one and many at once.
//
// A question about many places of B takes an array of poses: the answer at index i is that of A and `at(b, poses[i])`.

#include <abut/c/shape.h>

ABUT_C_BEGIN

/// What an answer lies on: a vertex, edge or face, by number.
typedef enum abut_feature_kind {
    ABUT_FEATURE_NONE = 0,  ///< a round or unnamed place
    ABUT_FEATURE_VERTEX = 1,
    ABUT_FEATURE_EDGE = 2,  ///< index: the lower point number in the low 16 bits, the higher one in the high 16
    ABUT_FEATURE_FACE = 3
} abut_feature_kind;

/// The feature of a shape that an answer lies on.
typedef struct abut_feature {
    uint32_t part;  ///< of a composite shape: its triangle, tile or child
    uint32_t index;
    uint32_t kind;  ///< an abut_feature_kind
} abut_feature;

/// The options of a question.
typedef struct abut_query_options {
    float margin;          ///< contacts: surfaces up to this far apart count too; by default 0
    abut_flag back_faces;  ///< rays: whether the back faces of a mesh count; by default 1
} abut_query_options;

/// Writes the defaults.
ABUT_API abut_code abut_query_options_default(abut_query_options* out);

/// The signed distance of two shapes.
typedef struct abut_closest2 {
    float distance;    ///< the gap, or minus the least translation that separates them
    abut_vec2 normal;  ///< unit vector from A to B
    abut_vec2 on_a;    ///< on the surface of A
    abut_vec2 on_b;    ///< on the surface of B; on_a + distance * normal
    abut_feature feature_a;
    abut_feature feature_b;
} abut_closest2;

/// The signed distance of two shapes.
typedef struct abut_closest3 {
    float distance;    ///< the gap, or minus the least translation that separates them
    abut_vec3 normal;  ///< unit vector from A to B
    abut_vec3 on_a;    ///< on the surface of A
    abut_vec3 on_b;    ///< on the surface of B; on_a + distance * normal
    abut_feature feature_a;
    abut_feature feature_b;
} abut_closest3;

/// A point of a contact.
typedef struct abut_contact_point2 {
    abut_vec2 position;  ///< midway between the two surfaces along the normal
    float depth;         ///< negative for a near miss
    uint32_t feature;    ///< constant from frame to frame while the same corners and edges touch
} abut_contact_point2;

/// A point of a contact.
typedef struct abut_contact_point3 {
    abut_vec3 position;  ///< midway between the two surfaces along the normal
    float depth;         ///< negative for a near miss
    uint32_t feature;    ///< constant from frame to frame while the same corners and edges touch
} abut_contact_point3;

/// Where two shapes touch, in the plane.
typedef struct abut_contact2 {
    abut_vec2 normal;  ///< unit vector from A to B: moving B by depth * normal separates them
    float depth;
    uint32_t count;  ///< of points; 0 if they don't touch
    abut_contact_point2 points[2];
    abut_feature feature_a;
    abut_feature feature_b;
} abut_contact2;

/// Where two shapes touch, in space.
typedef struct abut_contact3 {
    abut_vec3 normal;  ///< unit vector from A to B: moving B by depth * normal separates them
    float depth;
    uint32_t count;  ///< of points; 0 if they don't touch
    abut_contact_point3 points[4];
    abut_feature feature_a;
    abut_feature feature_b;
} abut_contact3;

/// The first contact that a motion or ray gains.
typedef struct abut_hit2 {
    abut_flag found;  ///< 1, or 0 if nothing is hit: then all else is 0
    float fraction;   ///< of the motion, in [0, 1]; 0 for a ray of infinite length
    float distance;   ///< along the motion
    abut_vec2 point;
    abut_vec2 normal;          ///< unit vector, facing the mover or the ray's origin
    abut_flag started_inside;  ///< 1 if the start is deeper inside than the tolerance
    abut_feature feature;      ///< of the shape that is hit
} abut_hit2;

/// The first contact that a motion or ray gains.
typedef struct abut_hit3 {
    abut_flag found;  ///< 1, or 0 if nothing is hit: then all else is 0
    float fraction;   ///< of the motion, in [0, 1]; 0 for a ray of infinite length
    float distance;   ///< along the motion
    abut_vec3 point;
    abut_vec3 normal;          ///< unit vector, facing the mover or the ray's origin
    abut_flag started_inside;  ///< 1 if the start is deeper inside than the tolerance
    abut_feature feature;      ///< of the shape that is hit
} abut_hit3;

/// The errors found in an answer of `closest`, in the unit of the shapes; not negative.
typedef struct abut_certificate2 {
    double margin;      ///< the tolerance of an answer about this pair
    double plane;       ///< error of the distance along the normal
    double off_a;       ///< how far on_a is off the surface of A
    double off_b;       ///< how far on_b is off the surface of B
    double across;      ///< how far on_b is from on_a + distance * normal
    double off_common;  ///< how far `common` is outside of either shape
    abut_vec2 common;   ///< a point of both overlapping shapes
    abut_flag holds;    ///< 1 if each error is within the margin and the rounding of positions
} abut_certificate2;

/// The errors found in an answer of `closest`, in the unit of the shapes; not negative.
typedef struct abut_certificate3 {
    double margin;      ///< the tolerance of an answer about this pair
    double plane;       ///< error of the distance along the normal
    double off_a;       ///< how far on_a is off the surface of A
    double off_b;       ///< how far on_b is off the surface of B
    double across;      ///< how far on_b is from on_a + distance * normal
    double off_common;  ///< how far `common` is outside of either shape
    abut_vec3 common;   ///< a point of both overlapping shapes
    abut_flag holds;    ///< 1 if each error is within the margin and the rounding of positions
} abut_certificate3;

/// Whether two shapes overlap or touch.
ABUT_API abut_code abut_shape2_overlaps(const abut_shape2* a, const abut_shape2* b, bool* out);
ABUT_API abut_code abut_shape3_overlaps(const abut_shape3* a, const abut_shape3* b, bool* out);

/// The signed distance of two shapes, with the closest points.
ABUT_API abut_code abut_shape2_closest(const abut_shape2* a, const abut_shape2* b, abut_closest2* out);
ABUT_API abut_code abut_shape3_closest(const abut_shape3* a, const abut_shape3* b, abut_closest3* out);

/// The point of a shape closest to a point: `on_a`. Inside, the distance is negative.
ABUT_API abut_code abut_shape2_closest_to_point(const abut_shape2* a, abut_vec2 point, abut_closest2* out);
ABUT_API abut_code abut_shape3_closest_to_point(const abut_shape3* a, abut_vec3 point, abut_closest3* out);

/// The contact of two touching shapes; of composite ones the deepest.
ABUT_API abut_code abut_shape2_contact(const abut_shape2* a, const abut_shape2* b,
                                       ABUT_OPTIONAL const abut_query_options* options, abut_contact2* out);
ABUT_API abut_code abut_shape3_contact(const abut_shape3* a, const abut_shape3* b,
                                       ABUT_OPTIONAL const abut_query_options* options, abut_contact3* out);

/// The contacts of two shapes, one for each plane on which they touch, in no promised order.
ABUT_API abut_code abut_shape2_each_contact(const abut_shape2* a, const abut_shape2* b,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(capacity) abut_contact2* out, uint32_t capacity,
                                            uint32_t* count);
ABUT_API abut_code abut_shape3_each_contact(const abut_shape3* a, const abut_shape3* b,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(capacity) abut_contact3* out, uint32_t capacity,
                                            uint32_t* count);

/// The first hit of two shapes that move straight, without rotation, in the same time.
ABUT_API abut_code abut_shape2_sweep(const abut_shape2* a, abut_vec2 motion_a, const abut_shape2* b, abut_vec2 motion_b,
                                     abut_hit2* out);
ABUT_API abut_code abut_shape3_sweep(const abut_shape3* a, abut_vec3 motion_a, const abut_shape3* b, abut_vec3 motion_b,
                                     abut_hit3* out);

/// The first hit of two shapes that move and rotate, each in the frame that its motion moves.
ABUT_API abut_code abut_shape2_sweep_motion(const abut_shape2* a, abut_motion2 motion_a, const abut_shape2* b,
                                            abut_motion2 motion_b, abut_hit2* out);
ABUT_API abut_code abut_shape3_sweep_motion(const abut_shape3* a, abut_motion3 motion_a, const abut_shape3* b,
                                            abut_motion3 motion_b, abut_hit3* out);

/// The first hit of a ray.
ABUT_API abut_code abut_shape2_raycast(const abut_shape2* shape, abut_ray2 ray,
                                       ABUT_OPTIONAL const abut_query_options* options, abut_hit2* out);
ABUT_API abut_code abut_shape3_raycast(const abut_shape3* shape, abut_ray3 ray,
                                       ABUT_OPTIONAL const abut_query_options* options, abut_hit3* out);

/// Whether a ray hits the shape.
ABUT_API abut_code abut_shape2_raycast_any(const abut_shape2* shape, abut_ray2 ray,
                                           ABUT_OPTIONAL const abut_query_options* options, bool* out);
ABUT_API abut_code abut_shape3_raycast_any(const abut_shape3* shape, abut_ray3 ray,
                                           ABUT_OPTIONAL const abut_query_options* options, bool* out);

/// The hits of a ray with each part of the shape, nearest first.
ABUT_API abut_code abut_shape2_raycast_all(const abut_shape2* shape, abut_ray2 ray,
                                           ABUT_OPTIONAL const abut_query_options* options,
                                           ABUT_ARRAY(capacity) abut_hit2* out, uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_shape3_raycast_all(const abut_shape3* shape, abut_ray3 ray,
                                           ABUT_OPTIONAL const abut_query_options* options,
                                           ABUT_ARRAY(capacity) abut_hit3* out, uint32_t capacity, uint32_t* count);

/// Whether the shape contains a point. A closed mesh or chain and a solid level are solid here.
ABUT_API abut_code abut_shape2_contains(const abut_shape2* shape, abut_vec2 point, bool* out);
ABUT_API abut_code abut_shape3_contains(const abut_shape3* shape, abut_vec3 point, bool* out);

/// Checks an answer of `closest` for the same two shapes, independent of the algorithm that found it.
ABUT_API abut_code abut_shape2_certify(const abut_shape2* a, const abut_shape2* b, abut_closest2 answer,
                                       abut_certificate2* out);
ABUT_API abut_code abut_shape3_certify(const abut_shape3* a, const abut_shape3* b, abut_closest3 answer,
                                       abut_certificate3* out);

/// The rest of a ray after a hit, reflected by a flat mirror there. BAD_ARGUMENT if the hit isn't found.
ABUT_API abut_code abut_ray2_reflect(abut_ray2 ray, abut_hit2 hit, abut_ray2* out);
ABUT_API abut_code abut_ray3_reflect(abut_ray3 ray, abut_hit3 hit, abut_ray3* out);

/// Whether A overlaps B at each of many poses.
ABUT_API abut_code abut_shape2_overlaps_many(const abut_shape2* a, const abut_shape2* b,
                                             ABUT_ARRAY(count) const abut_pose2* poses, uint32_t stride, uint32_t count,
                                             ABUT_ARRAY(count) bool* out);
ABUT_API abut_code abut_shape3_overlaps_many(const abut_shape3* a, const abut_shape3* b,
                                             ABUT_ARRAY(count) const abut_pose3* poses, uint32_t stride, uint32_t count,
                                             ABUT_ARRAY(count) bool* out);

/// The signed distances of A and B at each of many poses.
ABUT_API abut_code abut_shape2_closest_many(const abut_shape2* a, const abut_shape2* b,
                                            ABUT_ARRAY(count) const abut_pose2* poses, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_closest2* out);
ABUT_API abut_code abut_shape3_closest_many(const abut_shape3* a, const abut_shape3* b,
                                            ABUT_ARRAY(count) const abut_pose3* poses, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_closest3* out);

/// The contacts of A and B at each of many poses.
ABUT_API abut_code abut_shape2_contact_many(const abut_shape2* a, const abut_shape2* b,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(count) const abut_pose2* poses, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_contact2* out);
ABUT_API abut_code abut_shape3_contact_many(const abut_shape3* a, const abut_shape3* b,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(count) const abut_pose3* poses, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_contact3* out);

/// The signed distances of many points, with the closest points of the shape.
ABUT_API abut_code abut_shape2_closest_to_points(const abut_shape2* a, ABUT_ARRAY(count) const abut_vec2* points,
                                                 uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_closest2* out);
ABUT_API abut_code abut_shape3_closest_to_points(const abut_shape3* a, ABUT_ARRAY(count) const abut_vec3* points,
                                                 uint32_t stride, uint32_t count, ABUT_ARRAY(count) abut_closest3* out);

/// Whether the shape contains each of many points.
ABUT_API abut_code abut_shape2_contains_many(const abut_shape2* shape, ABUT_ARRAY(count) const abut_vec2* points,
                                             uint32_t stride, uint32_t count, ABUT_ARRAY(count) bool* out);
ABUT_API abut_code abut_shape3_contains_many(const abut_shape3* shape, ABUT_ARRAY(count) const abut_vec3* points,
                                             uint32_t stride, uint32_t count, ABUT_ARRAY(count) bool* out);

/// The first hit of each of many rays.
ABUT_API abut_code abut_shape2_raycast_many(const abut_shape2* shape, ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(count) const abut_ray2* rays, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_hit2* out);
ABUT_API abut_code abut_shape3_raycast_many(const abut_shape3* shape, ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(count) const abut_ray3* rays, uint32_t stride, uint32_t count,
                                            ABUT_ARRAY(count) abut_hit3* out);

/// The first hit of A in each of many motions with B at rest.
ABUT_API abut_code abut_shape2_sweep_many(const abut_shape2* a, ABUT_ARRAY(count) const abut_motion2* motions,
                                          uint32_t stride, uint32_t count, const abut_shape2* b,
                                          ABUT_ARRAY(count) abut_hit2* out);
ABUT_API abut_code abut_shape3_sweep_many(const abut_shape3* a, ABUT_ARRAY(count) const abut_motion3* motions,
                                          uint32_t stride, uint32_t count, const abut_shape3* b,
                                          ABUT_ARRAY(count) abut_hit3* out);

ABUT_C_END
