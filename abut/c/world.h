#pragma once

// A collision world: shapes by id, the pairs that touch with each update, and questions about all items.

#include <abut/c/query.h>

ABUT_C_BEGIN

/// A collision world of the plane.
typedef struct abut_world2 abut_world2;

/// A collision world of space.
typedef struct abut_world3 abut_world3;

/// Identifies an item. All zeros are null. No other item gets the id of a removed one.
typedef struct abut_id {
    uint32_t index;       ///< starts at 1 and stays small, so that it can index arrays
    uint32_t generation;  ///< distinguishes the items that use this index one after another
} abut_id;

/// Identifies a pair of items, a < b.
typedef struct abut_id_pair {
    abut_id a;
    abut_id b;
} abut_id_pair;

/// The layers that an item is on, and those that it pairs with, one bit each. Both items must agree.
typedef struct abut_layers {
    uint64_t layers;
    uint64_t mask;
} abut_layers;

/// The options of a world.
typedef struct abut_world_options {
    abut_flag filter_edges;  ///< whether contacts have the normals of the surface that neighbours form; by default 1
} abut_world_options;

/// The options of an item.
typedef struct abut_item_options2 {
    abut_pose2 pose;       ///< by default the identity
    uint64_t user;         ///< free for the game's use; by default 0
    uint64_t layers;       ///< by default 1
    uint64_t mask;         ///< by default all bits
    abut_flag fixed;       ///< seldom moves; two fixed items never pair; by default 0
    abut_flag sensor;      ///< has events and no contacts; queries skip it by default; by default 0
    abut_flag continuous;  ///< the events include all that it touches between two updates; by default 0
    int32_t group;      ///< items of one group pair always if it is above 0, and never if it is below 0; by default 0
    abut_flag enabled;  ///< if 0, it neither pairs nor is found; by default 1
} abut_item_options2;

/// The options of an item.
typedef struct abut_item_options3 {
    abut_pose3 pose;       ///< by default the identity
    uint64_t user;         ///< free for the game's use; by default 0
    uint64_t layers;       ///< by default 1
    uint64_t mask;         ///< by default all bits
    abut_flag fixed;       ///< seldom moves; two fixed items never pair; by default 0
    abut_flag sensor;      ///< has events and no contacts; queries skip it by default; by default 0
    abut_flag continuous;  ///< the events include all that it touches between two updates; by default 0
    int32_t group;      ///< items of one group pair always if it is above 0, and never if it is below 0; by default 0
    abut_flag enabled;  ///< if 0, it neither pairs nor is found; by default 1
} abut_item_options3;

/// Whether a query takes an item into account. It must not change the world.
typedef bool (*abut_accepts)(void* context, abut_id id);

/// Whether two items pair, a < b. It must not change the world.
typedef bool (*abut_accepts_pair)(void* context, abut_id a, abut_id b);

/// The items that a query takes into account.
typedef struct abut_filter {
    uint64_t layers;            ///< by default all bits
    uint64_t mask;              ///< by default all bits
    abut_flag sensors;          ///< whether the query finds sensors as well; by default 0
    abut_id ignore;             ///< an item to skip; by default null
    uint32_t ignore_count;      ///< by default 0
    const abut_id* ignore_ids;  ///< more items to skip: `ignore_count` of them; by default null
    abut_accepts accepts;       ///< null, or called last, for items near the query; on the threads of a pool
    void* context;              ///< passed to `accepts`
} abut_filter;

/// The changes of an update. The lists are sorted and valid until the world's next update, or until it is released.
typedef struct abut_events {
    const abut_id_pair* began;   ///< pairs that touch now and did not before
    const float* fractions;      ///< of each of `began`: its time of impact as a fraction of the motion
    const abut_id_pair* stayed;  ///< pairs that touch now and did before
    const abut_id_pair* ended;   ///< pairs that no longer touch
    uint32_t began_count;
    uint32_t stayed_count;
    uint32_t ended_count;
} abut_events;

/// A contact of two items, from a to b.
typedef struct abut_world_contact2 {
    abut_id a;
    abut_id b;
    abut_contact2 contact;
} abut_world_contact2;

/// A contact of two items, from a to b.
typedef struct abut_world_contact3 {
    abut_id a;
    abut_id b;
    abut_contact3 contact;
} abut_world_contact3;

/// The impact of two items between two updates; the hit is that of a.
typedef struct abut_world_impact2 {
    abut_id a;
    abut_id b;
    abut_hit2 hit;
} abut_world_impact2;

