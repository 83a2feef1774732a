#include <abut/io/glob.hpp>

#include <string>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Glob, MatchesWholeNames) {
    EXPECT_TRUE(matches("Door", "Door"));
    EXPECT_FALSE(matches("Door", "Doors"));
    EXPECT_FALSE(matches("Door", "A Door"));
    EXPECT_FALSE(matches("Door", "door"));
    EXPECT_FALSE(matches("", "Door"));
    EXPECT_TRUE(matches("", ""));
}

TEST(Glob, StarsStandForAnything) {
    EXPECT_TRUE(matches("*", ""));
    EXPECT_TRUE(matches("*", "Level/Door"));
    EXPECT_TRUE(matches("Player*", "Player"));
    EXPECT_TRUE(matches("Player*", "Player/Left Arm"));
    EXPECT_TRUE(matches("*/Wall*", "Level/Walls/North"));
    EXPECT_TRUE(matches("*a*b*", "xxaxxbxx"));
    EXPECT_FALSE(matches("*a*b*", "xxbxxaxx"));
    EXPECT_TRUE(matches("a**c", "abc"));
}

TEST(Glob, QuestionMarksStandForOneCharacter) {
    EXPECT_TRUE(matches("Crate.?01", "Crate.001"));
    EXPECT_TRUE(matches("a?b", "a/b"));
    EXPECT_FALSE(matches("a?b", "ab"));
}

TEST(Glob, EarlierStarsGiveWay) {
    EXPECT_TRUE(matches("*ab*ab", "abab"));
    EXPECT_TRUE(matches("*aab", "aaab"));
    EXPECT_FALSE(matches("*aab", "aaba"));
}

TEST(Glob, LongNamesAreNoTrouble) {
    const std::string name(10000, 'a');
    EXPECT_FALSE(matches("*a*a*a*a*a*a*a*b", name));
}

}  // namespace
}  // namespace abut
