// A program's own assert_failed replaces the library's. Only this file asserts in release builds too.
#ifndef ABUT_ENABLE_ASSERTS
#define ABUT_ENABLE_ASSERTS
#endif
#include <abut/math/assert.hpp>

#include <string>

#include <gtest/gtest.h>

namespace {
std::string failed;
int failed_line = 0;
}  // namespace

void abut::assert_failed(const char* expression, const char* file, int line) {
    failed = std::string(file) + ": " + expression;
    failed_line = line;
}

namespace abut::test {
namespace {

TEST(Assert, TellsWhatAndWhereAndGoesOn) {
    failed.clear();
    int evaluated = 0;
    ABUT_ASSERT(++evaluated == 1);
    EXPECT_EQ(failed, "");
    ABUT_ASSERT(++evaluated == 1);
    const int here = __LINE__ - 1;
    EXPECT_EQ(failed, std::string(__FILE__) + ": ++evaluated == 1");
    EXPECT_EQ(failed_line, here);
    EXPECT_EQ(evaluated, 2);
}

}  // namespace
}  // namespace abut::test