/// The impact of two items between two updates; the hit is that of a.
typedef struct abut_world_impact3 {
    abut_id a;
    abut_id b;
    abut_hit3 hit;
} abut_world_impact3;

/// A hit, and the item that is hit. If nothing is, all is 0.
typedef struct abut_world_hit2 {
    abut_id id;
    abut_hit2 hit;
} abut_world_hit2;

/// A hit, and the item that is hit. If nothing is, all is 0.
typedef struct abut_world_hit3 {
    abut_id id;
    abut_hit3 hit;
} abut_world_hit3;

/// An item, and the closest points of the query (A) and the item (B). If there is none, all is 0.
typedef struct abut_world_closest2 {
    abut_id id;
    abut_closest2 closest;
} abut_world_closest2;

/// An item, and the closest points of the query (A) and the item (B). If there is none, all is 0.
typedef struct abut_world_closest3 {
    abut_id id;
    abut_closest3 closest;
} abut_world_closest3;

/// Writes the defaults.
ABUT_API abut_code abut_world_options_default(abut_world_options* out);

/// Writes the defaults.
ABUT_API abut_code abut_item_options2_default(abut_item_options2* out);
ABUT_API abut_code abut_item_options3_default(abut_item_options3* out);

/// Writes the defaults.
ABUT_API abut_code abut_filter_default(abut_filter* out);

/// An empty world.
ABUT_API abut_code abut_world2_create(ABUT_OPTIONAL const abut_world_options* options, abut_world2** out);
ABUT_API abut_code abut_world3_create(ABUT_OPTIONAL const abut_world_options* options, abut_world3** out);

/// A copy, which shares the shapes and answers as the original does.
ABUT_API abut_code abut_world2_copy(const abut_world2* world, abut_world2** out);
ABUT_API abut_code abut_world3_copy(const abut_world3* world, abut_world3** out);

/// Frees a world.
ABUT_API void abut_world2_release(ABUT_OPTIONAL abut_world2* world);
ABUT_API void abut_world3_release(ABUT_OPTIONAL abut_world3* world);

/// Adds an item with a copy of the shape, which shares its data.
ABUT_API abut_code abut_world2_add(abut_world2* world, const abut_shape2* shape,
                                   ABUT_OPTIONAL const abut_item_options2* options, abut_id* out);
ABUT_API abut_code abut_world3_add(abut_world3* world, const abut_shape3* shape,
                                   ABUT_OPTIONAL const abut_item_options3* options, abut_id* out);

/// Adds an item for each of the options, with one shape that they share.
ABUT_API abut_code abut_world2_add_many(abut_world2* world, const abut_shape2* shape,
                                        ABUT_ARRAY(count) const abut_item_options2* options, uint32_t stride,
                                        uint32_t count, ABUT_ARRAY(count) abut_id* out);
ABUT_API abut_code abut_world3_add_many(abut_world3* world, const abut_shape3* shape,
                                        ABUT_ARRAY(count) const abut_item_options3* options, uint32_t stride,
                                        uint32_t count, ABUT_ARRAY(count) abut_id* out);

/// Moves an item to a pose.
ABUT_API abut_code abut_world2_move(abut_world2* world, abut_id id, abut_pose2 pose);
ABUT_API abut_code abut_world3_move(abut_world3* world, abut_id id, abut_pose3 pose);

/// Moves many items, each to its pose. If an id is stale or a pose isn't finite, none moves.
ABUT_API abut_code abut_world2_move_many(abut_world2* world, ABUT_ARRAY(count) const abut_id* ids, uint32_t id_stride,
                                         ABUT_ARRAY(count) const abut_pose2* poses, uint32_t pose_stride,
                                         uint32_t count);
ABUT_API abut_code abut_world3_move_many(abut_world3* world, ABUT_ARRAY(count) const abut_id* ids, uint32_t id_stride,
                                         ABUT_ARRAY(count) const abut_pose3* poses, uint32_t pose_stride,
                                         uint32_t count);

/// Gives an item another shape.
ABUT_API abut_code abut_world2_set_shape(abut_world2* world, abut_id id, const abut_shape2* shape);
ABUT_API abut_code abut_world3_set_shape(abut_world3* world, abut_id id, const abut_shape3* shape);

/// Sets the layers and the mask of an item.
ABUT_API abut_code abut_world2_set_filter(abut_world2* world, abut_id id, abut_layers layers);
ABUT_API abut_code abut_world3_set_filter(abut_world3* world, abut_id id, abut_layers layers);

