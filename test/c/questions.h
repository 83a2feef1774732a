// The questions of one dimension: included with N(name) = name with the dimension at its end, and T(type, rest).
// Each answer is compared bit for bit with that of the C++ API.

static void N(release_scene)(N(abut_shape) * *shapes, int count) {
    for (int i = 0; i < count; ++i) T(abut_shape, _release)(shapes[i]);
}

static void N(query_pairs)(N(abut_shape) * const* shapes, int count, const N(abut_pose) * poses) {
    int touching = 0, apart = 0;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            if (a == half_space_place && b == half_space_place) continue;
            const N(abut_pose) pose = poses[(a + b) % pose_count];
            N(abut_shape)* placed = NULL;
            MUST(T(abut_shape, _at)(shapes[b], pose, &placed));

            bool overlaps = false;
            MUST(T(abut_shape, _overlaps)(shapes[a], placed, &overlaps));
            CHECK(overlaps == N(expected_overlaps)(a, b, pose));
            touching += overlaps ? 1 : 0;
            apart += overlaps ? 0 : 1;

            N(abut_closest) closest;
            MUST(T(abut_shape, _closest)(shapes[a], placed, &closest));
            SAME(closest, N(expected_closest)(a, b, pose));

            const abut_query_options options = {0.25f, 1};
            N(abut_contact) contact;
            MUST(T(abut_shape, _contact)(shapes[a], placed, &options, &contact));
            SAME(contact, N(expected_contact)(a, b, pose, 0.25f));

            N(abut_contact) contacts[8], expected[8];
            uint32_t found = 0;
            MUST(T(abut_shape, _each_contact)(shapes[a], placed, NULL, contacts, 8, &found));
            CHECK(found == N(expected_each_contact)(a, b, pose, expected, 8));
            CHECK(memcmp(contacts, expected, (found < 8 ? found : 8) * sizeof(contacts[0])) == 0);

            N(abut_hit) hit;
            MUST(T(abut_shape, _sweep)(shapes[a], N(motion_a), placed, N(motion_b), &hit));
            SAME(hit, N(expected_sweep)(a, N(motion_a), b, N(motion_b), pose));

            N(abut_motion) motion_a = {pose, N(motion_a), N(turn)}, motion_b = {poses[0], N(motion_b), N(no_turn)};
            MUST(T(abut_shape, _sweep_motion)(shapes[a], motion_a, shapes[b], motion_b, &hit));
            SAME(hit, N(expected_sweep_motion)(a, motion_a, b, motion_b));

            N(abut_certificate) certificate;
            bool holds = false;
            MUST(T(abut_shape, _certify)(shapes[a], placed, closest, &certificate));
            CHECK(certificate.plane == N(expected_certificate)(a, b, pose, &holds));
            CHECK(holds == (certificate.holds != 0));

            bool is_hit[1];
            MUST(T(abut_shape, _overlaps_many)(shapes[a], shapes[b], &pose, 0, 1, is_hit));
            CHECK(is_hit[0] == overlaps);
            N(abut_closest) many_closest[1];
            MUST(T(abut_shape, _closest_many)(shapes[a], shapes[b], &pose, 0, 1, many_closest));
            N(abut_contact) many_contact[1];
            MUST(T(abut_shape, _contact_many)(shapes[a], shapes[b], &options, &pose, 0, 1, many_contact));
            SAME(many_contact[0], N(expected_contact)(a, b, pose, 0.25f));
            T(abut_shape, _release)(placed);
        }
    CHECK(touching > 20 && apart > 20);
}

