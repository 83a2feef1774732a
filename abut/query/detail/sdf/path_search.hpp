#pragma once

// The time of impact of a convex set that starts apart from a function that bounds itself. For .cpp files.
//
// One search in the hull of the moving set proves that nothing touches in an interval of time, or finds a point that
// does. From there the time goes back to the first contact nearby, which takes a few evaluations: a root along the path
// of the deepest point, and a descent to the deepest point at that time, in turns. Then the interval before it is
// proven, or the proof finds an earlier contact. An interval without either is split.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <optional>

namespace abut {

/// The limit on proofs. At the limit the answer is the last time proven free of contact, which is early and never late.
inline constexpr int path_search_max_proofs = 96;

template <int D>
struct TimedDistance {
    double time = 0;
    SignedDistance<D> distance;
    bool started_inside = false;
};

/// How a set moves in the frame of a function.
template <int D>
struct SetMotion {
    FunctionRef<Affine<D>(double time)> place_at;                    ///< rigid
    FunctionRef<double(double from, double until)> chord_deviation;  ///< of any point; 0: it doesn't rotate
    double speed;                                                    ///< an upper bound of the rate of the distance
};

/// The first contact between two times, with the distance from the set to the function in the function's frame.
template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Convex<D>& set, const DistanceFunction<D>& function,
                                                         const SetMotion<D>& motion, double start, double end,
                                                         double tolerance);

}  // namespace abut