/// Sets the user's number of an item.
ABUT_API abut_code abut_world2_set_user(abut_world2* world, abut_id id, uint64_t user);
ABUT_API abut_code abut_world3_set_user(abut_world3* world, abut_id id, uint64_t user);

/// Sets whether an item is fixed.
ABUT_API abut_code abut_world2_set_fixed(abut_world2* world, abut_id id, bool fixed);
ABUT_API abut_code abut_world3_set_fixed(abut_world3* world, abut_id id, bool fixed);

/// Sets whether an item is a sensor.
ABUT_API abut_code abut_world2_set_sensor(abut_world2* world, abut_id id, bool sensor);
ABUT_API abut_code abut_world3_set_sensor(abut_world3* world, abut_id id, bool sensor);

/// Sets whether an item is continuous.
ABUT_API abut_code abut_world2_set_continuous(abut_world2* world, abut_id id, bool continuous);
ABUT_API abut_code abut_world3_set_continuous(abut_world3* world, abut_id id, bool continuous);

/// Sets the group of an item.
ABUT_API abut_code abut_world2_set_group(abut_world2* world, abut_id id, int32_t group);
ABUT_API abut_code abut_world3_set_group(abut_world3* world, abut_id id, int32_t group);

/// Sets whether an item is enabled.
ABUT_API abut_code abut_world2_set_enabled(abut_world2* world, abut_id id, bool enabled);
ABUT_API abut_code abut_world3_set_enabled(abut_world3* world, abut_id id, bool enabled);

/// From the next update on, two items pair only if this accepts them as well; null: all. Copies have it too.
ABUT_API abut_code abut_world2_set_pair_filter(abut_world2* world, ABUT_OPTIONAL abut_accepts_pair accepts,
                                               ABUT_OPTIONAL void* context);
ABUT_API abut_code abut_world3_set_pair_filter(abut_world3* world, ABUT_OPTIONAL abut_accepts_pair accepts,
                                               ABUT_OPTIONAL void* context);

/// Removes an item.
ABUT_API abut_code abut_world2_remove(abut_world2* world, abut_id id);
ABUT_API abut_code abut_world3_remove(abut_world3* world, abut_id id);

/// Removes many items. If an id is stale, none is removed.
ABUT_API abut_code abut_world2_remove_many(abut_world2* world, ABUT_ARRAY(count) const abut_id* ids, uint32_t stride,
                                           uint32_t count);
ABUT_API abut_code abut_world3_remove_many(abut_world3* world, ABUT_ARRAY(count) const abut_id* ids, uint32_t stride,
                                           uint32_t count);

/// Whether the world has an item of this id.
ABUT_API abut_code abut_world2_contains(const abut_world2* world, abut_id id, bool* out);
ABUT_API abut_code abut_world3_contains(const abut_world3* world, abut_id id, bool* out);

/// The number of items.
ABUT_API abut_code abut_world2_size(const abut_world2* world, uint32_t* out);
ABUT_API abut_code abut_world3_size(const abut_world3* world, uint32_t* out);

/// The ids of all items, sorted by index.
ABUT_API abut_code abut_world2_items(const abut_world2* world, ABUT_ARRAY(capacity) abut_id* out, uint32_t capacity,
                                     uint32_t* count);
ABUT_API abut_code abut_world3_items(const abut_world3* world, ABUT_ARRAY(capacity) abut_id* out, uint32_t capacity,
                                     uint32_t* count);

/// The pose and all other options of an item.
ABUT_API abut_code abut_world2_options(const abut_world2* world, abut_id id, abut_item_options2* out);
ABUT_API abut_code abut_world3_options(const abut_world3* world, abut_id id, abut_item_options3* out);

/// The shape of an item in its own frame, without the pose.
ABUT_API abut_code abut_world2_shape(const abut_world2* world, abut_id id, abut_shape2** out);
ABUT_API abut_code abut_world3_shape(const abut_world3* world, abut_id id, abut_shape3** out);

/// Writes a snapshot for `restore`: all but the shapes, which it names by their hashes.
ABUT_API abut_code abut_world2_save(abut_world2* world, abut_buffer* out);
ABUT_API abut_code abut_world3_save(abut_world3* world, abut_buffer* out);

/// Returns to the state of a snapshot, bit by bit. If the bytes are no such snapshot (BAD_FORMAT) or the world hasn't
/// one of the shapes (NOT_FOUND), it is unchanged.
ABUT_API abut_code abut_world2_restore(abut_world2* world, ABUT_ARRAY(size) const uint8_t* bytes, size_t size);
ABUT_API abut_code abut_world3_restore(abut_world3* world, ABUT_ARRAY(size) const uint8_t* bytes, size_t size);

