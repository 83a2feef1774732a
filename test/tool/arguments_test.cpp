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

TEST(Arguments, WhatFieldsAreBakedWith) {
    EXPECT_EQ(*parse_cell("0.25"), 0.25f);
    for (const char* bad : {"", "0", "-1", "nan", "inf", "1e99", "0.1m"}) EXPECT_FALSE(parse_cell(bad)) << bad;
    EXPECT_EQ(*parse_cells("2.5"), 2.5f);
    EXPECT_EQ(*parse_cells("1000000"), 1e6f);
    for (const char* bad : {"", "0", "0.99", "nan", "inf", "2e6", "three"}) EXPECT_FALSE(parse_cells(bad)) << bad;
    const Result<FieldSlice> slice = parse_slice("y=-0.5");
    ASSERT_TRUE(slice);
    EXPECT_EQ(slice->axis, 1);
    EXPECT_EQ(slice->at, -0.5f);
    for (const char* bad : {"", "y", "y=", "=1", "w=1", "yy=1", "y=nan", "y=inf", "y= 1", "Y=1"})
        EXPECT_FALSE(parse_slice(bad)) << bad;
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

TEST(Arguments, WhatLevelsAreCheckedWith) {
    const Result<Character> character = parse_character("0.3,1.8");
    ASSERT_TRUE(character);
    EXPECT_EQ(character->radius, 0.3f);
    EXPECT_EQ(character->height, 1.8f);
    EXPECT_TRUE(parse_character("1,2"));
    for (const char* bad : {"", "1", "1,1.9", "0,2", "-1,2", "1,2,3", "nan,2", "1,inf", "1,"})
        EXPECT_FALSE(parse_character(bad)) << bad;

    const Result<GapRange> gap = parse_gap("0.5");
    ASSERT_TRUE(gap);
    EXPECT_EQ(gap->width, 0.5f);
    EXPECT_FLOAT_EQ(gap->min_width, 0.05f);
    EXPECT_EQ(parse_gap("0,2")->min_width, 0);
    for (const char* bad : {"", "0", "-1", "2,1", "1,1", "nan", "1,inf", ",1", "1,2,3"})
        EXPECT_FALSE(parse_gap(bad)) << bad;

    EXPECT_EQ(parse_up("-z")->axis, 2);
    EXPECT_EQ(parse_up("-z")->sign, -1);
    EXPECT_EQ(parse_up("x")->axis, 0);
    EXPECT_LT(parse_up("none")->axis, 0);
    for (const char* bad : {"", "w", "-", "y-", "--y", "up"}) EXPECT_FALSE(parse_up(bad)) << bad;
}

}  // namespace
}  // namespace abut::tool
