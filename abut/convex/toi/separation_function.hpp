#pragma once

// The separation function of two rotating sets along an axis of constant angular velocity, with a proof of the time
// until which they stay disjoint: conservative advancement with an acceleration bound.
//
// For a vertex a of A and b of B, the component of b - a along the axis n is a smooth function of time,
//
//     f = n.p + n.y_b - n.y_a,    p from pivot to pivot, y from a pivot to the vertex;
//     p'' = 0,  n' = W x n,  y' = w x y,
//     f'' = (W x (W x n)).p + 2 (W x n).p' + g_b - g_a,    g = (d x (d x n) + (d x w) x n).y,  d = W - w,
//
// where the last line follows from a page of triple products. So |f''| <= K, with K from |p|, |p'| and the distances of
// A and B from their pivots; a set that rotates with the axis adds nothing. The separation is the minimum of f over all
// vertex pairs, however many, and for round sets too. Between two times h apart with separations g1 and g2, each f is
// above its chord less K/2 x (h - x), and so
//
//     separation >= g1 + (g2 - g1) x / h - K/2 x (h - x)    at x after the first.
//
// Two support queries at either end prove the interval between. A closing gap is followed to its root by Newton steps,
// each no longer than this bound can prove. (Mirtich's conservative advancement, 1996, divides by a bound on the speed,
// which is this bound with one end. Root finding on a separation function, Catto's "Continuous Collision", 2013, proves
// nothing between.)

#include <abut/convex/gjk/signed_distance.hpp>
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

/// The separation at a time, with its derivatives for the current support points; other points may come nearer.
struct Gap {
    double gap;
    double rate, acceleration;  ///< the first and second derivative
};

template <int D>
class SeparationFunction {
public:
    /// The axis is `normal`, of length 1, from A to B, at the time `from`, to which both sets are moved.
    SeparationFunction(RotatingSet<D>& a, RotatingSet<D>& b, const DVec<D>& normal,
                       const AngularVelocity<D>& angular_velocity, double from);

    /// Moves both sets to that time.
    Gap at(double time);
    /// The separation at the time `from`, for sets that are there, from known closest points.
    Gap at_first(const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const;

    /// The maximum of |f''| for any two vertices from then on.
    double acceleration_bound() const { return acceleration_bound_; }

private:
    Gap measured(double time, const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const;

    RotatingSet<D>&a_, &b_;
    RotationAxis<D> axis_;
    /// The set that rotates with the axis, whose angle at any time is known; the normal is then relative to the start
    /// of its motion. Otherwise null, and relative to the time `from`.
    const RotatingSet<D>* co_rotating_;
    RotatingVector<D> normal_;
    AngularVelocity<D> spin_;
    double from_, acceleration_bound_;
};

/// The proven part of the motion.
struct SeparatedUntil {
    double time;  ///< until then the separation is at least `level`, to rounding
    double gap;   ///< at that time
};

/// Advances from a time with separation `first`, until it is at most `level + tolerance`, or the time `until`, or the
/// bound on steps. The result is proven in each case.
template <int D>
SeparatedUntil separated_until(SeparationFunction<D>& gap, double from, double until, const Gap& first, double level,
                               double tolerance);

/// The angular velocity with which the axis stays orthogonal to the edges or faces that the corners span.
template <int D>
AngularVelocity<D> axis_angular_velocity(const RotatingSet<D>& a, const RotatingSet<D>& b, const DVec<D>& normal,
                                         const ClosestCorners<D>& corners);

}  // namespace abut::detail
