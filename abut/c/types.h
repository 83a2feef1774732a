#pragma once

// The values of the C API: result codes, vectors, poses, rays and motions.
//
// Rules of all functions:
// - A function returns ABUT_OK or another code. Then `abut_last_error` says what is wrong, and no output was written.
// - Structs are plain values of floats and 32-bit integers, passed by value. They lie in memory as those of C++ do.
// - Handles are pointers to opaque structs. A function that makes one writes it to a pointer to a pointer; the matching
//   `_release` frees it, and accepts null. Handles that a function takes are not owned by it: a world, a compound or a
//   placed shape has its own copy, which shares the data.
// - ABUT_ARRAY(n) marks a pointer to an array of n elements, and ABUT_OPTIONAL one that may be null. An array of n = 0
//   elements may be null. A stride is the distance of two elements in bytes; 0 means that they are adjacent.
// - A list of unknown length is written to an array `out` of `capacity` elements. `count` receives the full length. If
//   it is above the capacity, only the first `capacity` elements are written.
// - Options are passed by pointer; null means the defaults, which `abut_..._default` writes.
// - Functions that take their handles as const may be called from several threads at once, the others may not.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(ABUT_C_BUILD_SHARED)
#define ABUT_API __declspec(dllexport)
#elif defined(_WIN32) && defined(ABUT_C_SHARED)
#define ABUT_API __declspec(dllimport)
#elif defined(__GNUC__)
#define ABUT_API __attribute__((visibility("default")))
#else
#define ABUT_API
#endif

#ifdef __cplusplus
#define ABUT_C_BEGIN extern "C" {
#define ABUT_C_END }
#else
#define ABUT_C_BEGIN
#define ABUT_C_END
#endif

#define ABUT_ARRAY(count)
#define ABUT_OPTIONAL

ABUT_C_BEGIN

/// The result of a call.
typedef enum abut_code {
    ABUT_OK = 0,
    ABUT_EMPTY_INPUT = 1,         ///< nothing to build from
    ABUT_NOT_FINITE = 2,          ///< a number is NaN or infinite
    ABUT_INDEX_OUT_OF_RANGE = 3,  ///< an index names nothing
    ABUT_DEGENERATE = 4,          ///< a piece without extent where one is needed, such as a triangle of zero area
    ABUT_BAD_ARGUMENT = 5,        ///< a number outside its limits
    ABUT_NOT_FOUND = 6,           ///< a snapshot names a shape that the world hasn't
    ABUT_UNREADABLE = 7,          ///< a file is there and can't be read
    ABUT_BAD_FORMAT = 8,          ///< bytes are not what they claim to be
    ABUT_TOO_LARGE = 9,           ///< over a stated limit
    ABUT_CANCELLED = 10,          ///< the caller stopped the work
    ABUT_NULL_ARGUMENT = 11,      ///< a pointer is null that must not be
    ABUT_WRONG_HANDLE = 12,       ///< a handle of another type or dimension, or one that was released
    ABUT_WRONG_SHAPE = 13,        ///< the question doesn't exist for shapes of this kind
    ABUT_STALE_ID = 14,           ///< the world has no item of this id
    ABUT_OUT_OF_MEMORY = 15       ///< an allocation failed
} abut_code;

/// One line about the last call on this thread that failed, without a full stop; empty if none has. It is valid until
/// the next failure.
ABUT_API const char* abut_last_error(void);

/// The index of the offending element of the input of that call, if there is one; else 0.
ABUT_API uint32_t abut_last_error_index(void);

/// The version of the library, such as "0.1.0".
ABUT_API const char* abut_version(void);

/// 0 or 1, as a member of a struct.
typedef uint32_t abut_flag;

/// A point or vector of the plane.
typedef struct abut_vec2 {
    float x;
    float y;
} abut_vec2;

/// A point or vector of space.
typedef struct abut_vec3 {
    float x;
    float y;
    float z;
} abut_vec3;

/// A rotation in the plane, counter-clockwise.
typedef struct abut_turn {
    float cos;
    float sin;
} abut_turn;

