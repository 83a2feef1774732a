#pragma once

// Names in the compiler's message for calls that don't compile.
//
// Each public query has an overload for the arguments that it rejects: a template without a body, whose return type is
// deduced. A call is an error of one line, and `requires` finds no valid call. Its last template argument, which
// compilers print, is one of the types declared here.

#include <abut/math/pose.hpp>
#include <abut/shape/view/view.hpp>

#include <type_traits>

namespace abut::detail {

struct the_first_argument_is_no_shape;
struct the_second_argument_is_no_shape;
struct these_two_shapes_differ_in_dimension;
struct two_half_spaces_do_not_pair;
struct this_is_no_shape;
struct this_shape_has_another_dimension;
struct a_motion_of_this_dimension_is_needed_here;
struct a_Pose_of_this_dimension_is_needed_here_and_not_a_position;
struct this_view_only_refers_to_a_shape_that_another_owns_so_use_any_shape;

/// The dimension of a shape. For other types it is 3, so that a rejecting overload can be declared.
template <class S>
inline constexpr int dimension_or_3 = 3;
template <Shape S>
inline constexpr int dimension_or_3<S> = dimension<S>;

template <class A, class B>
auto why_no_pair() {
    if constexpr (!Shape<A>)
        return std::type_identity<the_first_argument_is_no_shape>();
    else if constexpr (!Shape<B>)
        return std::type_identity<the_second_argument_is_no_shape>();
    else if constexpr (dimension<A> != dimension<B>)
        return std::type_identity<these_two_shapes_differ_in_dimension>();
    else
        return std::type_identity<two_half_spaces_do_not_pair>();
}

/// No type if A and B are a Pair.
template <class A, class B>
requires(!Pair<A, B>) using WhyNoPair = typename decltype(why_no_pair<A, B>())::type;

template <class S, int D>
concept ShapeIn = Shape<S> && dimension<S>
== D;

/// No type if S is a shape of dimension D.
template <int D, class S>
requires(!ShapeIn<S, D>) using WhyNotIn =
    std::conditional_t<Shape<S>, this_shape_has_another_dimension, this_is_no_shape>;

/// No type if S is a shape.
template <class S>
requires(!Shape<S>) using WhyNoShape = std::conditional_t<Shape<S>, void, this_is_no_shape>;

/// No type if P is a pose of dimension D.
template <int D, class P>
requires(!std::is_convertible_v<const P&, Pose<D>>) using WhyNoPose = std::conditional_t<
    std::is_convertible_v<const P&, Pose<D>>, void, a_Pose_of_this_dimension_is_needed_here_and_not_a_position>;

/// No type if the arguments are valid for `at`.
template <class S, class P>
requires(!Shape<S> || !std::is_convertible_v<const P&, Pose<dimension_or_3<S>>>) using WhyNotAt =
    std::conditional_t<Shape<S>, a_Pose_of_this_dimension_is_needed_here_and_not_a_position, this_is_no_shape>;

/// glm converts a vector of three coordinates to one of two and drops the third.
template <class P, int D>
inline constexpr bool is_other_point = false;
template <int E, int D>
inline constexpr bool is_other_point<glm::vec<E, float>, D> = E != D;

template <class P, int D>
concept PointIn = std::is_convertible_v<const P&, Vec<D>> && !is_other_point<P, D>;

}  // namespace abut::detail
