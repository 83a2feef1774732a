#pragma once

// The shapes and places that the C program and the C++ helper build alike, each by its own API.

#include <abut/c/abut.h>

ABUT_C_BEGIN

enum { shape_count2 = 16, shape_count3 = 20, pose_count = 9 };

static const abut_ball2 ball2 = {{0.3f, -0.2f}, 0.75f};
static const abut_capsule2 capsule2 = {{-0.5f, 0.1f}, {0.6f, 0.4f}, 0.3f};
static const abut_box2 box2 = {{0.1f, 0.2f}, {0.8f, 0.4f}, {0.8f, 0.6f}};
static const abut_aabb2 aabb2 = {{-0.7f, -0.3f}, {0.4f, 0.9f}};
static const abut_segment2 segment2 = {{-1, -0.5f}, {0.75f, 1}};
static const abut_triangle2 triangle2 = {{-1, -0.5f}, {1, 0}, {0.25f, 1}};
static const abut_half_space2 half_space2 = {{0.6f, 0.8f}, -0.25f};
static const abut_vec2 polygon_points[] = {{-1, 0}, {0, -0.8f}, {0.9f, 0.1f}, {0.5f, 0.9f}, {-0.6f, 0.7f}, {0, 0}};
static const abut_vec2 chain_points[] = {{-2, 0}, {-0.5f, -0.3f}, {0.5f, 0.25f}, {2, 0}};
static const abut_vec2 loop_points[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
static const uint32_t loop_faces[] = {0, 1, 1, 2, 2, 3, 3, 0};
static const uint8_t tiles[] = {ABUT_TILE_FULL, ABUT_TILE_FULL,           ABUT_TILE_SLOPE_LOW_X_LOW_Y,
                                ABUT_TILE_FULL, ABUT_TILE_ONE_WAY_HIGH_Y, ABUT_TILE_EMPTY};
static const abut_half_space2 brush_sides2[] = {{{1, 0}, 1}, {{-1, 0}, 1}, {{0, 1}, 0.5f}, {{0, -1}, 0.5f}};
static const uint32_t brush_ends2[] = {4};

static const abut_ball3 ball3 = {{0.3f, -0.2f, 0.1f}, 0.75f};
static const abut_capsule3 capsule3 = {{-0.5f, 0.1f, 0}, {0.6f, 0.4f, -0.3f}, 0.3f};
static const abut_box3 box3 = {{0.1f, 0.2f, 0}, {0.8f, 0.4f, 0.5f}, {0.5f, 0.5f, 0.5f, 0.5f}};
static const abut_aabb3 aabb3 = {{-0.7f, -0.3f, -0.2f}, {0.4f, 0.9f, 0.6f}};
static const abut_segment3 segment3 = {{-1, -0.5f, 0.2f}, {0.75f, 1, -0.4f}};
static const abut_triangle3 triangle3 = {{-1, -0.5f, 0}, {1, 0, 0.5f}, {0.25f, 1, 0}};
static const abut_half_space3 half_space3 = {{0, 0.6f, 0.8f}, -0.25f};
static const abut_cylinder cylinder = {{0, 0, -0.5f}, {0.2f, 0.1f, 0.75f}, 0.6f};
static const abut_cone cone = {{0, 0, -0.5f}, {0.1f, 0.2f, 1}, 0.7f};
static const abut_vec3 corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const uint32_t cube[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const float heights[] = {0, 0.2f, 0.1f, 0.3f, 0, 0.4f, 0.1f, 0, 0.2f};
static const uint32_t holes[] = {3};
static const uint8_t voxels[] = {1, 0, 1, 1, 0, 0, 1, 1};
static const abut_half_space3 brush_sides3[] = {{{1, 0, 0}, 1},     {{-1, 0, 0}, 1},    {{0, 1, 0}, 0.5f},
                                                {{0, -1, 0}, 0.5f}, {{0, 0, 1}, 0.25f}, {{0, 0, -1}, 0.25f}};
static const uint32_t brush_ends3[] = {6};

static const abut_pose2 tilted2 = {{0.25f, -0.5f}, {0.6f, -0.8f}};
static const abut_pose3 tilted3 = {{0.25f, -0.5f, 0.125f}, {0.1f, -0.3f, 0.5f, 0.8f}};
static const abut_vec2 scale2 = {1.5f, -0.5f};
static const abut_vec3 scale3 = {1.5f, -0.5f, 0.75f};

ABUT_C_END
