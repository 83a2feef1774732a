#pragma once

// Disassembly orders and rearrangements of convex shapes, as JSON.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The order in which convex shapes can leave along a direction: {"order": [numbers], "cycle": [numbers]}.
ABUT_API abut_code abut_play_removal_order2(ABUT_ARRAY(count) const abut_shape2* const* shapes, uint32_t count,
                                            abut_vec2 direction, abut_buffer* out);
ABUT_API abut_code abut_play_removal_order3(ABUT_ARRAY(count) const abut_shape3* const* shapes, uint32_t count,
                                            abut_vec3 direction, abut_buffer* out);

/// The moves from one arrangement of convex shapes to another: {"moves": [{"shape": number, "from": pose, "to": pose}],
/// "stuck": [numbers], "overlapping": [numbers]}. Shapes that overlap by more than the tolerance in either arrangement
/// are listed as overlapping; then there is no plan.
ABUT_API abut_code abut_play_rearrange2(ABUT_ARRAY(count) const abut_shape2* const* shapes, uint32_t count,
                                        ABUT_ARRAY(count) const abut_pose2* from,
                                        ABUT_ARRAY(count) const abut_pose2* to, abut_vec2 away, abut_buffer* out);
ABUT_API abut_code abut_play_rearrange3(ABUT_ARRAY(count) const abut_shape3* const* shapes, uint32_t count,
                                        ABUT_ARRAY(count) const abut_pose3* from,
                                        ABUT_ARRAY(count) const abut_pose3* to, abut_vec3 away, abut_buffer* out);

ABUT_C_END
