// A program of a C user: calls each function of the C API, compares the answers bit for bit with those of the C++ API,
// and passes what is wrong. Exits with 0 if all holds.
#include "expected.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition) check(condition, #condition, __FILE__, __LINE__)
// The structs have no padding, so that equal bytes are equal answers.
#define SAME(value, expected)                               \
    do {                                                    \
        char bytes[sizeof(value)];                          \
        memcpy(bytes, &(value), sizeof(bytes));             \
        (value) = (expected);                               \
        CHECK(memcmp(bytes, &(value), sizeof(bytes)) == 0); \
    } while (0)
#define MUST(call) must((call), #call, __FILE__, __LINE__)

static void check(bool holds, const char* text, const char* file, int line) {
    if (holds) return;
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
    if (++failures > 20) exit(1);
}

static void must(abut_code code, const char* text, const char* file, int line) {
    if (code == ABUT_OK) return;
    fprintf(stderr, "%s:%d: %s: %d, %s\n", file, line, text, (int)code, abut_last_error());
    exit(1);
}

#define LENGTH(array) (uint32_t)(sizeof(array) / sizeof((array)[0]))

enum { half_space_place = 6 };

static const abut_vec2 motion_a2 = {0.5f, -0.25f}, motion_b2 = {-0.5f, 0.125f}, far_point2 = {3, -2.5f};
static const abut_vec3 motion_a3 = {0.5f, -0.25f, 0.25f}, motion_b3 = {-0.5f, 0.125f, 0}, far_point3 = {3, -2.5f, 2};
static const float turn2 = 1.5f, no_turn2 = 0;
static const abut_vec3 turn3 = {0.5f, 1, -0.25f}, no_turn3 = {0, 0, 0};
static const void *other_shape2 = NULL, *other_shape3 = NULL;

#define N(name) name##2
#define T(type, rest) type##2##rest
#include "questions.h"
#undef N
#undef T
#define N(name) name##3
#define T(type, rest) type##3##rest
#include "questions.h"
#undef N
#undef T

static void make_scene2(abut_shape2** s) {
    MUST(abut_shape2_ball(ball2, &s[0]));
    MUST(abut_shape2_capsule(capsule2, &s[1]));
    MUST(abut_shape2_box(box2, &s[2]));
    MUST(abut_shape2_aabb(aabb2, &s[3]));
    MUST(abut_shape2_segment(segment2, &s[4]));
    MUST(abut_shape2_triangle(triangle2, &s[5]));
    MUST(abut_shape2_half_space(half_space2, &s[6]));
    MUST(abut_shape2_polygon(polygon_points, 0, LENGTH(polygon_points), 0, &s[7]));
    MUST(abut_shape2_chain(chain_points, 0, LENGTH(chain_points), false, false, &s[8]));
    const abut_vec2 cell = {0.5f, 0.5f};
    MUST(abut_shape2_tile_map(tiles, LENGTH(tiles), 3, cell, &s[9]));
    const abut_shape2* children[2] = {s[2], s[0]};
    MUST(abut_shape2_compound(children, 2, &s[10]));
    MUST(abut_shape2_solid_bsp(loop_points, 0, LENGTH(loop_points), loop_faces, LENGTH(loop_faces) / 2, &s[11]));
    MUST(abut_shape2_solid_bsp_from_brushes(brush_sides2, LENGTH(brush_sides2), brush_ends2, LENGTH(brush_ends2),
                                            &s[12]));
    MUST(abut_shape2_at(s[2], tilted2, &s[13]));
    MUST(abut_shape2_rounded(s[2], 0.125f, &s[14]));
    MUST(abut_shape2_stretched(s[2], scale2, &s[15]));
}

static void make_scene3(abut_shape3** s) {
    MUST(abut_shape3_ball(ball3, &s[0]));
    MUST(abut_shape3_capsule(capsule3, &s[1]));
    MUST(abut_shape3_box(box3, &s[2]));
    MUST(abut_shape3_aabb(aabb3, &s[3]));
    MUST(abut_shape3_segment(segment3, &s[4]));
    MUST(abut_shape3_triangle(triangle3, &s[5]));
    MUST(abut_shape3_half_space(half_space3, &s[6]));
    MUST(abut_shape3_cylinder(cylinder, &s[7]));
    MUST(abut_shape3_cone(cone, &s[8]));
    MUST(abut_shape3_polyhedron(corners, 0, LENGTH(corners), 0, &s[9]));
    MUST(abut_shape3_mesh(corners, 0, LENGTH(corners), cube, LENGTH(cube) / 3, &s[10]));
    MUST(abut_shape3_solid(s[10], &s[11]));
    const abut_vec2 cell = {0.75f, 0.5f};
    MUST(abut_shape3_height_field(heights, LENGTH(heights), 3, cell, holes, LENGTH(holes), &s[12]));
    const abut_vec3 voxel = {0.5f, 0.5f, 0.5f};
    MUST(abut_shape3_voxel_map(voxels, 2, 2, 2, voxel, &s[13]));
    const abut_shape3* children[2] = {s[2], s[0]};
    MUST(abut_shape3_compound(children, 2, &s[14]));
    MUST(abut_shape3_solid_bsp(corners, 0, LENGTH(corners), cube, LENGTH(cube) / 3, &s[15]));
    MUST(abut_shape3_solid_bsp_from_brushes(brush_sides3, LENGTH(brush_sides3), brush_ends3, LENGTH(brush_ends3),
                                            &s[16]));
    MUST(abut_shape3_at(s[2], tilted3, &s[17]));
    MUST(abut_shape3_rounded(s[2], 0.125f, &s[18]));
    MUST(abut_shape3_stretched(s[2], scale3, &s[19]));
}

