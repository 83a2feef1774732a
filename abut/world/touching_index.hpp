#pragma once

// Who touches an item: its pairs, among all of them.

#include <abut/math/function_ref.hpp>
#include <abut/world/id.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Over a list of pairs sorted by (a, b), which it doesn't keep. Allocates nothing once it has seen as many.
class TouchingIndex {
public:
    /// With capacity for as many pairs as the list itself may come to hold without growing.
    void build(std::span<const IdPair> pairs, std::size_t capacity);

    /// visit(other) for the pairs with this id, sorted by the other's id; it returns false to stop. `pairs` are those
    /// of the last build.
    void visit(std::span<const IdPair> pairs, Id id, FunctionRef<bool(Id)> visit) const;

private:
    std::vector<std::uint32_t> by_b_, scratch_;  // the places of the pairs, sorted by (b, a)
};

}  // namespace abut
