#pragma once

// An index of a list of pairs, which finds the pairs of one item.

#include <abut/math/function_ref.hpp>
#include <abut/world/id.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Indexes a list of pairs sorted by (a, b), which it doesn't store. It allocates nothing once it has indexed as many.
class PairIndex {
public:
    /// `capacity` is the number of pairs to reserve memory for.
    void build(std::span<const IdPair> pairs, std::size_t capacity);

    /// Calls visit(other) for the pairs of an item, sorted by the other's id; it returns false to stop. `pairs` is the
    /// list of the last build.
    void visit(std::span<const IdPair> pairs, Id id, FunctionRef<bool(Id)> visit) const;

private:
    std::vector<std::uint32_t> by_b_, scratch_;  // indices of the pairs, sorted by (b, a)
};

}  // namespace abut::detail
