#pragma once

// The questions about pairs of parts of which one or both are known by their distance alone. docs/decisions/0012 tells
// what the answers mean. For .cpp files.
//
// Beside a convex set, before or after it, the distance is the least that the function is in the core, less the radius:
// the gap, or minus the depth of its deepest point. Beside a half-space it is how far the lowest point of the shape is
// above the border. Of two functions it is twice the least of the larger of both: where they overlap, minus the
// diameter of the largest ball in both.

#include <abut/query/convex_pair.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <type_traits>

namespace abut {

template <class Part>
struct PartDimension;
template <int D>
struct PartDimension<Convex<D>> : std::integral_constant<int, D> {};
template <int D>
struct PartDimension<HalfSpaceView<D>> : std::integral_constant<int, D> {};
template <int D>
struct PartDimension<DistanceFunction<D>> : std::integral_constant<int, D> {};

template <class Part>
inline constexpr bool is_function = false;
template <int D>
inline constexpr bool is_function<DistanceFunction<D>> = true;

/// Two parts, of which one or both are functions.
template <class A, class B>
concept FunctionPair = PartDimension<A>::value == PartDimension<B>::value && (is_function<A> || is_function<B>);

/// How far an answer about them may be off, with what rounding does to the coordinates that a function is asked of.
template <class A, class B>
requires FunctionPair<A, B>
double function_margin(const A& a, const B& b);

/// How far a distance may be off that took a search: more where a function tells nothing of itself.
template <class A, class B>
requires FunctionPair<A, B>
double function_doubt(const A& a, const B& b);

/// What is at most `enough` needn't be known exactly, and is infinite where it is more than `reach`. Infinite where a
/// function has no bounds and the other is a half-space or has none either.
struct DistanceWanted {
    double enough = -std::numeric_limits<double>::infinity();
    double reach = std::numeric_limits<double>::infinity();
    double rough = 0;    ///< so much above the least is as good
    int most_boxes = 0;  ///< of a search for the least of a function that bounds itself; 0: as the search has it
};

template <class A, class B>
requires FunctionPair<A, B> SignedDistance<PartDimension<A>::value> function_distance(const A& a, const B& b,
                                                                                      const DistanceWanted& wanted);

template <class A, class B>
requires FunctionPair<A, B> SignedDistance<PartDimension<A>::value> part_distance(
    const A& a, const B& b, const SearchOptions<PartDimension<A>::value>& = {}) {
    return function_distance(a, b, {});
}

/// Whether a convex set on its way is nowhere deeper in a function that bounds itself than its doubt. The way is in the
/// hull of the set where it begins and where it ends, made `wide` wider; all in one frame. Not: it may be at `place`.
template <int D>
bool stays_apart(const Convex<D>& first, const Convex<D>& last, double wide, const DistanceFunction<D>& function,
                 DVec<D>& place);

/// Stops where a point of both is found.
template <class A, class B>
requires FunctionPair<A, B>
bool function_overlap(const A& a, const B& b);

template <class A, class B>
requires FunctionPair<A, B>
bool part_overlaps(const A& a, const B& b, const SearchOptions<PartDimension<A>::value>&) {
    return function_overlap(a, b);
}

/// The points: of a convex set those of its face that looks at the function's shape.
template <class A, class B>
requires FunctionPair<A, B>
bool part_contact(const A& a, const B& b, double reach, double margin,
                  const SearchOptions<PartDimension<A>::value>& options, PartContact<PartDimension<A>::value>& contact);

template <class A, class B>
requires FunctionPair<A, B>
bool part_touch(const A& a, const B& b, double reach, double margin,
                const SearchOptions<PartDimension<A>::value>& options, PartContact<PartDimension<A>::value>& contact) {
    return part_contact(a, b, reach, margin, options, contact);
}
template <class A, class B>
requires FunctionPair<A, B>
void add_points(const A&, const B&, double, const SearchOptions<PartDimension<A>::value>&,
                PartContact<PartDimension<A>::value>&) {}

}  // namespace abut
