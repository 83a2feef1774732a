#pragma once

// A convex set on its way along a rigid path. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/math/rigid_path.hpp>

namespace abut {

/// Refers to what the set refers to. Where it is between two calls of `go_to` is asked of `here`.
template <int D>
class TurningSet {
public:
    /// `set` as it is in the frame that the path moves. A set that turning about this pivot and axis moves by less than
    /// `unseen` is taken not to turn.
    TurningSet(const Convex<D>& set, const RigidPath<D>& path, double unseen);

    /// To a time from 0 to 1.
    void go_to(double time) {
        if (time == time_) return;
        time_ = time;
        if (axis_.rate == 0) {
            here_.place.offset = offset_.at({0, 1}) + path_.pivot(time);
            return;
        }
        turned_ = sin_cos(axis_.rate * time);
        for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) here_.place.column[i] = columns_[i].at(turned_);
        here_.place.offset = offset_.at(turned_) + path_.pivot(time);
    }

    const Convex<D>& here() const { return here_; }
    /// By how far it has turned there.
    const SinCos& turned() const { return turned_; }
    const RigidPath<D>& path() const { return path_; }

    /// How far the core reaches from the pivot, and the most that a point of the set is displaced by the whole motion.
    double reach() const { return reach_; }
    double travel() const { return length(path_.move) + rate_of(path_.spin) * reach_; }

private:
    RigidPath<D> path_;
    double time_ = 0;  ///< at which `here_` is
    SinCos turned_{0, 1};
    Convex<D> here_;
    double reach_;
    TurningAxis<D> axis_;
    std::array<TurningVector<D>, static_cast<std::size_t>(D)> columns_;
    TurningVector<D> offset_;  ///< of the set's place, from the pivot
};

}  // namespace abut
