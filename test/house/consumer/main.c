/* A game in C: the installed package has all that it needs. */
#include <abut/c/abut.h>

int main(void) {
    const abut_ball3 ball = {{0, 0, 0}, 1};
    const abut_vec3 point = {3, 0, 0};
    abut_shape3* shape = 0;
    abut_closest3 closest;
    if (abut_shape3_ball(ball, &shape) != ABUT_OK) return 1;
    if (abut_shape3_closest_to_point(shape, point, &closest) != ABUT_OK) return 1;
    abut_shape3_release(shape);
    return closest.distance == 2 ? 0 : 1;
}
