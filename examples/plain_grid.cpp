// Which of many boxes overlap? The textbook solution is a uniform grid: each box is inserted in every cell that it
// touches, and only boxes of one cell are compared. The library's broad phases give the same pairs many times faster.
#include "../scenes/plain_grid.hpp"

#include <cstdio>

int main() {
    const abut::Aabb2 boxes[] = {
        {{0.2f, 0.2f}, {0.8f, 0.8f}},      // 0: a crate, alone in its corner
        {{-0.5f, -0.5f}, {0.1f, 0.1f}},    // 1: a barrel across the origin, in four cells
        {{-1.5f, -0.2f}, {-0.5f, 0.1f}},   // 2: a plank that touches the barrel
        {{-9.0f, -2.0f}, {9.0f, -0.5f}},   // 3: the floor, in dozens of cells
        {{5.0f, -0.5f}, {6.0f, 0.5f}},     // 4: a crate on the floor
        {{20.1f, 20.1f}, {20.9f, 20.9f}},  // 5: far away
    };

    abut::scenes::PlainGrid<2> grid(1);
    grid.build(boxes);

    int pairs = 0;
    grid.each_pair([&](std::uint32_t i, std::uint32_t j) {
        std::printf("box %u touches box %u\n", i, j);
        ++pairs;
    });
    return pairs == 3 ? 0 : 1;
}
