#pragma once

// The plainest items of a world, circles of radius 1, and lists of pairs that can be compared.

#include <abut/shape/ball.hpp>
#include <abut/world/world.hpp>

#include <span>
#include <vector>

namespace abut::test {

inline const Circle unit{{0, 0}, 1};

inline Pose2 place(float x, float y = 0) {
    return {{x, y}};
}

using Pairs = std::vector<IdPair>;

inline Pairs list(std::span<const IdPair> pairs) {
    return Pairs(pairs.begin(), pairs.end());
}

}  // namespace abut::test
