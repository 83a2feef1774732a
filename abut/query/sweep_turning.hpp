#pragma once

// When do two shapes first meet, that move and turn on the way?

#include <abut/math/motion.hpp>
#include <abut/query/raycast.hpp>

namespace abut {

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Motion<D>& motion_a, const View<D>& b, const Motion<D>& motion_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Motion<D>& motion_a, const Convex<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Motion<D>& motion_a, const ShapeRef<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const View<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const Convex<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const ShapeRef<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options = {});

/// The first contact that is gained while both shapes move and turn; none where there is none. Each shape is as it is
/// in the frame that its motion moves, such as a Box about the origin or a Mesh in its own coordinates, and may turn by
/// any angle, several times around too.
///
/// At `fraction` of both motions they are apart by at most the margin of doubt, and before that never deeper in one
/// another than that margin. It is rounded down to a float, so what is fast is met early by up to 6e-8 of its way.
/// `distance` is that fraction of the straight way that A goes relative to B; `normal` faces A, `point` is on B, and
/// the feature is B's. At a composite B the normal is that of the surface as it is felt: no part's edge inside a floor.
///
/// Shapes that touch or overlap at first hit at 0 only if the motion goes further in at once, judged where they touch.
/// What slides, turns on the spot or moves apart is no hit then, but is one as soon as two parts are deeper in one
/// another than they were at first, by more than the margin (half of it where they only touched), or as they touch
/// anew after they have been apart.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Motion<dimension<A>>& motion_a, const B& b,
                                                           const Motion<dimension<A>>& motion_b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b,
                              [&](const auto& x, const auto& y) { return sweep(x, motion_a, y, motion_b, options); });
}

/// The same of one that moves and one that doesn't.
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

/// The same from pose to pose, turning the short way (`Motion::between`).
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