static void N(query_one)(N(abut_shape) * const* shapes, int count, const N(abut_pose) * poses) {
    int hits = 0, misses = 0;
    for (int a = 0; a < count; ++a) {
        N(abut_aabb) box;
        MUST(T(abut_shape, _bounds)(shapes[a], &box));
        SAME(box, N(expected_bounds)(a));
        N(abut_closest) many_closest[pose_count];
        N(abut_hit) many_hits[pose_count];
        N(abut_ray) rays[pose_count];
        bool inside[pose_count];
        for (int i = 0; i < pose_count; ++i) MUST(T(abut_ray, _between)(N(far_point), poses[i].position, &rays[i]));
        // The points lie in the poses, with the stride of these.
        MUST(T(abut_shape, _closest_to_points)(shapes[a], &poses[0].position, sizeof(poses[0]), pose_count,
                                               many_closest));
        MUST(T(abut_shape, _contains_many)(shapes[a], &poses[0].position, sizeof(poses[0]), pose_count, inside));
        MUST(T(abut_shape, _raycast_many)(shapes[a], NULL, rays, 0, pose_count, many_hits));
        for (int i = 0; i < pose_count; ++i) {
            N(abut_closest) closest;
            MUST(T(abut_shape, _closest_to_point)(shapes[a], poses[i].position, &closest));
            SAME(closest, N(expected_closest_to_point)(a, poses[i].position));
            SAME(many_closest[i], closest);
            bool contains = false;
            MUST(T(abut_shape, _contains)(shapes[a], poses[i].position, &contains));
            CHECK(contains == N(expected_contains)(a, poses[i].position));
            CHECK(inside[i] == contains);
            N(abut_hit) hit;
            MUST(T(abut_shape, _raycast)(shapes[a], rays[i], NULL, &hit));
            SAME(hit, N(expected_raycast)(a, rays[i]));
            SAME(many_hits[i], hit);
            hits += hit.found ? 1 : 0;
            misses += hit.found ? 0 : 1;
            bool any = false;
            MUST(T(abut_shape, _raycast_any)(shapes[a], rays[i], NULL, &any));
            CHECK(any == (hit.found != 0));
            N(abut_hit) all[8], expected[8];
            uint32_t found = 0;
            MUST(T(abut_shape, _raycast_all)(shapes[a], rays[i], NULL, all, 8, &found));
            CHECK(found == N(expected_raycast_all)(a, rays[i], expected, 8));
            CHECK(memcmp(all, expected, (found < 8 ? found : 8) * sizeof(all[0])) == 0);
            if (hit.found) {
                N(abut_ray) mirrored;
                MUST(T(abut_ray, _reflect)(rays[i], hit, &mirrored));
                CHECK(mirrored.length >= 0);
            }
        }
    }
    CHECK(hits > 20 && misses > 20);
}

static void N(query_polytopes)(N(abut_shape) * const* shapes, int count) {
    enum { capacity = 64 };
    int found = 0;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            N(abut_shape)* common = NULL;
            N(abut_vec) points[capacity], expected[capacity];
            uint32_t point_count = 0, expected_count = 0;
            if (!N(is_polytope)(a) || !N(is_polytope)(b)) {
                CHECK(T(abut_shape, _intersection)(shapes[a], shapes[b], &common) == ABUT_WRONG_SHAPE);
                continue;
            }
            MUST(T(abut_shape, _intersection)(shapes[a], shapes[b], &common));
            CHECK((common != NULL) == N(expected_intersection)(a, b, expected, capacity, &expected_count));
            if (common != NULL) {
                MUST(T(abut_shape, _points)(common, points, capacity, &point_count));
                CHECK(point_count == expected_count && memcmp(points, expected, point_count * sizeof(points[0])) == 0);
                N(abut_measures) measures;
                MUST(T(abut_shape, _measures)(common, &measures));
                CHECK(measures.area >= 0);
                ++found;
            }
            T(abut_shape, _release)(common);
            for (int difference = 0; difference < 2; ++difference) {
                N(abut_shape)* sum = NULL;
                if (difference)
                    MUST(T(abut_shape, _minkowski_difference)(shapes[a], shapes[b], &sum));
                else
                    MUST(T(abut_shape, _minkowski_sum)(shapes[a], shapes[b], &sum));
                MUST(T(abut_shape, _points)(sum, points, capacity, &point_count));
                CHECK(point_count == N(expected_minkowski)(a, b, difference != 0, expected, capacity));
                CHECK(memcmp(points, expected, point_count * sizeof(points[0])) == 0);
                T(abut_shape, _release)(sum);
            }
        }
    CHECK(found > 4);
    N(abut_shape)* round = NULL;
    MUST(T(abut_shape, _polytope)(shapes[0], 0.01f, &round));
    uint32_t corner_count = 0;
    MUST(T(abut_shape, _points)(round, NULL, 0, &corner_count));
    CHECK(corner_count > 8);
    T(abut_shape, _release)(round);
}

static bool N(accept_all)(void* context, abut_id id) {
    *(uint32_t*)context += id.index;
    return true;
}
static bool N(accept_none)(void* context, abut_id a, abut_id b) {
    (void)context;
    (void)a;
    (void)b;
    return false;
}

