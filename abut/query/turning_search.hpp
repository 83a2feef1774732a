#pragma once

// When two parts first meet, both on rigid paths. For .cpp files.

#include <abut/convex/gjk/search_options.hpp>
#include <abut/convex/support.hpp>
#include <abut/math/rigid_path.hpp>
#include <abut/query/feature.hpp>
#include <abut/shape/half_space.hpp>

namespace abut {

/// As `Hit` has it, in the frame of the paths.
template <int D>
struct Meeting {
    double time = 0;
    DVec<D> point{0.0};
    DVec<D> normal{0.0};  ///< of length 1, from A to B
    bool started_inside = false;
    Feature feature;  ///< on B; its part is for the caller to tell
};

/// The bound on steps from one time to the next. A dozen is much for what starts apart, and a hundred for what leaves
/// something it was inside of; reaching the bound is told as a meeting there, which is early and never late.
inline constexpr int turning_most_steps = 1024;

/// Times. Where they meet is the same to the last bit whatever the reach.
struct TurningLimits {
    double from = 0;   ///< until then they are known not to meet
    double until = 1;  ///< what happens later is of no concern
    double reach = 1;  ///< nor what happens later than this
    int most_steps = turning_most_steps;
};

/// With d the signed distance and m the margin of doubt, the parts meet at the first time at which
///
/// - they touch, d <= m, for the first time or after they have been apart, d > m, and go further in at once;
/// - they touch since some time without having gone further in then, and d < min(d then, 0) - m. (So what starts inside
///   is met where it gets deeper than it was at first, or when it comes back from having been apart.)
///
/// What goes in at the back of what is met from its front alone does so unmet, until they have been apart. Each of
/// these may be decided either way within m, so nothing depends on the moments at which the search looks. Of shapes
/// known by a support function, of which depths are right to a thousandth of the size, "deeper" is by more than that.
///
/// False, and `meeting` is as it was, where they don't meet until the limits' end. Both shapes are as they are in the
/// frame that their path moves.
template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const Convex<D>& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>& options, Meeting<D>& meeting);
template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const HalfSpaceView<D>& b,
                   const RigidPath<D>& path_b, const TurningLimits& limits, const SearchOptions<D>& options,
                   Meeting<D>& meeting);
template <int D>
bool first_meeting(const HalfSpaceView<D>& a, const RigidPath<D>& path_a, const Convex<D>& b,
                   const RigidPath<D>& path_b, const TurningLimits& limits, const SearchOptions<D>& options,
                   Meeting<D>& meeting);

}  // namespace abut