static void make_poses2(abut_pose2* poses) {
    for (int i = 0; i < pose_count; ++i) {
        poses[i].position.x = (float)(i % 3) - 1;
        poses[i].position.y = 0.75f * (float)(i / 3) - 0.5f;
        MUST(abut_turn_by((float)i, &poses[i].rotation));
    }
}

static void make_poses3(abut_pose3* poses) {
    const abut_vec3 axis = {0.6f, 0, 0.8f};
    for (int i = 0; i < pose_count; ++i) {
        poses[i].position.x = (float)(i % 3) - 1;
        poses[i].position.y = 0.75f * (float)(i / 3) - 0.5f;
        poses[i].position.z = 0.25f * (float)(i % 2);
        MUST(abut_turn_about(axis, (float)i, &poses[i].rotation));
    }
}

static void query_walk_mesh(void) {
    abut_walk_mesh *mesh = NULL, *loaded = NULL;
    MUST(abut_walk_mesh_build(corners, 0, LENGTH(corners), cube, LENGTH(cube) / 3, NULL, NULL, &mesh));
    abut_walk_mesh_report report;
    MUST(abut_walk_mesh_get_report(mesh, &report));
    CHECK(report.components == 1 && report.border == 0);
    const abut_vec3 start = {0.25f, 0.5f, 3}, end = {0.25f, 0.125f, -3}, step = {1.5f, 0.25f, 0};
    abut_walk_point places[2];
    const abut_vec3 points[2] = {start, end};
    MUST(abut_walk_mesh_nearest_many(mesh, points, 0, 2, places));
    abut_walk_point place;
    MUST(abut_walk_mesh_nearest(mesh, start, &place));
    SAME(places[0], place);
    abut_walked walked, expected, many[1];
    MUST(abut_walk_mesh_walk(mesh, place, step, &walked));
    expected_walk(start, step, &expected);
    SAME(walked, expected);
    CHECK(walked.crossings > 0 && walked.met == ABUT_WALK_MET_NOTHING);
    MUST(abut_walk_mesh_walk_many(mesh, &place, 0, &step, 0, 1, many));
    SAME(many[0], walked);

    abut_vec3 path[16], expected_points[16];
    abut_walk_path measures;
    uint32_t count = 0;
    double length = 0;
    MUST(abut_walk_mesh_path(mesh, places[0], places[1], NULL, &measures, path, NULL, 16, &count));
    CHECK(count == expected_path(start, end, expected_points, 16, &length) && count >= 4);
    CHECK(memcmp(path, expected_points, count * sizeof(path[0])) == 0);
    CHECK(measures.found && measures.reached && measures.length == length);

    abut_vec3 position, normal, smooth;
    MUST(abut_walk_mesh_to_world(mesh, place, &position));
    MUST(abut_walk_mesh_normal(mesh, place, &normal));
    MUST(abut_walk_mesh_smooth_normal(mesh, place, &smooth));
    CHECK(position.z == 1 && normal.z == 1 && smooth.z > 0);
    const abut_ray3 down = {{0.25f, 0.5f, 3}, {0, 0, -1}, INFINITY}, up = {{0, 0, 3}, {0, 0, 1}, INFINITY};
    bool found = false;
    abut_walk_point below;
    MUST(abut_walk_mesh_nearest_along(mesh, down, &below, &found));
    CHECK(found && below.triangle == place.triangle);
    MUST(abut_walk_mesh_nearest_along(mesh, up, &below, &found));
    CHECK(!found);

    abut_buffer* buffer = NULL;
    MUST(abut_buffer_create(&buffer));
    MUST(abut_walk_mesh_save(mesh, buffer));
    MUST(abut_walk_mesh_load(abut_buffer_data(buffer), abut_buffer_size(buffer), &loaded));
    MUST(abut_walk_mesh_walk(loaded, place, step, &walked));
    SAME(walked, expected);

    place.triangle = 12;
    CHECK(abut_walk_mesh_normal(mesh, place, &normal) == ABUT_INDEX_OUT_OF_RANGE);
    place.triangle = 0;
    place.weights.x = place.weights.y = place.weights.z = 0;
    CHECK(abut_walk_mesh_walk(mesh, place, step, &walked) == ABUT_BAD_ARGUMENT);
    abut_walk_mesh *triangle = NULL, *none = NULL;
    CHECK(abut_walk_mesh_build(corners, 0, 3, cube, 1, NULL, NULL, &triangle) == ABUT_OK);
    CHECK(abut_walk_mesh_build(corners, 0, 2, cube, 1, NULL, NULL, &none) == ABUT_INDEX_OUT_OF_RANGE && none == NULL);
    abut_buffer_release(buffer);
    abut_walk_mesh_release(triangle);
    abut_walk_mesh_release(loaded);
    abut_walk_mesh_release(mesh);
}

