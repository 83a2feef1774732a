#pragma once

// Sorting by small whole numbers first: a bucket each, in time linear in their count where none holds many.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

struct Buckets {
    std::vector<std::uint64_t> keys;  ///< of all buckets, one after the other, each in rising order
    std::vector<std::uint32_t> ends;  ///< one a bucket: where it ends in `keys`

    std::span<const std::uint64_t> bucket(std::size_t number) const {
        const std::size_t begin = number == 0 ? 0 : ends[number - 1];
        return std::span(keys).subspan(begin, ends[number] - begin);
    }
};

/// `each` calls the function it is given with the bucket and the key of every item, below 2^32 of them; it is called
/// twice. No two keys of a bucket are the same.
template <class Each>
Buckets in_buckets(std::size_t count, Each each) {
    // Counted one bucket further on, so that filling them moves each start to its end.
    Buckets result;
    result.ends.assign(count + 1, 0);
    each([&](std::uint32_t bucket, std::uint64_t) { ++result.ends[bucket + 1]; });
    for (std::size_t i = 1; i <= count; ++i) result.ends[i] += result.ends[i - 1];
    result.keys.resize(result.ends[count]);
    each([&](std::uint32_t bucket, std::uint64_t key) { result.keys[result.ends[bucket]++] = key; });
    result.ends.pop_back();
    std::size_t begin = 0;
    for (const std::uint32_t end : result.ends) {
        const std::span<std::uint64_t> bucket = std::span(result.keys).subspan(begin, end - begin);
        if (!std::is_sorted(bucket.begin(), bucket.end())) std::sort(bucket.begin(), bucket.end());
        begin = end;
    }
    return result;
}

}  // namespace abut
