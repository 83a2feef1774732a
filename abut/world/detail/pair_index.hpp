#pragma once

// An index of a list of pairs, which finds the pairs of one item.

#include <abut/math/function_ref.hpp>
#include <abut/world/detail/deferred_work.hpp>
#include <abut/world/id.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Indexes a list of pairs sorted by (a, b), which it doesn't store, when it is first used.
class PairIndex {
public:
    /// Call this after each change of the list. `capacity` is the number of pairs to reserve memory for.
    void defer(std::size_t capacity);

    /// Calls visit(other) for the pairs of an item, sorted by the other's id; it returns false to stop. It allocates
    /// nothing, and may run on many threads at once.
    void visit(std::span<const IdPair> pairs, Id id, FunctionRef<bool(Id)> visit) const;

private:
    void build(std::span<const IdPair> pairs) const;

    mutable std::vector<std::uint32_t> by_b_, scratch_;  // indices of the pairs, sorted by (b, a)
    mutable DeferredWork build_;
};

}  // namespace abut::detail
