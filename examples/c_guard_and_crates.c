// The C API: a guard among crates. Who sees whom, what touches, and how far a step may go.
#include <abut/c/abut.h>

#include <stdio.h>
#include <stdlib.h>

static void must(abut_code code) {
    if (code == ABUT_OK) return;
    fprintf(stderr, "abut: %s\n", abut_last_error());
    exit(1);
}

int main(void) {
    // Shapes are handles; a world keeps what it needs of them.
    abut_shape2 *crate = NULL, *guard = NULL;
    const abut_box2 box = {{0, 0}, {0.5f, 0.5f}, {1, 0}};
    const abut_ball2 ball = {{0, 0}, 0.4f};
    must(abut_shape2_box(box, &crate));
    must(abut_shape2_ball(ball, &guard));

    abut_world2* world = NULL;
    must(abut_world2_create(NULL, &world));
    abut_id crates[3], guard_id;
    abut_item_options2 options;
    must(abut_item_options2_default(&options));
    for (int i = 0; i < 3; ++i) {
        options.pose.position.x = 2 + 2 * (float)i;
        options.fixed = 1;
        must(abut_world2_add(world, crate, &options, &crates[i]));
    }
    must(abut_item_options2_default(&options));
    must(abut_world2_add(world, guard, &options, &guard_id));

    // How far the guard can walk to the right.
    abut_filter filter;
    must(abut_filter_default(&filter));
    filter.ignore = guard_id;
    abut_world_hit2 hit;
    const abut_vec2 step = {3, 0};
    must(abut_world2_sweep(world, guard, step, &filter, &hit));
    printf("the guard walks %g and touches crate %u\n", (double)hit.hit.distance, hit.id.index);

    // The events of the walk.
    options.pose.position.x = hit.hit.distance + 0.01f;
    must(abut_world2_move(world, guard_id, options.pose));
    abut_events events;
    must(abut_world2_update(world, NULL, &events));
    for (uint32_t i = 0; i < events.began_count; ++i)
        printf("item %u touches item %u\n", events.began[i].a.index, events.began[i].b.index);

    // A line of sight past the crates, for many rays at once.
    abut_ray2 rays[2];
    const abut_vec2 eye = {0, 2}, hidden = {8, -1}, open = {8, 3};
    must(abut_ray2_between(eye, hidden, &rays[0]));
    must(abut_ray2_between(eye, open, &rays[1]));
    abut_world_hit2 seen[2];
    must(abut_world2_raycast_many(world, rays, 0, 2, &filter, NULL, seen));
    printf("the first place is %s, the second %s\n", seen[0].hit.found ? "hidden" : "in sight",
           seen[1].hit.found ? "hidden" : "in sight");
    const int is_right = events.began_count == 1 && seen[0].hit.found && !seen[1].hit.found;

    abut_world2_release(world);
    abut_shape2_release(guard);
    abut_shape2_release(crate);
    return is_right ? 0 : 1;
}
