#pragma once

// The time of impact of two parts on rigid paths, by conservative advancement. For .cpp files.

#include <abut/math/detail/rigid_path.hpp>
#include <abut/query/detail/part_pairs.hpp>

namespace abut::detail {

/// A span of the motion's time.
struct TimeSpan {
    double from = 0, to = 1;
};

/// Like `Hit`, in the frame of the paths.
template <int D>
struct RotatingImpact {
    double time = 0;
    DVec<D> point{0.0};
    DVec<D> normal{0.0};  ///< unit vector from A to B
    bool started_inside = false;
    Feature feature;  ///< on B; the caller sets its part
};

/// The limit on iterations. Parts that start apart take at most about a dozen, parts that leave an overlap at most
/// about a hundred. At the limit the parts count as an impact, which is early and never late.
inline constexpr int rotating_sweep_max_iterations = 1024;

/// Times, in [0, 1]. The time of impact doesn't depend on the reach, to the last bit.
struct RotatingSweepLimits {
    double from = 0;   ///< before this there is no impact
    double until = 1;  ///< the end of the search
    double reach = 1;  ///< later impacts don't matter
    int max_iterations = rotating_sweep_max_iterations;
};

/// With d the signed distance and m the tolerance, the time of impact is the first time at which one of these holds:
///
/// - The parts touch, d <= m, for the first time or after they have been apart, d > m, and go further in at once.
/// - The parts have touched for some time without going further in, and d < min(d at first, 0) - m. (So parts that
///   overlap at the start hit when they get deeper than that, or when they touch again after being apart.)
///
/// A part that enters a one-sided part by its back doesn't hit it until they have been apart. Within m each of these
/// may go either way, so nothing depends on the times that the search visits. Depths of shapes known by a support
/// function are right to a thousandth of the size; for them "deeper" means by more than that.
///
/// Returns false, and leaves `impact` unchanged, if there is no impact until the end. Both parts are in the frames that
/// their paths move. Neither is a distance function, and not both are half-spaces.
template <int D>
bool time_of_impact(const AnyPart<D>& a, const RigidPath<D>& path_a, const AnyPart<D>& b, const RigidPath<D>& path_b,
                    const RotatingSweepLimits& limits, const SearchOptions<D>& options, RotatingImpact<D>& impact);

/// The earliest time of impact over all pairs of parts of two shapes. `impact.feature.part` is the part of B.
template <int D>
bool time_of_impact(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
                    const SearchOptions<D>& options, RotatingImpact<D>& impact);

}  // namespace abut::detail
