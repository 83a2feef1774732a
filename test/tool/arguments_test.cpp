#include "tool/arguments.hpp"

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

TEST(Arguments, Lengths) {
    EXPECT_EQ(*parse_length("0.25"), 0.25f);
    EXPECT_EQ(*parse_length("0"), 0.0f);
    EXPECT_EQ(*parse_length("1e-3"), 1e-3f);
    for (const char* bad : {"", "-1", "nan", "inf", "1e99", "0.1m", "0,1", " 1", "one"})
        EXPECT_FALSE(parse_length(bad)) << bad;
    EXPECT_EQ(parse_length("-1").problem().message, "'-1' is not a number of at least 0");
}

TEST(Arguments, Frames) {
    EXPECT_EQ(*parse_frames("1"), 1u);
    EXPECT_EQ(*parse_frames("1000000"), 1000000u);
    for (const char* bad : {"", "0", "-3", "1.5", "1000001", "99999999999999999999", "ten"})
        EXPECT_FALSE(parse_frames(bad)) << bad;
}

TEST(Arguments, Times) {
    EXPECT_EQ(*parse_time("3.562"), 3.562);
    EXPECT_EQ(*parse_time("-1"), -1.0);
    for (const char* bad : {"", "nan", "inf", "1e999", "3s", "1:30", " 1"}) EXPECT_FALSE(parse_time(bad)) << bad;
}

TEST(Arguments, Pairs) {
    const Result<PairPattern> pair = parse_pair("Player*:*/Walls/*");
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->a, "Player*");
    EXPECT_EQ(pair->b, "*/Walls/*");
    for (const char* bad : {"", ":", "Player", "Player:", ":Wall", "a:b:c"}) EXPECT_FALSE(parse_pair(bad)) << bad;
}

}  // namespace
}  // namespace abut::tool
