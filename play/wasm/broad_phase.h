#pragma once

// Boxes that move, and the broad phases over them.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// Boxes of the plane that move, and a structure that finds their pairs.
typedef struct abut_play_broad_phase abut_play_broad_phase;

/// Without boxes. Structures 0 to 5 are those of BroadPhaseKind; 6 is a Temporal over a Grid.
ABUT_API abut_code abut_play_broad_phase_create(uint32_t structure, abut_play_broad_phase** out);

/// Frees it.
ABUT_API void abut_play_broad_phase_release(ABUT_OPTIONAL abut_play_broad_phase* phase);

/// Replaces the boxes by those of scenes/moving_boxes.hpp: each overlaps so many others on average, of so many one
/// moves, and it moves at most by `speed` in a step along each axis.
ABUT_API abut_code abut_play_broad_phase_scatter(abut_play_broad_phase* phase, uint32_t count, float overlaps,
                                                 uint32_t one_in_moves, float speed);

/// Replaces the boxes by those of scenes/skewed_boxes.hpp: very different sizes, most of them in clusters.
ABUT_API abut_code abut_play_broad_phase_scatter_skewed(abut_play_broad_phase* phase, uint32_t count);

/// Moves the boxes by one step. The structure does not know of it before the next update.
ABUT_API abut_code abut_play_broad_phase_step(abut_play_broad_phase* phase);

/// Builds the structure from nothing.
ABUT_API abut_code abut_play_broad_phase_build(abut_play_broad_phase* phase);

/// Updates the structure: the boxes are where they are now.
ABUT_API abut_code abut_play_broad_phase_update(abut_play_broad_phase* phase);

/// Finds all pairs of boxes that overlap, and returns their number.
ABUT_API abut_code abut_play_broad_phase_find_pairs(abut_play_broad_phase* phase, uint32_t* out);

/// The boxes: floats, the lower corner and the upper one of each.
ABUT_API abut_code abut_play_broad_phase_boxes(const abut_play_broad_phase* phase, abut_buffer* out);

/// The pairs found last: two indices each.
ABUT_API abut_code abut_play_broad_phase_pairs(const abut_play_broad_phase* phase, abut_buffer* out);

/// A box around all boxes.
ABUT_API abut_code abut_play_broad_phase_bounds(const abut_play_broad_phase* phase, abut_aabb2* out);

/// The inner lines of the structure: floats, the level and both ends of each line. Level 0 is the root of a tree or the
/// finest grid.
ABUT_API abut_code abut_play_broad_phase_lines(const abut_play_broad_phase* phase, abut_buffer* out);

/// The items that overlap a box, as the structure finds them: indices.
ABUT_API abut_code abut_play_broad_phase_overlapping(const abut_play_broad_phase* phase, abut_aabb2 box,
                                                     abut_buffer* out);

/// The items that the structure does not rule out for a box: those in the cells, leaves or intervals that it reaches.
ABUT_API abut_code abut_play_broad_phase_candidates(const abut_play_broad_phase* phase, abut_aabb2 box,
                                                    abut_buffer* out);

/// The number of pairs that the structure does not rule out. A pair counts half for each of its boxes that reaches the
/// other.
ABUT_API abut_code abut_play_broad_phase_candidate_pairs(const abut_play_broad_phase* phase, double* out);

/// For a Temporal: the time in steps before which nothing about an item can change, 0 where it may at once. A float for
/// each item.
ABUT_API abut_code abut_play_broad_phase_not_before(const abut_play_broad_phase* phase, abut_buffer* out);

/// For a Temporal: the top speed of each item, a float.
ABUT_API abut_code abut_play_broad_phase_top_speeds(const abut_play_broad_phase* phase, abut_buffer* out);

/// For a Temporal: its TemporalCounts as JSON.
ABUT_API abut_code abut_play_broad_phase_counts(const abut_play_broad_phase* phase, abut_buffer* out);

ABUT_C_END
