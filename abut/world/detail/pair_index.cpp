#include <abut/math/detail/radix_sort.hpp>
#include <abut/world/detail/pair_index.hpp>

#include <algorithm>
#include <bit>
#include <numeric>

namespace abut::detail {

void PairIndex::defer(std::size_t capacity) {
    by_b_.reserve(capacity);
    scratch_.reserve(capacity);
    build_.defer();
}

/// A stable sort by b's index suffices: the pairs are sorted by a, and in one update each index belongs to one id.
void PairIndex::build(std::span<const IdPair> pairs) const {
    by_b_.resize(pairs.size());
    scratch_.resize(pairs.size());
    std::iota(by_b_.begin(), by_b_.end(), 0u);
    std::uint32_t highest = 0;
    for (const IdPair& pair : pairs) highest = std::max(highest, pair.b.index);
    const std::uint32_t* sorted =
        radix_sort(by_b_.data(), scratch_.data(), pairs.size(), static_cast<int>(std::bit_width(highest)),
                   [pairs](std::uint32_t place) { return pairs[place].b.index; });
    if (sorted != by_b_.data()) std::swap(by_b_, scratch_);
}

void PairIndex::visit(std::span<const IdPair> pairs, Id id, FunctionRef<bool(Id)> visit) const {
    build_.run([&] { build(pairs); });
    // The pairs with a lower id come first.
    const auto first_b =
        std::partition_point(by_b_.begin(), by_b_.end(), [&](std::uint32_t place) { return pairs[place].b < id; });
    for (auto place = first_b; place != by_b_.end() && pairs[*place].b == id; ++place)
        if (!visit(pairs[*place].a)) return;
    const auto first_a = std::lower_bound(pairs.begin(), pairs.end(), IdPair{id, {}});
    for (auto pair = first_a; pair != pairs.end() && pair->a == id; ++pair)
        if (!visit(pair->b)) return;
}

}  // namespace abut::detail
