#include <abut/broad_phase/detail/sort_pairs.hpp>
#include <abut/math/detail/radix_sort.hpp>

#include <algorithm>
#include <bit>

namespace abut::detail {

void sort_pairs(std::vector<ItemPair>& pairs) {
    const std::size_t count = pairs.size();
    constexpr std::size_t min_radix_count = 64;
    if (count < min_radix_count) return std::sort(pairs.begin(), pairs.end());
    std::uint32_t first_bits = 0, second_bits = 0;
    for (const auto& [i, j] : pairs) {
        first_bits |= i;
        second_bits |= j;
    }
    const int low = static_cast<int>(std::bit_width(second_bits));
    const int bits = low + static_cast<int>(std::bit_width(first_bits));
    pairs.resize(2 * count);
    ItemPair* const begin = pairs.data();
    const ItemPair* const sorted = radix_sort(begin, begin + count, count, bits, [low](const ItemPair& pair) {
        return std::uint64_t{pair.first} << low | pair.second;
    });
    if (sorted != begin) std::copy_n(sorted, count, begin);
    pairs.resize(count);
}

}  // namespace abut::detail
