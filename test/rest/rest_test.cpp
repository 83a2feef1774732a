// What a small solver stacks on floors with internal edges comes to rest: contacts carry whole areas, and their
// features persist from step to step.

#include "../oracle/is_long.hpp"
#include "rest_scenes.hpp"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Slopes of the floor, tilts of the boxes, and coordinates. A float there is 1e-3 wide, so no tall stack stands on a
/// slope.
struct RestState {
    double slope, tilt, base;
};
constexpr std::array rest_states{RestState{0, 0, 0},         RestState{0, 0.0035, 1e4}, RestState{0, 0.02, 0},
                                 RestState{0, 0.1, 1e4},     RestState{0.03, 0, 0},     RestState{0, 0, 1e4},
                                 RestState{0.03, 0.0035, 0}, RestState{0.1, 0, 1e4},    RestState{0, 0.0035, 0},
                                 RestState{0, 0.02, 1e4},    RestState{0, 0.1, 0},      RestState{0.1, 0.0035, 0}};

template <int D>
void expect_rest(const std::string& scene, const RestCase& of, double seconds, double measured) {
    SCOPED_TRACE(std::to_string(D) + "D, " + scene + " on " + of.floor + ", slope " + std::to_string(of.slope) +
                 ", tilt " + std::to_string(of.tilt) + ", coordinates " + std::to_string(of.base));
    const Rest rest = play<D>(scene, of, seconds, measured);
    EXPECT_LT(rest.speed, 0.02);
    EXPECT_LT(rest.moved, 0.05);
    EXPECT_GT(rest.points, 1);
    // Small boxes at such coordinates are rounded to other places by every step.
    if (of.base == 0 || scene != "plank") {
        EXPECT_GE(rest.persistent, 0.99);
    }
}

/// All scenes on all floors. The states are used in turn, and all of them in the long run.
template <int D, class Floors>
void expect_all_rest(const Floors& floors) {
    const bool is_long = oracle::is_long();
    std::size_t turn = 0;
    for (const char* scene : rest_scenes)
        for (const char* floor : floors) {
            const std::size_t count = is_long ? rest_states.size() : 1;
            for (std::size_t i = 0; i < count; ++i) {
                const RestState& state = rest_states[turn++ % rest_states.size()];
                const bool is_stack = std::string(scene) == "stack";
                const double slope = is_stack && state.slope > 0.05 ? 0.01 : state.slope;
                expect_rest<D>(scene, {floor, slope, state.tilt, state.base}, is_long ? 20 : 10, is_long ? 5 : 2);
            }
        }
}

TEST(Rest, OnEveryFloorOfThePlane) {
    expect_all_rest<2>(rest_floors_2);
}
TEST(Rest, OnEveryFloorInSpace) {
    expect_all_rest<3>(rest_floors_3);
}

}  // namespace
}  // namespace abut::test
