#pragma once

// The past of a world, for lag compensation.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The last ticks of a world of the plane.
typedef struct abut_play_history2 abut_play_history2;

/// Holds up to so many ticks. The world must not be released before it.
ABUT_API abut_code abut_play_history2_create(const abut_world2* world, uint32_t ticks, uint64_t layers,
                                             abut_play_history2** out);

/// Frees it.
ABUT_API void abut_play_history2_release(ABUT_OPTIONAL abut_play_history2* history);

/// Records the world as it is now.
ABUT_API abut_code abut_play_history2_record(abut_play_history2* history);

/// The oldest tick that it holds, and the newest.
ABUT_API abut_code abut_play_history2_ticks(const abut_play_history2* history, uint32_t* first, uint32_t* last);

/// A copy of the world at a tick, or at a fraction of the way to the next one.
ABUT_API abut_code abut_play_history2_at(abut_play_history2* history, uint32_t tick, float fraction, abut_world2** out);

ABUT_C_END