static void N(query_world)(N(abut_shape) * const* shapes, const N(abut_pose) * poses) {
    N(abut_world)* world = NULL;
    MUST(T(abut_world, _create)(NULL, &world));
    abut_id ids[pose_count];
    for (int i = 0; i < pose_count; ++i) {
        N(abut_item_options) options;
        MUST(T(abut_item_options, _default)(&options));
        options.user = (uint64_t)i << 40;
        MUST(T(abut_world, _add)(world, shapes[i % 3], &options, &ids[i]));
    }
    MUST(T(abut_world, _move_many)(world, ids, 0, poses, 0, pose_count));
    abut_events events;
    abut_thread_pool* pool = NULL;
    MUST(abut_thread_pool_create(2, &pool));
    abut_buffer *before = NULL, *after = NULL;
    MUST(abut_buffer_create(&before));
    MUST(abut_buffer_create(&after));
    MUST(T(abut_world, _save)(world, before));
    MUST(T(abut_world, _update)(world, pool, &events));

    enum { capacity = 64 };
    abut_id_pair began[capacity];
    uint32_t began_count = 0, contact_count = 0, expected_contacts = 0;
    N(abut_world_contact) contacts[capacity], first;
    N(abut_world_hit) expected_hit, hit;
    N(abut_world_closest) expected_closest, closest;
    N(abut_ray) ray;
    MUST(T(abut_ray, _between)(N(far_point), poses[4].position, &ray));
    ray.length *= 4;
    N(expected_world)
    (poses, ray, N(far_point), began, capacity, &began_count, &expected_contacts, &first, &expected_hit,
     &expected_closest);
    CHECK(events.began_count == began_count && began_count > 0);
    CHECK(memcmp(events.began, began, began_count * sizeof(began[0])) == 0);
    CHECK(events.stayed_count == 0 && events.ended_count == 0);
    MUST(T(abut_world, _contacts)(world, contacts, capacity, &contact_count));
    CHECK(contact_count == expected_contacts && contact_count > 1);
    SAME(contacts[0], first);
    MUST(T(abut_world, _contacts)(world, contacts, 1, &contact_count));  // the full length
    CHECK(contact_count == expected_contacts);
    N(abut_contact) contact;
    MUST(T(abut_world, _contact)(world, events.began[0], &contact));
    abut_id touching[capacity];
    uint32_t touching_count = 0;
    MUST(T(abut_world, _touching)(world, events.began[0].a, touching, capacity, &touching_count));
    CHECK(touching_count > 0);

    MUST(T(abut_world, _raycast)(world, ray, NULL, &hit));
    SAME(hit, expected_hit);
    MUST(T(abut_world, _closest_to_point)(world, N(far_point), NULL, &closest));
    SAME(closest, expected_closest);
    N(abut_world_hit) hits[2], all_hits[capacity];
    N(abut_ray) two_rays[2] = {ray, ray};
    MUST(T(abut_world, _raycast_many)(world, two_rays, 0, 2, NULL, pool, hits));
    SAME(hits[1], expected_hit);
    uint32_t count = 0;
    MUST(T(abut_world, _raycast_all)(world, ray, NULL, all_hits, capacity, &count));
    CHECK(count > 0 && memcmp(&all_hits[0], &expected_hit, sizeof(hit)) == 0);
    N(abut_world_closest) closest_items[2];
    const N(abut_vec) points[2] = {N(far_point), N(far_point)};
    MUST(T(abut_world, _closest_to_points)(world, points, 0, 2, NULL, NULL, closest_items));
    SAME(closest_items[0], expected_closest);

    // A filter, by its members and by a callback.
    abut_filter filter;
    MUST(abut_filter_default(&filter));
    filter.ignore = hit.id;
    N(abut_world_hit) other;
    MUST(T(abut_world, _raycast)(world, ray, &filter, &other));
    CHECK(other.id.index != hit.id.index);
    filter.ignore.index = 0;
    uint32_t sum = 0;
    filter.accepts = N(accept_all);
    filter.context = &sum;
    MUST(T(abut_world, _raycast)(world, ray, &filter, &other));
    SAME(other, expected_hit);
    CHECK(sum > 0);

    // Shapes: alone, and at many poses.
    N(abut_shape)* placed = NULL;
    MUST(T(abut_shape, _at)(shapes[2], poses[3], &placed));
    abut_id list[capacity];
    MUST(T(abut_world, _overlapping)(world, placed, NULL, list, capacity, &count));
    CHECK(count > 1);
    uint32_t visited = 0;
    MUST(T(abut_world, _each_overlapping)(world, placed, NULL, N(accept_all), &visited));
    uint32_t listed = 0;
    for (uint32_t i = 0; i < count; ++i) listed += list[i].index;
    CHECK(visited == listed);
    uint32_t ends[pose_count], id_count = 0;
    abut_id lists[capacity];
    MUST(T(abut_world, _overlapping_many)(world, shapes[2], poses, 0, pose_count, NULL, NULL, ends, lists, capacity,
                                          &id_count));
    CHECK(ends[pose_count - 1] == id_count && ends[3] - ends[2] == count);
    CHECK(memcmp(lists + ends[2], list, count * sizeof(list[0])) == 0);
    MUST(T(abut_world, _containing)(world, poses[4].position, NULL, list, capacity, &count));
    MUST(T(abut_world, _k_nearest)(world, placed, NULL, closest_items, 2, &count));
    CHECK(count == 2 && closest_items[0].closest.distance <= closest_items[1].closest.distance);
    MUST(T(abut_world, _closest)(world, placed, NULL, &closest));
    SAME(closest, closest_items[0]);
    MUST(T(abut_world, _closest_many)(world, shapes[2], &poses[3], 0, 1, NULL, NULL, closest_items));
    SAME(closest_items[0], closest);
    MUST(T(abut_world, _each_contact)(world, placed, NULL, NULL, contacts, capacity, &count));
    CHECK(count > 0);
    MUST(T(abut_world, _sweep)(world, placed, N(motion_a), NULL, &hit));
    const N(abut_motion) motion = {poses[3], N(motion_a), N(no_turn)};
    MUST(T(abut_world, _sweep_motion)(world, shapes[2], motion, NULL, &hit));
    MUST(T(abut_world, _sweep_many)(world, shapes[2], &motion, 0, 1, NULL, NULL, hits));
    SAME(hits[0], hit);

    // Rollback: the same events again; and a copy, a file and the items' options.
    MUST(T(abut_world, _restore)(world, abut_buffer_data(before), abut_buffer_size(before)));
    MUST(T(abut_world, _save)(world, after));
    CHECK(abut_buffer_size(after) == abut_buffer_size(before) &&
          memcmp(abut_buffer_data(after), abut_buffer_data(before), abut_buffer_size(after)) == 0);
    MUST(T(abut_world, _save_with_shapes)(world, after));
    N(abut_world)* loaded = NULL, *copy = NULL;
    MUST(T(abut_world, _load)(abut_buffer_data(after), abut_buffer_size(after), NULL, &loaded));
    MUST(T(abut_world, _copy)(world, &copy));
    MUST(T(abut_world, _update)(loaded, NULL, &events));
    CHECK(events.began_count == began_count && memcmp(events.began, began, began_count * sizeof(began[0])) == 0);
    MUST(T(abut_world, _set_pair_filter)(copy, N(accept_none), NULL));
    MUST(T(abut_world, _update)(copy, NULL, &events));
    CHECK(events.began_count == 0);
    N(abut_item_options) options;
    MUST(T(abut_world, _options)(loaded, ids[5], &options));
    CHECK(options.user == (uint64_t)5 << 40 && memcmp(&options.pose, &poses[5], sizeof(poses[5])) == 0);

    MUST(T(abut_world, _set_enabled)(world, ids[0], false));
    const abut_layers layers = {2, 4};
    MUST(T(abut_world, _set_filter)(world, ids[1], layers));
    MUST(T(abut_world, _options)(world, ids[1], &options));
    CHECK(options.layers == 2 && options.mask == 4);
    MUST(T(abut_world, _set_shape)(world, ids[2], shapes[0]));
    MUST(T(abut_world, _move)(world, ids[2], poses[0]));
    MUST(T(abut_world, _remove)(world, ids[3]));
    MUST(T(abut_world, _remove_many)(world, ids + 4, 0, 2));
    MUST(T(abut_world, _size)(world, &count));
    CHECK(count == pose_count - 3);
    bool has = true;
    MUST(T(abut_world, _contains)(world, ids[3], &has));
    CHECK(!has);
    CHECK(T(abut_world, _move)(world, ids[3], poses[0]) == ABUT_STALE_ID);
    CHECK(T(abut_world, _move_many)(world, ids + 2, 0, poses, 0, 2) == ABUT_STALE_ID && abut_last_error_index() == 1);
    T(abut_shape, _release)(placed);
    T(abut_world, _release)(world);
    T(abut_world, _release)(loaded);
    T(abut_world, _release)(copy);
    abut_buffer_release(before);
    abut_buffer_release(after);
    abut_thread_pool_release(pool);
}

