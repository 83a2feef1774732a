#pragma once

// A convex set that moves along a rigid path. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/math/detail/rigid_path.hpp>

namespace abut::detail {

/// Refers to the same data as the set. `here` gives the set at the time of the last `go_to`.
template <int D>
class RotatingSet {
public:
    /// `set` is in the frame that the path moves. A set that the rotation displaces by less than `negligible_motion`
    /// counts as not rotating.
    RotatingSet(const Convex<D>& set, const RigidPath<D>& path, double negligible_motion);

    /// Moves the set to a time from 0 to 1.
    void go_to(double time) {
        if (time == time_) return;
        time_ = time;
        if (axis_.rate == 0) {
            here_.place.offset = offset_.at({0, 1}) + path_.pivot(time);
            return;
        }
        rotation_ = sin_cos(axis_.rate * time);
        for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) here_.place.column[i] = columns_[i].at(rotation_);
        here_.place.offset = offset_.at(rotation_) + path_.pivot(time);
    }

    const Convex<D>& here() const { return here_; }
    /// Its rotation at that time.
    const SinCos& rotation() const { return rotation_; }
    const RigidPath<D>& path() const { return path_; }

    /// The largest distance of the core from the pivot, and an upper bound of the displacement of any point by the
    /// whole motion.
    double reach() const { return reach_; }
    double travel() const { return length(path_.move) + angular_speed(path_.angular_velocity) * reach_; }

private:
    RigidPath<D> path_;
    double time_ = 0;  ///< of `here_`
    SinCos rotation_{0, 1};
    Convex<D> here_;
    double reach_;
    RotationAxis<D> axis_;
    std::array<RotatingVector<D>, static_cast<std::size_t>(D)> columns_;
    RotatingVector<D> offset_;  ///< of the set's placement, from the pivot
};

}  // namespace abut::detail
