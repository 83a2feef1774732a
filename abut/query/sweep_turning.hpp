#pragma once

// The first hit of two shapes that move and rotate.

#include <abut/math/motion.hpp>
#include <abut/query/raycast.hpp>

namespace abut {

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Motion<D>& motion_a, const View<D>& b, const Motion<D>& motion_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::Convex<D>& a, const Motion<D>& motion_a, const detail::Convex<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::ShapeRef<D>& a, const Motion<D>& motion_a, const detail::ShapeRef<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const View<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::Convex<D>& a, const Pose<D>& from_a, const Pose<D>& to_a,
                            const detail::Convex<D>& b, const Pose<D>& from_b, const Pose<D>& to_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::ShapeRef<D>& a, const Pose<D>& from_a, const Pose<D>& to_a,
                            const detail::ShapeRef<D>& b, const Pose<D>& from_b, const Pose<D>& to_b,
                            const QueryOptions<D>& options = {});

/// The first contact gained while both shapes move and rotate, or none. Each shape is in the frame that its motion
/// moves, such as a Box around the origin or a Mesh in its own coordinates. It may rotate by any angle, also several
/// times around.
///
/// At `fraction` of both motions the shapes are apart by at most the tolerance, and before that never deeper in one
/// another than the tolerance. The fraction is rounded down to a float, so a fast shape stops early by up to 6e-8 of
/// its motion. `distance` is that fraction of A's translation relative to B; `normal` faces A, `point` is on B, and the
/// feature is B's. At a composite B the normal is a surface normal, never that of an internal edge.
///
/// Shapes that touch or overlap at the start hit at 0 only if the motion goes further in at once, judged at the
/// contact. Shapes that slide, spin in place or move apart don't hit then. They hit as soon as two parts are deeper
/// than at the start by more than the tolerance (half of it if they only touched), or when they touch again after being
/// apart.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Motion<dimension<A>>& motion_a, const B& b,
                                                           const Motion<dimension<A>>& motion_b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b,
                              [&](const auto& x, const auto& y) { return sweep(x, motion_a, y, motion_b, options); });
}

/// The sweep against a shape B at rest.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Motion<dimension<A>>& motion, const B& b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return sweep(a, motion, b, Motion<dimension<A>>{}, options);
}
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Motion<dimension<A>>& motion, const B& b,
                                                           detail::EmptyBraces) {
    return sweep(a, motion, b);
}

/// The sweep from pose to pose, by the shorter rotation (`Motion::between`).
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Pose<dimension<A>>& from_a,
                                                           const Pose<dimension<A>>& to_a, const B& b,
                                                           const Pose<dimension<A>>& from_b,
                                                           const Pose<dimension<A>>& to_b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(
        a, b, [&](const auto& x, const auto& y) { return sweep(x, from_a, to_a, y, from_b, to_b, options); });
}

}  // namespace abut