/// Writes a snapshot with the shapes, for `load`.
ABUT_API abut_code abut_world2_save_with_shapes(abut_world2* world, abut_buffer* out);
ABUT_API abut_code abut_world3_save_with_shapes(abut_world3* world, abut_buffer* out);

/// The world that `save_with_shapes` has written.
ABUT_API abut_code abut_world2_load(ABUT_ARRAY(size) const uint8_t* bytes, size_t size,
                                    ABUT_OPTIONAL const abut_world_options* options, abut_world2** out);
ABUT_API abut_code abut_world3_load(ABUT_ARRAY(size) const uint8_t* bytes, size_t size,
                                    ABUT_OPTIONAL const abut_world_options* options, abut_world3** out);

/// Finds all touching pairs, and how they changed since the last update.
ABUT_API abut_code abut_world2_update(abut_world2* world, ABUT_OPTIONAL abut_thread_pool* pool, abut_events* out);
ABUT_API abut_code abut_world3_update(abut_world3* world, ABUT_OPTIONAL abut_thread_pool* pool, abut_events* out);

/// Brings the broad phases up to date after many changes, so that queries are as fast as after an update. It is
/// optional.
ABUT_API abut_code abut_world2_refresh(abut_world2* world);
ABUT_API abut_code abut_world3_refresh(abut_world3* world);

