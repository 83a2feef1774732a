// Do these two shapes touch? If not, how far apart are they?
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    const abut::Sphere ball{{0, 0, 0}, 1};
    const abut::Box3 crate{{3, 0, 0}, {0.5f, 0.5f, 0.5f}};  // its center, and half the length of its edges

    const bool touch = abut::overlaps(ball, crate);
    const abut::Closest<3> gap = abut::closest(ball, crate);

    std::printf("they %s: %g apart, between x = %g and x = %g\n", touch ? "touch" : "don't touch", gap.distance,
                gap.on_a.x, gap.on_b.x);
    return !touch && gap.distance == 1.5f ? 0 : 1;
}
