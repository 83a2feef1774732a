#pragma once

// The gap between two sets on their ways, seen along an axis that turns evenly, and for how long it surely stays open.
//
// Of a corner a of A and b of B the part of b - a along the axis n is a smooth function of time,
//
//     f = n.p + n.y_b - n.y_a,    p from pivot to pivot, y from a pivot to the corner;
//     p'' = 0,  n' = W x n,  y' = w x y,
//     f'' = (W x (W x n)).p + 2 (W x n).p' + g_b - g_a,    g = (d x (d x n) + (d x w) x n).y,  d = W - w,
//
// of which the last takes a page of triple products. So |f''| <= K, with K from |p|, |p'| and how far A and B reach
// from their pivots, and it is zero for what the axis turns with. The gap is the least f of all corners, however many,
// flat or round the sets: between two times h apart at which it is g1 and g2, each f is above its chord less K/2 x (h -
// x), and so
//
//     gap >= g1 + (g2 - g1) x / h - K/2 x (h - x)    at x after the first.
//
// Two supports at either end prove what lies between. A gap that closes is followed to its root by Newton's steps, each
// as long as that bound can prove. (Conservative advancement, Mirtich 1996, divides by the greatest speed there is,
// which is this with one end; root finding on an axis of the features, Catto's "Continuous Collision", 2013, proves
// nothing between.)

#include <abut/convex/signed_distance.hpp>
#include <abut/convex/turning_set.hpp>

namespace abut {

/// How wide a gap is at some time, and how it goes on, of the places it is measured at: others may come nearer.
struct Gap {
    double gap;
    double rate, acceleration;  ///< its first and second derivative
};

template <int D>
class TurningGap {
public:
    /// The axis is `normal`, of length 1, from A to B, at the time `from`, to which both sets are taken.
    TurningGap(TurningSet<D>& a, TurningSet<D>& b, const DVec<D>& normal, const Spin<D>& spin, double from);

    /// Takes both sets to that time.
    Gap at(double time);
    /// At the time `from`, of sets that have gone there, where the gap and a place on either side of it are known.
    Gap at_first(const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const;

    /// The most that |f''| is for any two corners from then on.
    double bend() const { return bend_; }

private:
    Gap measured(double time, const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const;

    TurningSet<D>&a_, &b_;
    TurningAxis<D> axis_;
    /// One of the two that turns as fast as the axis, whose angle at any time is known; then the normal is told from
    /// the beginning of its motion. Else null, and told from the time `from`.
    const TurningSet<D>* alike_;
    TurningVector<D> normal_;
    Spin<D> spin_;
    double from_, bend_;
};

/// What is known of a gap.
struct OpenUntil {
    double time;  ///< until then it is at least `level`, but for rounding
    double gap;   ///< at that time
};

/// Follows the gap from a time at which it is `first`, until it is at most `level + slack`, or the time `until`, or the
/// bound on steps: what is told is true in any case.
template <int D>
OpenUntil open_until(TurningGap<D>& gap, double from, double until, const Gap& first, double level, double slack);

/// What the axis across two features should turn by to stay across them: the edges, or faces, that the corners span.
template <int D>
Spin<D> spin_across(const TurningSet<D>& a, const TurningSet<D>& b, const DVec<D>& normal,
                    const MeetingCorners<D>& corners);

}  // namespace abut