/// The contacts of the last update, sorted by pairs.
ABUT_API abut_code abut_world2_contacts(const abut_world2* world, ABUT_ARRAY(capacity) abut_world_contact2* out,
                                        uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_world3_contacts(const abut_world3* world, ABUT_ARRAY(capacity) abut_world_contact3* out,
                                        uint32_t capacity, uint32_t* count);

/// The impacts of the last update, sorted by pairs: of continuous items that touched something during their motion.
ABUT_API abut_code abut_world2_impacts(const abut_world2* world, ABUT_ARRAY(capacity) abut_world_impact2* out,
                                       uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_world3_impacts(const abut_world3* world, ABUT_ARRAY(capacity) abut_world_impact3* out,
                                       uint32_t capacity, uint32_t* count);

/// The deepest contact of a pair at the last update; of no points if there is none.
ABUT_API abut_code abut_world2_contact(const abut_world2* world, abut_id_pair pair, abut_contact2* out);
ABUT_API abut_code abut_world3_contact(const abut_world3* world, abut_id_pair pair, abut_contact3* out);

/// The items that an item touched at the last update, sorted.
ABUT_API abut_code abut_world2_touching(const abut_world2* world, abut_id id, ABUT_ARRAY(capacity) abut_id* out,
                                        uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_world3_touching(const abut_world3* world, abut_id id, ABUT_ARRAY(capacity) abut_id* out,
                                        uint32_t capacity, uint32_t* count);

/// The first hit of a ray.
ABUT_API abut_code abut_world2_raycast(const abut_world2* world, abut_ray2 ray, ABUT_OPTIONAL const abut_filter* filter,
                                       abut_world_hit2* out);
ABUT_API abut_code abut_world3_raycast(const abut_world3* world, abut_ray3 ray, ABUT_OPTIONAL const abut_filter* filter,
                                       abut_world_hit3* out);

/// Whether a ray hits anything, such as for a line of sight.
ABUT_API abut_code abut_world2_raycast_any(const abut_world2* world, abut_ray2 ray,
                                           ABUT_OPTIONAL const abut_filter* filter, bool* out);
ABUT_API abut_code abut_world3_raycast_any(const abut_world3* world, abut_ray3 ray,
                                           ABUT_OPTIONAL const abut_filter* filter, bool* out);

/// The first hit of a ray on each item, front to back.
ABUT_API abut_code abut_world2_raycast_all(const abut_world2* world, abut_ray2 ray,
                                           ABUT_OPTIONAL const abut_filter* filter,
                                           ABUT_ARRAY(capacity) abut_world_hit2* out, uint32_t capacity,
                                           uint32_t* count);
ABUT_API abut_code abut_world3_raycast_all(const abut_world3* world, abut_ray3 ray,
                                           ABUT_OPTIONAL const abut_filter* filter,
                                           ABUT_ARRAY(capacity) abut_world_hit3* out, uint32_t capacity,
                                           uint32_t* count);

/// The first hit of a shape that moves straight.
ABUT_API abut_code abut_world2_sweep(const abut_world2* world, const abut_shape2* shape, abut_vec2 motion,
                                     ABUT_OPTIONAL const abut_filter* filter, abut_world_hit2* out);
ABUT_API abut_code abut_world3_sweep(const abut_world3* world, const abut_shape3* shape, abut_vec3 motion,
                                     ABUT_OPTIONAL const abut_filter* filter, abut_world_hit3* out);

/// The first hit of a shape that moves and rotates, given in the frame that the motion moves.
ABUT_API abut_code abut_world2_sweep_motion(const abut_world2* world, const abut_shape2* shape, abut_motion2 motion,
                                            ABUT_OPTIONAL const abut_filter* filter, abut_world_hit2* out);
ABUT_API abut_code abut_world3_sweep_motion(const abut_world3* world, const abut_shape3* shape, abut_motion3 motion,
                                            ABUT_OPTIONAL const abut_filter* filter, abut_world_hit3* out);

/// The item closest to a shape.
ABUT_API abut_code abut_world2_closest(const abut_world2* world, const abut_shape2* shape,
                                       ABUT_OPTIONAL const abut_filter* filter, abut_world_closest2* out);
ABUT_API abut_code abut_world3_closest(const abut_world3* world, const abut_shape3* shape,
                                       ABUT_OPTIONAL const abut_filter* filter, abut_world_closest3* out);

/// The item closest to a point.
ABUT_API abut_code abut_world2_closest_to_point(const abut_world2* world, abut_vec2 point,
                                                ABUT_OPTIONAL const abut_filter* filter, abut_world_closest2* out);
ABUT_API abut_code abut_world3_closest_to_point(const abut_world3* world, abut_vec3 point,
                                                ABUT_OPTIONAL const abut_filter* filter, abut_world_closest3* out);

/// The closest items, up to `capacity` of them, sorted by distance; `count` is their number.
ABUT_API abut_code abut_world2_k_nearest(const abut_world2* world, const abut_shape2* shape,
                                         ABUT_OPTIONAL const abut_filter* filter,
                                         ABUT_ARRAY(capacity) abut_world_closest2* out, uint32_t capacity,
                                         uint32_t* count);
ABUT_API abut_code abut_world3_k_nearest(const abut_world3* world, const abut_shape3* shape,
                                         ABUT_OPTIONAL const abut_filter* filter,
                                         ABUT_ARRAY(capacity) abut_world_closest3* out, uint32_t capacity,
                                         uint32_t* count);

/// The items that overlap a shape, sorted.
ABUT_API abut_code abut_world2_overlapping(const abut_world2* world, const abut_shape2* shape,
                                           ABUT_OPTIONAL const abut_filter* filter, ABUT_ARRAY(capacity) abut_id* out,
                                           uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_world3_overlapping(const abut_world3* world, const abut_shape3* shape,
                                           ABUT_OPTIONAL const abut_filter* filter, ABUT_ARRAY(capacity) abut_id* out,
                                           uint32_t capacity, uint32_t* count);

/// Calls `visit` for the items that overlap a shape, in an unspecified order, until it returns false. Allocates
/// nothing.
ABUT_API abut_code abut_world2_each_overlapping(const abut_world2* world, const abut_shape2* shape,
                                                ABUT_OPTIONAL const abut_filter* filter, abut_accepts visit,
                                                ABUT_OPTIONAL void* context);
ABUT_API abut_code abut_world3_each_overlapping(const abut_world3* world, const abut_shape3* shape,
                                                ABUT_OPTIONAL const abut_filter* filter, abut_accepts visit,
                                                ABUT_OPTIONAL void* context);

/// The contacts of a shape (A, as `a` a null id) with the items (B), as one surface, sorted by items.
ABUT_API abut_code abut_world2_each_contact(const abut_world2* world, const abut_shape2* shape,
                                            ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(capacity) abut_world_contact2* out, uint32_t capacity,
                                            uint32_t* count);
ABUT_API abut_code abut_world3_each_contact(const abut_world3* world, const abut_shape3* shape,
                                            ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL const abut_query_options* options,
                                            ABUT_ARRAY(capacity) abut_world_contact3* out, uint32_t capacity,
                                            uint32_t* count);

/// The items that contain a point, sorted.
ABUT_API abut_code abut_world2_containing(const abut_world2* world, abut_vec2 point,
                                          ABUT_OPTIONAL const abut_filter* filter, ABUT_ARRAY(capacity) abut_id* out,
                                          uint32_t capacity, uint32_t* count);
ABUT_API abut_code abut_world3_containing(const abut_world3* world, abut_vec3 point,
                                          ABUT_OPTIONAL const abut_filter* filter, ABUT_ARRAY(capacity) abut_id* out,
                                          uint32_t capacity, uint32_t* count);

/// The first hit of each of many rays.
ABUT_API abut_code abut_world2_raycast_many(const abut_world2* world, ABUT_ARRAY(count) const abut_ray2* rays,
                                            uint32_t stride, uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL abut_thread_pool* pool,
                                            ABUT_ARRAY(count) abut_world_hit2* out);
ABUT_API abut_code abut_world3_raycast_many(const abut_world3* world, ABUT_ARRAY(count) const abut_ray3* rays,
                                            uint32_t stride, uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL abut_thread_pool* pool,
                                            ABUT_ARRAY(count) abut_world_hit3* out);

/// The first hit of a shape in each of many motions.
ABUT_API abut_code abut_world2_sweep_many(const abut_world2* world, const abut_shape2* shape,
                                          ABUT_ARRAY(count) const abut_motion2* motions, uint32_t stride,
                                          uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                          ABUT_OPTIONAL abut_thread_pool* pool, ABUT_ARRAY(count) abut_world_hit2* out);
ABUT_API abut_code abut_world3_sweep_many(const abut_world3* world, const abut_shape3* shape,
                                          ABUT_ARRAY(count) const abut_motion3* motions, uint32_t stride,
                                          uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                          ABUT_OPTIONAL abut_thread_pool* pool, ABUT_ARRAY(count) abut_world_hit3* out);

/// The item closest to each of many points.
ABUT_API abut_code abut_world2_closest_to_points(const abut_world2* world, ABUT_ARRAY(count) const abut_vec2* points,
                                                 uint32_t stride, uint32_t count,
                                                 ABUT_OPTIONAL const abut_filter* filter,
                                                 ABUT_OPTIONAL abut_thread_pool* pool,
                                                 ABUT_ARRAY(count) abut_world_closest2* out);
ABUT_API abut_code abut_world3_closest_to_points(const abut_world3* world, ABUT_ARRAY(count) const abut_vec3* points,
                                                 uint32_t stride, uint32_t count,
                                                 ABUT_OPTIONAL const abut_filter* filter,
                                                 ABUT_OPTIONAL abut_thread_pool* pool,
                                                 ABUT_ARRAY(count) abut_world_closest3* out);

/// The item closest to a shape at each of many poses.
ABUT_API abut_code abut_world2_closest_many(const abut_world2* world, const abut_shape2* shape,
                                            ABUT_ARRAY(count) const abut_pose2* poses, uint32_t stride, uint32_t count,
                                            ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL abut_thread_pool* pool,
                                            ABUT_ARRAY(count) abut_world_closest2* out);
ABUT_API abut_code abut_world3_closest_many(const abut_world3* world, const abut_shape3* shape,
                                            ABUT_ARRAY(count) const abut_pose3* poses, uint32_t stride, uint32_t count,
                                            ABUT_OPTIONAL const abut_filter* filter,
                                            ABUT_OPTIONAL abut_thread_pool* pool,
                                            ABUT_ARRAY(count) abut_world_closest3* out);

/// The items that overlap a shape at each of many poses, one list after another. `ends` receives the end of each list
/// in `out`, and `id_count` the length of all lists.
ABUT_API abut_code abut_world2_overlapping_many(const abut_world2* world, const abut_shape2* shape,
                                                ABUT_ARRAY(count) const abut_pose2* poses, uint32_t stride,
                                                uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                                ABUT_OPTIONAL abut_thread_pool* pool, ABUT_ARRAY(count) uint32_t* ends,
                                                ABUT_ARRAY(capacity) abut_id* out, uint32_t capacity,
                                                uint32_t* id_count);
ABUT_API abut_code abut_world3_overlapping_many(const abut_world3* world, const abut_shape3* shape,
                                                ABUT_ARRAY(count) const abut_pose3* poses, uint32_t stride,
                                                uint32_t count, ABUT_OPTIONAL const abut_filter* filter,
                                                ABUT_OPTIONAL abut_thread_pool* pool, ABUT_ARRAY(count) uint32_t* ends,
                                                ABUT_ARRAY(capacity) abut_id* out, uint32_t capacity,
                                                uint32_t* id_count);

ABUT_C_END