static void N(query_field)(const N(abut_shape) * shape, N(abut_field) * field) {
    N(abut_field_sample) sample, expected_sample;
    N(abut_vec) closest, expected_closest;
    float shadow = 0, expected_shadow = 0, distance = 0, openness = 0, cell = 0;
    N(expected_field)(N(motion_a), N(far_point), &expected_sample, &expected_closest, &expected_shadow);
    MUST(T(abut_field, _sample)(field, N(motion_a), &sample));
    SAME(sample, expected_sample);
    MUST(T(abut_field, _closest)(field, N(motion_a), &closest));
    SAME(closest, expected_closest);
    MUST(T(abut_field, _shadow)(field, N(motion_a), N(far_point), 0.1f, &shadow));
    CHECK(shadow == expected_shadow);
    MUST(T(abut_field, _distance)(field, N(motion_a), &distance));
    CHECK(distance == sample.distance);
    MUST(T(abut_field, _ambient_occlusion)(field, closest, sample.normal, 0.5f, &openness));
    MUST(T(abut_field, _cell)(field, &cell));
    CHECK(openness >= 0 && openness <= 1 && cell > 0);
    N(abut_aabb) volume;
    MUST(T(abut_field, _volume)(field, &volume));

    const N(abut_vec) points[2] = {N(far_point), N(motion_a)};
    float distances[2], shadows[2];
    N(abut_field_sample) samples[2];
    N(abut_vec) closest_points[2];
    MUST(T(abut_field, _distance_many)(field, points, 0, 2, distances));
    MUST(T(abut_field, _sample_many)(field, points, 0, 2, samples));
    MUST(T(abut_field, _closest_many)(field, points, 0, 2, closest_points));
    MUST(T(abut_field, _shadow_many)(field, points, 0, 2, N(far_point), 0.1f, shadows));
    CHECK(distances[1] == distance && shadows[1] == shadow);
    SAME(samples[1], sample);
    SAME(closest_points[1], closest);

    abut_buffer* buffer = NULL;
    N(abut_field)* loaded = NULL;
    MUST(abut_buffer_create(&buffer));
    MUST(T(abut_field, _save)(field, buffer));
    MUST(T(abut_field, _load)(abut_buffer_data(buffer), abut_buffer_size(buffer), &loaded));
    MUST(T(abut_field, _distance)(loaded, N(motion_a), &distance));
    CHECK(distance == sample.distance);
    CHECK(T(abut_field, _load)(abut_buffer_data(buffer), abut_buffer_size(buffer) - 1, &loaded) == ABUT_BAD_FORMAT);
    N(abut_shape)* solid = NULL;
    bool overlaps = false;
    MUST(T(abut_field, _shape)(loaded, &solid));
    MUST(T(abut_shape, _overlaps)(solid, shape, &overlaps));
    CHECK(overlaps);
    T(abut_shape, _release)(solid);
    T(abut_field, _release)(loaded);
    T(abut_field, _release)(field);
    abut_buffer_release(buffer);
}

