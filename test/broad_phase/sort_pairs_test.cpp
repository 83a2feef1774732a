// sort_pairs against std::sort, for few and many pairs, of small and of the largest numbers.

#include "../oracle/random.hpp"
#include "allocations.hpp"
#include <abut/broad_phase/detail/sort_pairs.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

std::vector<detail::ItemPair> some_pairs(std::size_t count, std::uint32_t items, oracle::Random& random) {
    std::vector<detail::ItemPair> result(count);
    for (auto& [i, j] : result) {
        i = random.below(items);
        j = random.chance(0.1) ? items - 1 : random.below(items);
    }
    return result;
}

TEST(SortPairs, LikeStdSort) {
    oracle::Random random(12);
    for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u, 30000u})
        for (const std::uint32_t items : {1u, 2u, 3u, 100u, 1025u, 1u << 16, 3u << 20, ~0u}) {
            std::vector<detail::ItemPair> pairs = some_pairs(count, items, random), expected = pairs;
            std::sort(expected.begin(), expected.end());
            detail::sort_pairs(pairs);
            EXPECT_TRUE(pairs == expected) << count << " pairs of " << items << " items, seed 12";
            detail::sort_pairs(pairs);
            EXPECT_TRUE(pairs == expected) << "sorted before";
        }
}

TEST(SortPairs, AllocatesNothingWhereThereIsRoomForTwice) {
    oracle::Random random(13);
    std::vector<detail::ItemPair> pairs = some_pairs(5000, 400, random);
    pairs.reserve(10000);
    const detail::ItemPair* const place = pairs.data();
    const std::size_t before = allocations();
    detail::sort_pairs(pairs);
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(pairs.data(), place);
}

}  // namespace
}  // namespace abut::test
