#pragma once

// A record of the steps of the algorithms, for drawing and for learning. Without a trace nothing is recorded.

#include <abut/math/vec.hpp>

#include <array>
#include <variant>
#include <vector>

namespace abut {

/// A simplex of GJK in the Minkowski difference A - B, whose origin stands for a common point of A and B.
template <int D>
struct GjkStep {
    std::array<Vec<D>, static_cast<std::size_t>(D) + 1> points{};
    std::size_t count = 0;
    Vec<D> closest{};  ///< the point of the simplex closest to the origin
};

/// The face of the expanding polytope (EPA) in A - B that was nearest to the origin.
template <int D>
struct PenetrationStep {
    std::array<Vec<D>, static_cast<std::size_t>(D)> points{};
    Vec<D> normal{};     ///< of length 1, away from the origin
    float distance = 0;  ///< from the origin to the face
    float extent = 0;    ///< of A - B along the normal: moving B by it along the normal separates the two
};

/// A tested separating axis with the projections of A and B onto it, in the world.
template <int D>
struct AxisStep {
    Vec<D> axis{};  ///< of length 1, from A to B
    float min_a = 0, max_a = 0;
    float min_b = 0, max_b = 0;

    /// Below zero if the projections overlap.
    float gap() const { return min_b - max_a; }
};

/// A cut with the plane dot(normal, p) == offset, which keeps the part behind it.
template <int D>
struct ClipStep {
    Vec<D> normal{};  ///< of length 1
    float offset = 0;
    std::vector<Vec<D>> points;  ///< the face or polygon after the cut; of a polyhedron the new face
};

/// A step of a sweep in the Minkowski difference A - B at the start of the motion. As A moves, the origin moves back
/// along a ray; the shapes touch where the ray enters A - B.
template <int D>
struct SweepStep {
    Vec<D> position{};   ///< of the step on the ray
    Vec<D> normal{};     ///< of length 1, from A to B; A - B lies behind a plane with this normal
    float distance = 0;  ///< the signed distance of the two, and of the plane from the step
};

template <int D>
using TraceStep = std::variant<GjkStep<D>, PenetrationStep<D>, AxisStep<D>, ClipStep<D>, SweepStep<D>>;

/// A query adds its steps to the trace in its options. Clear it between queries.
template <int D>
struct Trace {
    std::vector<TraceStep<D>> steps;

    void clear() { steps.clear(); }
};

}  // namespace abut
