#pragma once

// The first hit of two shapes that move straight (convex cast), or that move and rotate.

#include <abut/math/detail/rigid_path.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/constraints.hpp>

#include <optional>

namespace abut {

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Vec<D>& motion_a, const View<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::Convex<D>& a, const Vec<D>& motion_a, const detail::Convex<D>& b,
                            const Vec<D>& motion_b, const QueryOptions<D>& options = {});
template <int D>
std::optional<Hit<D>> sweep(const detail::ShapeRef<D>& a, const Vec<D>& motion_a, const detail::ShapeRef<D>& b,
                            const Vec<D>& motion_b, const QueryOptions<D>& options = {});

namespace detail {

/// The sweep of two shapes that each follow a path.
template <int D>
std::optional<Hit<D>> sweep_paths(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b,
                                  const RigidPath<D>& path_b, const QueryOptions<D>& options);
template <int D>
std::optional<Hit<D>> sweep_paths(const Convex<D>& a, RigidPath<D> path_a, const Convex<D>& b, RigidPath<D> path_b,
                                  const QueryOptions<D>& options);
template <int D>
std::optional<Hit<D>> sweep_paths(const ShapeRef<D>& a, const RigidPath<D>& path_a, const ShapeRef<D>& b,
                                  const RigidPath<D>& path_b, const QueryOptions<D>& options);

}  // namespace detail

/// The first hit of two shapes that both move straight, without rotation, in the same time.
///
/// A is the mover: `normal` faces it, `feature` is of B, and `distance` is how far A has moved relative to B by then:
/// fraction * |motion_a - motion_b|. `point` is the point of contact in the world at that moment, on both shapes.
///
/// Shapes that touch or overlap at the start are hit at 0 only if A goes further in; moving along or apart is no hit,
/// and the other parts of a composite shape can still be hit. A shape that slides on a surface without going deeper
/// than the tolerance doesn't hit it: a crate slides over the seams of its floor. No shape is passed through, however
/// thin the shapes and however long the motion (no tunnelling). Motions that aren't finite trip ABUT_ASSERT and hit
/// nothing.
template <class A, class B>
requires Pair<A, B> std::optional<Hit<dimension<A>>> sweep(const A& a, const Vec<dimension<A>>& motion_a, const B& b,
                                                           const Vec<dimension<A>>& motion_b,
                                                           const QueryOptions<dimension<A>>& options = {}) {
    return detail::with_views(a, b,
                              [&](const auto& x, const auto& y) { return sweep(x, motion_a, y, motion_b, options); });
}

/// The sweep against a shape B at rest.
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
    return detail::with_views(a, b, [&](const auto& x, const auto& y) {
        return detail::sweep_paths(x, detail::rigid_path(motion_a), y, detail::rigid_path(motion_b), options);
    });
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
    return detail::with_views(a, b, [&](const auto& x, const auto& y) {
        return detail::sweep_paths(x, detail::rigid_path(from_a, to_a), y, detail::rigid_path(from_b, to_b), options);
    });
}

namespace detail {

/// The arguments of a sweep without its shapes.
template <int D>
struct MotionsOfSweep {
    void operator()(const Vec<D>&, const QueryOptions<D>& = {}) const;
    void operator()(const Vec<D>&, const Vec<D>&, const QueryOptions<D>& = {}) const;
    void operator()(const Motion<D>&, const QueryOptions<D>& = {}) const;
    void operator()(const Motion<D>&, const Motion<D>&, const QueryOptions<D>& = {}) const;
};
template <int D>
struct PosesOfSweep {
    void operator()(const Pose<D>&, const Pose<D>&, const Pose<D>&, const Pose<D>&, const QueryOptions<D>& = {}) const;
};

/// Void if the arguments are those of a sweep; else a type whose name says what is wrong.
template <class A, class M, class B, class... More>
struct WhyOrVoid : decltype(why_no_pair<A, B>()) {};
template <class A, class M, class B, class... More>
requires Pair<A, B>
struct WhyOrVoid<A, M, B, More...> : std::conditional<std::is_invocable_v<MotionsOfSweep<dimension<A>>, M, More...> &&
                                                          !is_other_point<M, dimension<A>>,
                                                      void, a_motion_of_this_dimension_is_needed_here> {
};
template <class A, class From, class To, class B, class... More>
requires(!Shape<To> && Shape<B> && !Pair<A, B>) struct WhyOrVoid<A, From, To, B, More...>
    : decltype(why_no_pair<A, B>()) {
};
template <class A, class From, class To, class B, class... More>
requires(!Shape<To> && Pair<A, B>) struct WhyOrVoid<A, From, To, B, More...>
    : std::conditional<std::is_invocable_v<PosesOfSweep<dimension<A>>, From, To, More...>, void,
                       a_Pose_of_this_dimension_is_needed_here_and_not_a_position> {
};

template <class... Arguments>
requires(!std::is_void_v<typename WhyOrVoid<Arguments...>::type>) using WhyNoSweep =
    typename WhyOrVoid<Arguments...>::type;

}  // namespace detail

template <class A, class M, class B, class... More, class Why = detail::WhyNoSweep<A, M, B, More...>>
auto sweep(const A& a, const M& motion, const B& b, const More&... more);

}  // namespace abut
