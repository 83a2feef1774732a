#pragma once

// Linear sweeps of one shape at a chain, and the peers' answers. One value per motion: the distance, or -1 for a miss.

#include "../bench.hpp"
#include <abut/math/vec.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <memory>
#include <variant>
#include <vector>

namespace abut::bench {

/// A shape about the origin.
using SweptShape2 = std::variant<Circle, Box2>;

struct ChainCast {
    Vec2 from, motion;
};

struct ChainSweeps {
    std::vector<Vec2> points;  ///< of an open chain
    std::vector<ChainCast> casts;
    SweptShape2 shape;
};
using SharedChainSweeps = std::shared_ptr<const ChainSweeps>;

/// b2ShapeCast, or b2TimeOfImpact without rotation, at the children of a b2ChainShape that a ray cast in a
/// b2DynamicTree of their boxes, grown by the box of the swept shape, visits.
Side box2d_chain_sweeps(const SharedChainSweeps& scene);
Side box2d_chain_sweeps_by_impact(const SharedChainSweeps& scene);

}  // namespace abut::bench
