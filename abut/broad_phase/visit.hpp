#pragma once

// Visitors: the callable that a user hands to a traversal, and the one form in which it reaches a .cpp file.

#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>

#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace abut {

/// Is told of pairs or items: `visit(i, j)` or `visit(i)`. Returns nothing (go on) or bool (false stops).
template <class F, class... Items>
concept Visitor = std::invocable<F&, Items...> &&
    (std::is_void_v<std::invoke_result_t<F&, Items...>> || std::same_as<std::invoke_result_t<F&, Items...>, bool>);

/// Is told of items within reach: `visit(i)`. Returns nothing (go on), bool (false stops) or float: the new reach, as a
/// distance. The reach only shrinks: a larger one and NaN change nothing; a negative one stops; at 0 the search goes on
/// among what is touched.
template <class F>
concept ReachVisitor = Visitor<F, std::uint32_t> ||
    (std::invocable<F&, std::uint32_t>&& std::same_as<std::invoke_result_t<F&, std::uint32_t>, float>);

using ItemPair = std::pair<std::uint32_t, std::uint32_t>;
using PairsCall = FunctionRef<bool(std::span<const ItemPair>)>;  ///< some pairs at once; false stops
using ItemCall = FunctionRef<bool(std::uint32_t)>;               ///< false stops
using ReachCall = FunctionRef<float(std::uint32_t)>;             ///< the new reach
template <int D>
using BoxCall = FunctionRef<bool(std::uint32_t, const Aabb<D>&)>;  ///< an item and its box; false stops

/// Any visitor of pairs or items as one that returns whether to go on. Refers to `visit`, or is a copy of an ItemCall.
template <class F>
auto go_on_after(F& visit) {
    if constexpr (std::is_same_v<std::remove_const_t<F>, ItemCall>) {
        return visit;
    } else {
        return [&visit](const auto&... items) -> bool {
            if constexpr (std::is_void_v<std::invoke_result_t<F&, decltype(items)...>>) {
                visit(items...);
                return true;
            } else {
                return visit(items...);
            }
        };
    }
}

/// Any visitor of pairs as one that takes some at once. Refers to `visit`.
template <Visitor<std::uint32_t, std::uint32_t> F>
auto each_pair_to(F& visit) {
    return [&visit](std::span<const ItemPair> pairs) -> bool {
        const auto go_on = go_on_after(visit);
        for (const auto& [i, j] : pairs)
            if (!go_on(i, j)) return false;
        return true;
    };
}

/// Any visitor of items within reach as one that returns the new reach. Refers to `visit`, or is a copy of a ReachCall.
template <ReachVisitor F>
auto reach_after(F& visit) {
    if constexpr (std::is_same_v<std::remove_const_t<F>, ReachCall>) {
        return visit;
    } else {
        return [&visit](std::uint32_t item) -> float {
            using Answer = std::invoke_result_t<F&, std::uint32_t>;
            if constexpr (std::is_same_v<Answer, float>) {
                return visit(item);
            } else {
                constexpr float on = std::numeric_limits<float>::infinity();
                return go_on_after(visit)(item) ? on : -on;
            }
        };
    }
}

}  // namespace abut