static void N(give_bad_input)(N(abut_shape) * const* shapes, const N(abut_pose) * poses) {
    const float nan = strtof("nan", NULL);
    bool out = true;
    N(abut_shape)* made = NULL;
    N(abut_ball) ball = {poses[0].position, 1};
    ball.center.x = nan;
    CHECK(T(abut_shape, _ball)(ball, &made) == ABUT_NOT_FINITE && made == NULL);
    ball.center.x = 0;
    ball.radius = -1;
    CHECK(T(abut_shape, _ball)(ball, &made) == ABUT_BAD_ARGUMENT);
    CHECK(T(abut_shape, _ball)(ball, NULL) == ABUT_NULL_ARGUMENT);
    CHECK(T(abut_shape, _overlaps)(NULL, shapes[0], &out) == ABUT_NULL_ARGUMENT);
    CHECK(strcmp(abut_last_error(), "a is null") == 0);
    CHECK(T(abut_shape, _overlaps)(shapes[0], NULL, &out) == ABUT_NULL_ARGUMENT);
    CHECK(T(abut_shape, _overlaps)(shapes[0], shapes[0], NULL) == ABUT_NULL_ARGUMENT);
    CHECK(T(abut_shape, _overlaps)(shapes[half_space_place], shapes[half_space_place], &out) == ABUT_WRONG_SHAPE);
    CHECK(T(abut_shape, _overlaps)((const N(abut_shape)*)(const void*)N(other_shape), shapes[0], &out) ==
          ABUT_WRONG_HANDLE);
    CHECK(out);  // not written
    N(abut_closest) closest;
    N(abut_vec) point = poses[0].position;
    point.y = nan;
    CHECK(T(abut_shape, _closest_to_point)(shapes[0], point, &closest) == ABUT_NOT_FINITE);
    CHECK(strcmp(abut_last_error(), "point is not finite") == 0);
    const N(abut_vec) points[3] = {poses[0].position, poses[1].position, point};
    N(abut_closest) many[3];
    CHECK(T(abut_shape, _closest_to_points)(shapes[0], points, 0, 3, many) == ABUT_NOT_FINITE);
    CHECK(abut_last_error_index() == 2 && strcmp(abut_last_error(), "points[2] is not finite") == 0);
    CHECK(T(abut_shape, _closest_to_points)(shapes[0], points, 3, 2, many) == ABUT_BAD_ARGUMENT);
    CHECK(T(abut_shape, _closest_to_points)(shapes[0], NULL, 0, 2, many) == ABUT_NULL_ARGUMENT);
    CHECK(T(abut_shape, _closest_to_points)(shapes[0], points, 0, 2, NULL) == ABUT_NULL_ARGUMENT);
    CHECK(T(abut_shape, _closest_to_points)(shapes[0], NULL, 0, 0, NULL) == ABUT_OK);
    N(abut_pose) pose = poses[0];
    memset(&pose.rotation, 0, sizeof(pose.rotation));
    CHECK(T(abut_shape, _at)(shapes[0], pose, &made) == ABUT_NOT_FINITE);
    CHECK(T(abut_shape, _compound)((const N(abut_shape)* const*)shapes, 0, &made) == ABUT_EMPTY_INPUT);
    const N(abut_shape) * children[2] = {shapes[0], NULL};
    CHECK(T(abut_shape, _compound)(children, 2, &made) == ABUT_NULL_ARGUMENT && abut_last_error_index() == 1);
    CHECK(T(abut_shape, _polytope)(shapes[0], 0, &made) == ABUT_BAD_ARGUMENT);
    CHECK(T(abut_shape, _points)(shapes[0], NULL, 0, NULL) == ABUT_NULL_ARGUMENT);
    uint32_t count = 0;
    CHECK(T(abut_shape, _points)(shapes[0], NULL, 0, &count) == ABUT_WRONG_SHAPE);
    N(abut_shape)* stretched = NULL, *rounded = NULL;
    MUST(T(abut_shape, _stretched)(shapes[2], N(scale), &stretched));
    MUST(T(abut_shape, _rounded)(stretched, 0.5f, &rounded));
    CHECK(T(abut_shape, _stretched)(rounded, N(scale), &made) == ABUT_WRONG_SHAPE);
    T(abut_shape, _release)(stretched);
    T(abut_shape, _release)(rounded);
    T(abut_shape, _release)(NULL);

    N(abut_world)* world = NULL;
    MUST(T(abut_world, _create)(NULL, &world));
    abut_id id;
    CHECK(T(abut_world, _add)(world, NULL, NULL, &id) == ABUT_NULL_ARGUMENT);
    N(abut_item_options) options;
    MUST(T(abut_item_options, _default)(&options));
    options.pose.position.x = nan;
    CHECK(T(abut_world, _add)(world, shapes[0], &options, &id) == ABUT_NOT_FINITE);
    CHECK(T(abut_world, _update)(world, NULL, NULL) == ABUT_NULL_ARGUMENT);
    const uint8_t bytes[4] = {1, 2, 3, 4};
    CHECK(T(abut_world, _restore)(world, bytes, sizeof(bytes)) == ABUT_BAD_FORMAT);
    CHECK(T(abut_world, _load)(bytes, sizeof(bytes), NULL, &world) == ABUT_BAD_FORMAT);
    N(abut_world_hit) hit;
    N(abut_ray) ray = {poses[0].position, poses[1].position, nan};
    CHECK(T(abut_world, _raycast)(world, ray, NULL, &hit) == ABUT_NOT_FINITE);
    T(abut_world, _release)(world);
}
