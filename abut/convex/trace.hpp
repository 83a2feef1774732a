#pragma once

// What the engines did, step by step: for drawing and for learning. An engine that is given none writes nothing.

#include <abut/math/vec.hpp>

#include <array>
#include <variant>
#include <vector>

namespace abut {

/// A simplex of GJK, in the Minkowski difference A - B: the origin there is where points of A and B meet.
template <int D>
struct GjkStep {
    std::array<Vec<D>, static_cast<std::size_t>(D) + 1> points{};
    std::size_t count = 0;
    Vec<D> closest{};  ///< its point closest to the origin
};

/// A face of the polytope that the penetration search grows in A - B, nearest to the origin when it was looked at.
template <int D>
struct PenetrationStep {
    std::array<Vec<D>, static_cast<std::size_t>(D)> points{};
    Vec<D> normal{};     ///< of length 1, away from the origin
    float distance = 0;  ///< of the face from the origin
    float extent = 0;    ///< of A - B along the normal: how far moving B along it parts the two
};

/// An axis that may part the two, with what each covers of it, seen from the origin of the world.
template <int D>
struct AxisStep {
    Vec<D> axis{};  ///< of length 1, from A to B
    float min_a = 0, max_a = 0;
    float min_b = 0, max_b = 0;

    /// Below zero where they overlap along the axis.
    float gap() const { return min_b - max_a; }
};

/// A cut with the plane dot(normal, p) == offset, which keeps what lies behind it.
template <int D>
struct ClipStep {
    Vec<D> normal{};  ///< of length 1
    float offset = 0;
    std::vector<Vec<D>> points;  ///< the face or polygon that the cut left; of a polyhedron the new face
};

/// A stop of a sweep, seen in the difference A - B as the two begin: as A moves on, the origin there goes back along a
/// ray, and where that enters A - B the two touch.
template <int D>
struct SweepStep {
    Vec<D> position{};   ///< of the stop on the ray
    Vec<D> normal{};     ///< of length 1, from A to B; A - B is behind a plane across it
    float distance = 0;  ///< signed, of the two; of the plane from the stop
};

template <int D>
using TraceStep = std::variant<GjkStep<D>, PenetrationStep<D>, AxisStep<D>, ClipStep<D>, SweepStep<D>>;

/// Handed to a question by its options, it is filled with what happens there. It grows: clear it between questions.
template <int D>
struct Trace {
    std::vector<TraceStep<D>> steps;

    void clear() { steps.clear(); }
};

}  // namespace abut