/// A rotation in space: a unit quaternion.
typedef struct abut_quat {
    float x;
    float y;
    float z;
    float w;
} abut_quat;

/// A rigid transform of the plane: a rotation about the origin, then a translation. Rotations are normalised; all zeros
/// are no rotation.
typedef struct abut_pose2 {
    abut_vec2 position;
    abut_turn rotation;
} abut_pose2;

/// A rigid transform of space: a rotation about the origin, then a translation.
typedef struct abut_pose3 {
    abut_vec3 position;
    abut_quat rotation;
} abut_pose3;

/// An axis-aligned box.
typedef struct abut_aabb2 {
    abut_vec2 min;
    abut_vec2 max;
} abut_aabb2;

/// An axis-aligned box.
typedef struct abut_aabb3 {
    abut_vec3 min;
    abut_vec3 max;
} abut_aabb3;

/// A ray: its direction is a unit vector, its length may be infinite.
typedef struct abut_ray2 {
    abut_vec2 origin;
    abut_vec2 direction;
    float length;
} abut_ray2;

/// A ray: its direction is a unit vector, its length may be infinite.
typedef struct abut_ray3 {
    abut_vec3 origin;
    abut_vec3 direction;
    float length;
} abut_ray3;

/// A motion in the plane at constant velocity, with a rotation by `turn` radians about the moving position.
typedef struct abut_motion2 {
    abut_pose2 from;
    abut_vec2 move;
    float turn;
} abut_motion2;

/// A motion in space at constant velocity, with a rotation about the moving position: axis times angle in radians.
typedef struct abut_motion3 {
    abut_pose3 from;
    abut_vec3 move;
    abut_vec3 turn;
} abut_motion3;

/// The rotation by an angle in radians; the same bits on every machine.
ABUT_API abut_code abut_turn_by(float radians, abut_turn* out);

/// The rotation by an angle in radians about an axis of length 1; the same bits on every machine.
ABUT_API abut_code abut_turn_about(abut_vec3 axis, float radians, abut_quat* out);

/// The ray from a to b. If they are equal it has length 0 and an arbitrary direction.
ABUT_API abut_code abut_ray2_between(abut_vec2 a, abut_vec2 b, abut_ray2* out);
ABUT_API abut_code abut_ray3_between(abut_vec3 a, abut_vec3 b, abut_ray3* out);

/// The motion between two poses by the shortest rotation, at most half a turn.
ABUT_API abut_code abut_motion2_between(abut_pose2 from, abut_pose2 to, abut_motion2* out);
ABUT_API abut_code abut_motion3_between(abut_pose3 from, abut_pose3 to, abut_motion3* out);

/// The pose at a fraction of a motion.
ABUT_API abut_code abut_motion2_pose_at(abut_motion2 motion, float fraction, abut_pose2* out);
ABUT_API abut_code abut_motion3_pose_at(abut_motion3 motion, float fraction, abut_pose3* out);

/// Bytes that the library writes: a file or a snapshot. A buffer that is used again allocates only if it is too small.
typedef struct abut_buffer abut_buffer;

/// An empty buffer.
ABUT_API abut_code abut_buffer_create(abut_buffer** out);

/// The bytes; valid until the buffer is written again or released. Null if there are none.
ABUT_API const uint8_t* abut_buffer_data(ABUT_OPTIONAL const abut_buffer* buffer);

/// The number of bytes.
ABUT_API size_t abut_buffer_size(ABUT_OPTIONAL const abut_buffer* buffer);

/// Frees a buffer.
ABUT_API void abut_buffer_release(ABUT_OPTIONAL abut_buffer* buffer);

/// Threads for calls that take a pool. Answers don't depend on it, bit by bit.
typedef struct abut_thread_pool abut_thread_pool;

/// A pool of so many threads, the calling one included, and at most 1,024; 0: as many as the machine runs at the same
/// time.
ABUT_API abut_code abut_thread_pool_create(uint32_t workers, abut_thread_pool** out);

/// Ends the threads of a pool.
ABUT_API void abut_thread_pool_release(ABUT_OPTIONAL abut_thread_pool* pool);

ABUT_C_END
