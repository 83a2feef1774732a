#pragma once

// Radix sort by integer keys, and keys of floats. For .cpp files.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut::detail {

/// An integer in the order of the floats; 0 and -0 are equal.
inline std::uint32_t key_of(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);
    return bits ^ ((0 - (bits >> 31)) | 1u << 31);
}

/// Sorts by the lowest `bits` bits of key(item), an unsigned number. The sort is stable (least significant digit
/// first, at most 11 bits a pass). `scratch` has capacity for `count` items. The result points to the sorted items: it
/// is `items` or `scratch`.
template <class T, class Key>
T* radix_sort(T* items, T* scratch, std::size_t count, int bits, Key key) {
    constexpr int max_bits = 11;
    const int passes = (bits + max_bits - 1) / max_bits;
    for (int pass = 0, shift = 0; pass < passes; ++pass) {
        const int width = (bits - shift + passes - pass - 1) / (passes - pass);
        const auto digit_of = [&key, shift, width](const T& item) {
            return static_cast<std::size_t>(key(item) >> shift) & ((std::size_t{1} << width) - 1);
        };
        shift += width;
        std::array<std::uint32_t, std::size_t{1} << max_bits> places;
        std::fill_n(places.begin(), std::size_t{1} << width, 0u);
        for (std::size_t i = 0; i < count; ++i) ++places[digit_of(items[i])];
        if (count > 0 && places[digit_of(items[0])] == count) continue;
        std::uint32_t place = 0;
        for (std::size_t digit = 0; digit < std::size_t{1} << width; ++digit)
            place += std::exchange(places[digit], place);
        for (std::size_t i = 0; i < count; ++i) scratch[places[digit_of(items[i])]++] = items[i];
        std::swap(items, scratch);
    }
    return items;
}

}  // namespace abut::detail