static void query_bake(abut_shape3* const* shapes) {
    abut_shapes3* parts = NULL;
    abut_shape3 *part = NULL, *whole = NULL;
    uint32_t count = 0;
    MUST(abut_decompose_mesh(shapes[10], NULL, &parts));
    MUST(abut_shapes3_size(parts, &count));
    CHECK(count == expected_parts());
    MUST(abut_shapes3_get(parts, 0, &part));
    abut_measures3 measures;
    MUST(abut_shape3_measures(part, &measures));
    CHECK(measures.volume == 8 && measures.rank == 3);
    uint32_t triangles[64];
    MUST(abut_shape3_triangles(part, triangles, 12, &count));
    CHECK(count == 12);
    MUST(abut_shape3_triangles(shapes[10], triangles, 12, &count));
    CHECK(count == 12 && memcmp(triangles, cube, sizeof(cube)) == 0);
    MUST(abut_shapes3_compound(parts, &whole));
    CHECK(abut_shapes3_get(parts, 1, &part) == ABUT_INDEX_OUT_OF_RANGE);
    CHECK(abut_decompose_mesh(shapes[0], NULL, &parts) == ABUT_WRONG_SHAPE);
    abut_shape3_release(part);
    abut_shape3_release(whole);
    abut_shapes3_release(parts);

    const abut_vec2 outline[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {1, 3}};
    const uint32_t ends[] = {4, 8}, wrong_ends[] = {4, 9};
    abut_shapes2* polygons = NULL;
    MUST(abut_decompose_outline(outline, 0, LENGTH(outline), ends, 2, 0, &polygons));
    double area = 0;
    MUST(abut_shapes2_size(polygons, &count));
    for (uint32_t i = 0; i < count; ++i) {
        abut_shape2* polygon = NULL;
        abut_measures2 size;
        MUST(abut_shapes2_get(polygons, i, &polygon));
        MUST(abut_shape2_measures(polygon, &size));
        area += size.area;
        abut_shape2_release(polygon);
    }
    CHECK(area == 12);
    abut_shapes2_release(polygons);
    CHECK(abut_decompose_outline(outline, 0, LENGTH(outline), wrong_ends, 2, 0, &polygons) == ABUT_INDEX_OUT_OF_RANGE);
    CHECK(strcmp(abut_last_error(), "ends[1] does not ascend up to the number of points") == 0);
}

int main(void) {
    abut_shape2* shapes2[shape_count2];
    abut_shape3* shapes3[shape_count3];
    abut_pose2 poses2[pose_count];
    abut_pose3 poses3[pose_count];
    make_scene2(shapes2);
    make_scene3(shapes3);
    make_poses2(poses2);
    make_poses3(poses3);
    other_shape2 = shapes3[0];
    other_shape3 = shapes2[0];

    query_pairs2(shapes2, shape_count2, poses2);
    query_pairs3(shapes3, shape_count3, poses3);
    query_one2(shapes2, shape_count2, poses2);
    query_one3(shapes3, shape_count3, poses3);
    query_polytopes2(shapes2, shape_count2);
    query_polytopes3(shapes3, shape_count3);
    query_world2(shapes2, poses2);
    query_world3(shapes3, poses3);
    give_bad_input2(shapes2, poses2);
    give_bad_input3(shapes3, poses3);

    abut_field_options options;
    abut_field2* field2 = NULL;
    abut_field3* field3 = NULL;
    const uint32_t ends[] = {LENGTH(loop_points)};
    MUST(abut_field_options_default(&options));
    options.cell = 0.125f;
    MUST(abut_field2_bake_outline(loop_points, 0, LENGTH(loop_points), ends, 1, &options, &field2));
    options.cell = 0.25f;
    MUST(abut_field3_bake(shapes3[10], &options, &field3));
    query_field2(shapes2[0], field2);
    query_field3(shapes3[0], field3);
    query_walk_mesh();
    query_bake(shapes3);

    release_scene2(shapes2, shape_count2);
    release_scene3(shapes3, shape_count3);
    if (failures == 0) printf("abut %s: all answers are those of C++\n", abut_version());
    return failures == 0 ? 0 : 1;
}
