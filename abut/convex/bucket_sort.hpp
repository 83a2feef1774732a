#pragma once

// Bucket sort by small whole numbers: linear time if no bucket is large.

#include <abut/math/detail/large_pages.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

struct Buckets {
    /// Of all buckets, one after the other, each sorted.
    std::vector<std::uint64_t, LargePages<std::uint64_t>> keys;
    std::vector<std::uint32_t> ends;  ///< one per bucket: its end in `keys`

    std::span<const std::uint64_t> bucket(std::size_t number) const {
        const std::size_t begin = number == 0 ? 0 : ends[number - 1];
        return std::span(keys).subspan(begin, ends[number] - begin);
    }
};

/// `each` calls its argument with the bucket and the key of every item, of fewer than 2^32. It is called twice.
template <class Each>
Buckets in_buckets(std::size_t count, Each each) {
    // Counts are stored one bucket later, so that filling moves each start to its end.
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

}  // namespace abut::detail
