// Arrays of all sizes, at the alignments that they request.

#include <abut/math/detail/large_pages.hpp>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

struct alignas(64) Line {
    std::uint64_t number = 0;
};

TEST(LargePages, HoldWhatIsWrittenAndAreAligned) {
    constexpr std::size_t least = detail::min_large_array / sizeof(Line);
    for (const std::size_t count : {std::size_t{1}, least - 1, least, 3 * least + 5}) {
        std::vector<Line, detail::LargePages<Line>> lines(count);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % alignof(Line), 0u);
        if (count >= least) {
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % detail::large_page, 0u);
        }
        for (std::size_t i = 0; i < count; ++i) lines[i].number = i;
        lines.push_back({count});
        lines.shrink_to_fit();
        for (std::size_t i = 0; i <= count; ++i) ASSERT_EQ(lines[i].number, i);
    }
}

}  // namespace
}  // namespace abut
