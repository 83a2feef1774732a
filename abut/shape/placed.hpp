#pragma once

// Composable adapters of a shape: placed by a pose, rounded, stretched. They refer to an lvalue and own an rvalue.

#include <abut/shape/view/constraints.hpp>

#include <utility>

namespace abut {

/// `shape` at `pose`, which is applied after the shape's own position.
template <class S>
struct At {
    S shape;
    Pose<dimension<std::remove_cvref_t<S>>> pose;
};

/// All points within `radius` of `shape`: the Minkowski sum with a ball.
template <class S>
struct Rounded {
    S shape;
    float radius;
};

/// `shape` scaled along each axis, about the origin of its local frame.
template <class S>
struct Stretched {
    S shape;
    Vec<dimension<std::remove_cvref_t<S>>> scale;
};

template <class S>
requires Shape<std::remove_cvref_t<S>> At<S> at(S&& shape, const Pose<dimension<std::remove_cvref_t<S>>>& pose) {
    return {std::forward<S>(shape), pose};
}

template <class S, class P, class Why = detail::WhyNotAt<std::remove_cvref_t<S>, P>>
auto at(S&& shape, const P& pose);

/// `radius` is at least 0.
template <class S>
requires Shape<std::remove_cvref_t<S>> Rounded<S> rounded(S&& shape, float radius) {
    return {std::forward<S>(shape), radius};
}
template <class S, class Why = detail::WhyNoShape<std::remove_cvref_t<S>>>
auto rounded(S&& shape, float radius);

namespace detail {

/// True if S contains a `rounded` outside a `stretched`.
template <class S>
inline constexpr bool rounded_after_stretching = false;
template <class S>
inline constexpr bool was_stretched = false;
template <class S>
inline constexpr bool was_stretched<At<S>> = was_stretched<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool was_stretched<Rounded<S>> = was_stretched<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool was_stretched<Stretched<S>> = true;
template <class S>
inline constexpr bool rounded_after_stretching<At<S>> = rounded_after_stretching<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool rounded_after_stretching<Stretched<S>> = rounded_after_stretching<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool rounded_after_stretching<Rounded<S>> = was_stretched<std::remove_cvref_t<S>>;

}  // namespace detail

/// A negative factor mirrors, 0 flattens. A shape that was stretched and then rounded can't be stretched again: that is
/// the sum of two ellipsoids. Where the type doesn't show it, as of a child of a compound, the rounding stays round and
/// changes by the least factor.
template <class S>
requires Shape<std::remove_cvref_t<S>> Stretched<S> stretched(S&& shape,
                                                              const Vec<dimension<std::remove_cvref_t<S>>>& scale) {
    static_assert(!detail::rounded_after_stretching<std::remove_cvref_t<S>>,
                  "a shape that was stretched and then rounded can't be stretched again: stretch first, round last");
    return {std::forward<S>(shape), scale};
}
template <class S, class Why = detail::WhyNoShape<std::remove_cvref_t<S>>>
auto stretched(S&& shape, const auto& scale);

namespace detail {

template <class S>
inline constexpr bool is_at = false;
template <class S>
inline constexpr bool is_at<At<S>> = true;

/// Primitives take the pose when their view is made.
template <class S, int D>
concept PlacedByPose = requires(const S& shape, const Pose<D>& pose) {
    convex(shape, pose);
};

/// Polytopes, whose vertices have no placement of their own, take an affine map when their view is made.
template <class S, int D>
concept HasOwnFrame = requires(const S& shape, const Affine<D>& place) {
    convex(shape, place);
};

}  // namespace detail

template <class S>
auto view(const At<S>& shape) {
    using Inner = std::remove_cvref_t<S>;
    if constexpr (detail::PlacedByPose<Inner, dimension<Inner>>)
        return convex(std::as_const(shape.shape), shape.pose);
    else if constexpr (detail::HasOwnFrame<Inner, dimension<Inner>>)
        return convex(std::as_const(shape.shape), detail::affine(shape.pose));
    else
        return moved(view(std::as_const(shape.shape)), detail::affine(shape.pose));
}
/// Only for a shape that isn't placed by a pose already.
template <class S>
requires(detail::HasShapeRef<std::remove_cvref_t<S>> && !detail::is_at<std::remove_cvref_t<S>>)
    detail::ShapeRef<dimension<std::remove_cvref_t<S>>> shape_ref(const At<S>& shape) {
    const auto inner = shape_ref(std::as_const(shape.shape));
    return {inner.kind, inner.shape, &shape.pose};
}
template <class S>
auto view(const Rounded<S>& shape) {
    // Passed as an lvalue, so that overload resolution takes the function for views, not the adapter.
    const auto inner = view(std::as_const(shape.shape));
    return rounded(inner, static_cast<double>(shape.radius));
}
template <class S>
auto view(const Stretched<S>& shape) {
    return mapped(view(std::as_const(shape.shape)), detail::scaling(shape.scale));
}

namespace detail {

template <class S>
struct Owned {
    using type = std::remove_cvref_t<S>;
};
template <class S>
struct Owned<At<S>> {
    using type = At<typename Owned<std::remove_cvref_t<S>>::type>;
};
template <class S>
struct Owned<Rounded<S>> {
    using type = Rounded<typename Owned<std::remove_cvref_t<S>>::type>;
};
template <class S>
struct Owned<Stretched<S>> {
    using type = Stretched<typename Owned<std::remove_cvref_t<S>>::type>;
};

/// True if S is a view, which refers to a shape of an erased type, or an adapter of one.
template <class S>
inline constexpr bool is_view = false;
template <int D>
inline constexpr bool is_view<View<D>> = true;
template <int D>
inline constexpr bool is_view<Convex<D>> = true;
template <int D>
inline constexpr bool is_view<Composite<D>> = true;
template <int D>
inline constexpr bool is_view<DistanceFunction<D>> = true;
template <class S>
inline constexpr bool is_view<At<S>> = is_view<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool is_view<Rounded<S>> = is_view<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool is_view<Stretched<S>> = is_view<std::remove_cvref_t<S>>;

}  // namespace detail

/// A shape that `owned`, AnyShape and World can own: any shape but a view, such as World::shape returns.
template <class S>
concept Ownable = Shape<S> && !detail::is_view<S>;

namespace detail {

/// No type if S is an ownable shape of dimension D; else the reason why it isn't.
template <int D, class S>
requires(!ShapeIn<S, D> || !Ownable<S>) using WhyNotOwnable =
    std::conditional_t<!Shape<S>, this_is_no_shape,
                       std::conditional_t<!ShapeIn<S, D>, this_shape_has_another_dimension,
                                          this_view_only_refers_to_a_shape_that_another_owns_so_use_any_shape>>;

}  // namespace detail

/// A view as an ownable shape. The caller ensures that the shape it refers to outlives all copies.
template <int D>
struct Unowned {
    View<D> shape;
};
template <int D>
const View<D>& view(const Unowned<D>& shape) {
    return shape.shape;
}
template <int D>
Aabb<D> bounds(const Unowned<D>& shape) {
    return bounds(shape.shape);
}

/// A copy of the shape that owns everything it referred to.
template <Ownable S>
S owned(const S& shape) {
    return shape;
}
template <class S>
requires Ownable<std::remove_cvref_t<S>>
typename detail::Owned<At<S>>::type owned(const At<S>& shape) {
    return {owned(std::as_const(shape.shape)), shape.pose};
}
template <class S>
requires Ownable<std::remove_cvref_t<S>>
typename detail::Owned<Rounded<S>>::type owned(const Rounded<S>& shape) {
    return {owned(std::as_const(shape.shape)), shape.radius};
}
template <class S>
requires Ownable<std::remove_cvref_t<S>>
typename detail::Owned<Stretched<S>>::type owned(const Stretched<S>& shape) {
    return {owned(std::as_const(shape.shape)), shape.scale};
}

template <class S>
Aabb<dimension<std::remove_cvref_t<S>>> bounds(const At<S>& shape) {
    return bounds(view(shape));
}
template <class S>
Aabb<dimension<std::remove_cvref_t<S>>> bounds(const Rounded<S>& shape) {
    return bounds(view(shape));
}
template <class S>
Aabb<dimension<std::remove_cvref_t<S>>> bounds(const Stretched<S>& shape) {
    return bounds(view(shape));
}

}  // namespace abut
