#pragma once

// Visitors: the callables that a user passes to a query, and their type-erased forms for .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>

#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace abut::detail {

/// A callable that receives pairs or items: `visit(i, j)` or `visit(i)`. It returns nothing (continue) or bool (false
/// stops).
template <class F, class... Items>
concept Visitor = std::invocable<F&, Items...> &&
    (std::is_void_v<std::invoke_result_t<F&, Items...>> || std::same_as<std::invoke_result_t<F&, Items...>, bool>);

/// A callable that receives items within reach: `visit(i)`. It returns nothing (continue), bool (false stops) or float:
/// the new reach, as a distance. The reach only shrinks: a larger one and NaN change nothing; a negative one stops; at
/// 0 the search continues among the boxes that are touched.
template <class F>
concept ReachVisitor = Visitor<F, std::uint32_t> ||
    (std::invocable<F&, std::uint32_t>&& std::same_as<std::invoke_result_t<F&, std::uint32_t>, float>);

using ItemPair = std::pair<std::uint32_t, std::uint32_t>;
using PairsCall = FunctionRef<bool(std::span<const ItemPair>)>;  ///< a batch of pairs; false stops
using ItemCall = FunctionRef<bool(std::uint32_t)>;               ///< false stops
using ReachCall = FunctionRef<float(std::uint32_t)>;             ///< the new reach
template <int D>
using BoxCall = FunctionRef<bool(std::uint32_t, const Aabb<D>&)>;  ///< an item and its box; false stops

/// Adapts a visitor of pairs or items to one that returns bool: false stops. The result refers to `visit`, or is a copy
/// of an ItemCall.
template <class F>
auto bool_visitor(F& visit) {
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

/// Adapts a visitor of pairs to one that receives batches of pairs. The result refers to `visit`.
template <Visitor<std::uint32_t, std::uint32_t> F>
auto batch_visitor(F& visit) {
    return [&visit](std::span<const ItemPair> pairs) -> bool {
        const auto continues = bool_visitor(visit);
        for (const auto& [i, j] : pairs)
            if (!continues(i, j)) return false;
        return true;
    };
}

/// Adapts a visitor of items within reach to one that returns the new reach. The result refers to `visit`, or is a copy
/// of a ReachCall.
template <ReachVisitor F>
auto reach_visitor(F& visit) {
    if constexpr (std::is_same_v<std::remove_const_t<F>, ReachCall>) {
        return visit;
    } else {
        return [&visit](std::uint32_t item) -> float {
            using Answer = std::invoke_result_t<F&, std::uint32_t>;
            if constexpr (std::is_same_v<Answer, float>) {
                return visit(item);
            } else {
                constexpr float infinity = std::numeric_limits<float>::infinity();
                return bool_visitor(visit)(item) ? infinity : -infinity;
            }
        };
    }
}

}  // namespace abut::detail
