#include <abut/io/file/glob.hpp>

#include <string>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Glob, MatchesWholeNames) {
    EXPECT_TRUE(detail::glob_matches("Door", "Door"));
    EXPECT_FALSE(detail::glob_matches("Door", "Doors"));
    EXPECT_FALSE(detail::glob_matches("Door", "A Door"));
    EXPECT_FALSE(detail::glob_matches("Door", "door"));
    EXPECT_FALSE(detail::glob_matches("", "Door"));
    EXPECT_TRUE(detail::glob_matches("", ""));
}

TEST(Glob, StarsStandForAnything) {
    EXPECT_TRUE(detail::glob_matches("*", ""));
    EXPECT_TRUE(detail::glob_matches("*", "Level/Door"));
    EXPECT_TRUE(detail::glob_matches("Player*", "Player"));
    EXPECT_TRUE(detail::glob_matches("Player*", "Player/Left Arm"));
    EXPECT_TRUE(detail::glob_matches("*/Wall*", "Level/Walls/North"));
    EXPECT_TRUE(detail::glob_matches("*a*b*", "xxaxxbxx"));
    EXPECT_FALSE(detail::glob_matches("*a*b*", "xxbxxaxx"));
    EXPECT_TRUE(detail::glob_matches("a**c", "abc"));
}

TEST(Glob, QuestionMarksStandForOneCharacter) {
    EXPECT_TRUE(detail::glob_matches("Crate.?01", "Crate.001"));
    EXPECT_TRUE(detail::glob_matches("a?b", "a/b"));
    EXPECT_FALSE(detail::glob_matches("a?b", "ab"));
}

TEST(Glob, EarlierStarsBacktrack) {
    EXPECT_TRUE(detail::glob_matches("*ab*ab", "abab"));
    EXPECT_TRUE(detail::glob_matches("*aab", "aaab"));
    EXPECT_FALSE(detail::glob_matches("*aab", "aaba"));
}

TEST(Glob, LongNamesAreNoTrouble) {
    const std::string name(10000, 'a');
    EXPECT_FALSE(detail::glob_matches("*a*a*a*a*a*a*a*b", name));
}

}  // namespace
}  // namespace abut
