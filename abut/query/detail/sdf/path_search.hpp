#pragma once

// The time of impact of a convex set and a function that bounds itself. For .cpp files.
//
// One search in the hull of the moving set proves that nothing touches in an interval of time, or finds a point that
// does. From there the time goes back to the first contact nearby, which takes a few evaluations: a root along the path
// of the deepest point, and a descent to the deepest point at that time, in turns. Then the interval before it is
// proven, or the proof finds an earlier contact. An interval without either is split.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/math/detail/rigid_path.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut::detail {

/// The limit on proofs. At the limit the answer is the last time proven free of contact, which is early and never late.
inline constexpr int path_search_max_proofs = 96;

/// A motion of at most this slope relative to a surface slides.
inline constexpr double sliding_slope = 1e-4;

/// A sliding shape is evaluated each time it has moved this fraction of its size.
inline constexpr double slide_stride = 0.25;

/// The limit on steps of a sweep that evaluate a distance. Once half of them are used up, each covers at least its
/// share of the rest.
inline constexpr int function_sweep_max_iterations = 256;

/// The bounds on the motion of two parts that the searches use.
struct MotionBounds {
    double end = 1;               ///< times go from 0 to this
    double speed = 0;             ///< an upper bound of the rate of change of the distance
    double tolerance = 0;         ///< of the time of impact, as a distance
    double sliding_interval = 1;  ///< how often sliding is evaluated
    double from = 0;              ///< before this their boxes don't overlap
    double min_interval = 0;      ///< shorter intervals of time aren't divided
};

template <int D>
struct TimedDistance {
    double time = 0;
    SignedDistance<D> distance;
    bool started_inside = false;
};

/// The first contact gained, with the distance from the set to the function. Both are in the frames that their paths
/// move.
template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Convex<D>& set, const RigidPath<D>& path_of_set,
                                                         const DistanceFunction<D>& function,
                                                         const RigidPath<D>& path_of_function,
                                                         const MotionBounds& bounds);

}  // namespace abut::detail
