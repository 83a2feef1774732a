// What a small solver stacks on floors with internal edges comes to rest: contacts carry whole areas, and their
// features persist from step to step.

#include "../oracle/is_long.hpp"
#include "rest_scenes.hpp"

#include <cstdio>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Slopes of the floor, tilts of the boxes, and coordinates, where a float is up to 1e-3 wide.
struct RestState {
    double slope, tilt, base;
};

/// All states for a scene. No tall stack stands on a steep slope, and no tilted one on any.
std::vector<RestState> states_of(const std::string& scene) {
    std::vector<RestState> result;
    for (const double slope : {0.0, 0.03, 0.1})
        for (const double tilt : {0.0, 0.0035, 0.02, 0.1})
            for (const double base : {0.0, 1e4})
                if ((slope == 0 || tilt < 0.01) && (slope < 0.05 || scene != "stack"))
                    result.push_back({slope, tilt, base});
    return result;
}

/// A row of the table of scenes: the worst figures over all states.
struct RestRow {
    std::size_t states = 0;
    double speed = 0, persistent = 1, moved = 0;

    void add(const Rest& rest) {
        ++states;
        speed = std::max(speed, rest.speed);
        persistent = std::min(persistent, rest.persistent);
        moved = std::max(moved, rest.moved);
    }
};

template <int D>
Rest expect_rest(const std::string& scene, const RestCase& of, double seconds, double measured) {
    SCOPED_TRACE(std::to_string(D) + "D, " + scene + " on " + of.floor + ", slope " + std::to_string(of.slope) +
                 ", tilt " + std::to_string(of.tilt) + ", coordinates " + std::to_string(of.base));
    const Rest rest = play<D>(scene, of, seconds, measured);
    EXPECT_LT(rest.speed, 0.02);
    EXPECT_LT(rest.moved, 0.05);
    EXPECT_GT(rest.points, 1);
    EXPECT_GE(rest.persistent, 0.99);
    return rest;
}

/// All scenes on all floors. In the long run all states, and then it prints the table of docs/ghosts.md; otherwise
/// the states are used in turn.
template <int D, class Floors>
void expect_all_rest(const Floors& floors) {
    std::size_t turn = 0;
    for (const char* scene : rest_scenes) {
        const std::vector<RestState> states = states_of(scene);
        for (const char* floor : floors) {
            RestRow row;
            if (oracle::is_long()) {
                for (const RestState& of : states)
                    row.add(expect_rest<D>(scene, {floor, of.slope, of.tilt, of.base}, 20, 5));
                std::printf("| %dD | %s | %s | %zu | %.5f | %.1f %% | %.3f |\n", D, scene, floor, row.states, row.speed,
                            100 * row.persistent, row.moved);
            } else {
                const RestState& of = states[turn++ * 5 % states.size()];
                expect_rest<D>(scene, {floor, of.slope, of.tilt, of.base}, 10, 2);
            }
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
