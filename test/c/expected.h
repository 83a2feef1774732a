#pragma once

// The answers of the C++ API to the questions of the C program. Shapes are named by their place in the scene.

#include "scene.h"

ABUT_C_BEGIN

#define EXPECTED(D)                                                                                                  \
    bool expected_overlaps##D(int a, int b, abut_pose##D pose);                                                      \
    abut_closest##D expected_closest##D(int a, int b, abut_pose##D pose);                                            \
    abut_closest##D expected_closest_to_point##D(int a, abut_vec##D point);                                          \
    abut_contact##D expected_contact##D(int a, int b, abut_pose##D pose, float margin);                              \
    uint32_t expected_each_contact##D(int a, int b, abut_pose##D pose, abut_contact##D* out, uint32_t capacity);     \
    abut_hit##D expected_sweep##D(int a, abut_vec##D motion_a, int b, abut_vec##D motion_b, abut_pose##D pose);      \
    abut_hit##D expected_sweep_motion##D(int a, abut_motion##D motion_a, int b, abut_motion##D motion_b);            \
    abut_hit##D expected_raycast##D(int a, abut_ray##D ray);                                                         \
    uint32_t expected_raycast_all##D(int a, abut_ray##D ray, abut_hit##D* out, uint32_t capacity);                   \
    bool expected_contains##D(int a, abut_vec##D point);                                                             \
    double expected_certificate##D(int a, int b, abut_pose##D pose, bool* holds);                                    \
    abut_aabb##D expected_bounds##D(int a);                                                                          \
    bool expected_intersection##D(int a, int b, abut_vec##D* out, uint32_t capacity, uint32_t* count);               \
    uint32_t expected_minkowski##D(int a, int b, bool difference, abut_vec##D* out, uint32_t capacity);              \
    bool is_polytope##D(int a);                                                                                      \
    void expected_world##D(const abut_pose##D* poses, abut_ray##D ray, abut_vec##D point, abut_id_pair* began,       \
                           uint32_t capacity, uint32_t* began_count, uint32_t* contact_count,                        \
                           abut_world_contact##D* first, abut_world_hit##D* hit, abut_world_closest##D* closest);    \
    void expected_field##D(abut_vec##D point, abut_vec##D light, abut_field_sample##D* sample, abut_vec##D* closest, \
                           float* shadow);
EXPECTED(2)
EXPECTED(3)

void expected_walk(abut_vec3 point, abut_vec3 step, abut_walked* walked);
uint32_t expected_path(abut_vec3 from, abut_vec3 to, abut_vec3* out, uint32_t capacity, double* length);
uint32_t expected_parts(void);

ABUT_C_END
