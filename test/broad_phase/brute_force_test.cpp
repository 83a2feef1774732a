// The reference of the other broad phases, against simple loops.

#include "dimensions.hpp"
#include "scenes.hpp"
#include <abut/broad_phase/brute_force.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class T>
class BruteForceIn : public testing::Test {};
TYPED_TEST_SUITE(BruteForceIn, Both);

TYPED_TEST(BruteForceIn, ReportsWhatPlainLoopsReportInTheirOrder) {
    constexpr int D = TypeParam::value;
    using Items = std::vector<std::uint32_t>;
    for (const Scene scene : all_scenes)
        for (std::uint32_t count = 0; count < 200; count += count < 70 ? 1 : 43) {
            SCOPED_TRACE(testing::Message() << "scene " << static_cast<int>(scene) << " of " << count << " seed 16");
            oracle::Random random(16);
            const auto boxes = make_scene<D>(scene, count, random);
            BruteForce<D> phase;
            // The array was larger before; its remains behind the boxes must not be read.
            phase.build(std::vector<Aabb<D>>(230, {Vec<D>(-100), Vec<D>(100)}));
            phase.build(boxes);
            std::vector<detail::ItemPair> expected, pairs, other_expected, other_pairs;
            for (std::uint32_t i = 0; i < count; ++i)
                for (std::uint32_t j = 0; j < count; ++j) {
                    if (!overlaps(boxes[i], boxes[j])) continue;
                    if (i < j) expected.emplace_back(i, j);
                    other_expected.emplace_back(i, j);
                }
            phase.each_pair([&](std::uint32_t i, std::uint32_t j) { pairs.emplace_back(i, j); });
            phase.each_overlapping_pair(phase,
                                        [&](std::uint32_t i, std::uint32_t j) { other_pairs.emplace_back(i, j); });
            EXPECT_EQ(pairs, expected);
            EXPECT_EQ(other_pairs, other_expected);
            for (int repeat = 0; repeat < 5; ++repeat) {
                const Aabb<D> query = repeat == 0 ? endless_box<D>(random) : some_box<D>(random, 12, 9);
                Items items, expected_items;
                for (std::uint32_t i = 0; i < count; ++i)
                    if (overlaps(boxes[i], query)) expected_items.push_back(i);
                phase.each_overlapping(query, [&](std::uint32_t i) { items.push_back(i); });
                EXPECT_EQ(items, expected_items);
            }
        }
}

}  // namespace
}  // namespace abut::test
