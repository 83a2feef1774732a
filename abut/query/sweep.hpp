#pragma once

// When do two shapes that move straight first touch?

#include <abut/math/ray.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/options.hpp>
#include <abut/query/sweep_turning.hpp>
#include <abut/shape/view.hpp>

#include <optional>

namespace abut {

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Vec<D>& motion_a, const View<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Vec<D>& motion_a, const Convex<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const Given<D>& a, const Vec<D>& motion_a, const Given<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options = {});

/// The first touch of two shapes that both move straight, without turning, in the same time.
///
/// A is the mover: `normal` faces it, `feature` is of B, and `distance` is how far A has come by then as B sees it:
/// fraction * |motion_a - motion_b|. `point` is where they touch in the world at that moment, on both.
///
/// What touches or overlaps at the start is hit at 0 only if A goes further in; along or apart is no hit, and of a
/// composite shape the other parts still can be hit. What comes to slide on a surface without going deeper in than
/// the margin of doubt is not hit by it: a crate slides over the seams of its floor. However thin the shapes and
/// however long the motion, none is passed through. Motions that are not finite trip ABUT_ASSERT and hit nothing.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Vec<dimension<A>>& motion_a, const B& b,
                                                           const Vec<dimension<A>>& motion_b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return sweep(detail::view_beside<A, B>(a), motion_a, detail::view_beside<B, A>(b), motion_b, options);
}

/// The same where B rests.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Vec<dimension<A>>& motion, const B& b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return sweep(a, motion, b, Vec<dimension<A>>(0.0f), options);
}
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Vec<dimension<A>>& motion, const B& b,
                                                           detail::EmptyBraces) {
    return sweep(a, motion, b);
}

}  // namespace abut
