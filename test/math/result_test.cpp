#include <abut/math/result.hpp>

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Result<std::vector<int>> make(bool well) {
    if (!well) return Problem{ProblemCode::not_finite, "a coordinate isn't a number", 7};
    return std::vector<int>{1, 2, 3};
}

TEST(Result, AValue) {
    auto r = make(true);
    ASSERT_TRUE(r);
    EXPECT_EQ(r->size(), 3u);
    (*r).push_back(4);
    const auto& same = r;
    EXPECT_EQ(*same, (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(same->back(), 4);
}

TEST(Result, AProblem) {
    const auto r = make(false);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.problem().code, ProblemCode::not_finite);
    EXPECT_EQ(r.problem().message, "a coordinate isn't a number");
    EXPECT_EQ(r.problem().index, 7u);
}

TEST(Result, OfWhatOnlyMoves) {
    Result<std::unique_ptr<int>> r(std::make_unique<int>(5));
    ASSERT_TRUE(r);
    const std::unique_ptr<int> taken = *std::move(r);
    EXPECT_EQ(*taken, 5);
}

TEST(Result, OfAStringKeepsValueAndProblemApart) {
    const Result<std::string> value(std::string("fine"));
    const Result<std::string> problem(Problem{});
    EXPECT_TRUE(value);
    EXPECT_FALSE(problem);
}

}  // namespace
}  // namespace abut::test
