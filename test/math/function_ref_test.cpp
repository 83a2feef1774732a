#include <abut/math/function_ref.hpp>

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

int call(FunctionRef<int(int)> f, int x) {
    return f(x);
}
int doubled(int x) {
    return 2 * x;
}

struct Counter {
    int calls = 0;
    int operator()(int) { return ++calls; }
};

TEST(FunctionRef, RefersToAnythingCallable) {
    EXPECT_EQ(call([](int x) { return x + 1; }, 4), 5);
    EXPECT_EQ(call(&doubled, 4), 8);
    int sum = 0;
    const auto add = [&sum](int x) { return sum += x; };
    call(add, 3);
    call(add, 4);
    EXPECT_EQ(sum, 7);
}

TEST(FunctionRef, RefersAndDoesNotCopy) {
    Counter counter;
    call(counter, 0);
    const FunctionRef<int(int)> f(counter), copy = f;
    f(0);
    copy(0);
    EXPECT_EQ(counter.calls, 3);
}

TEST(FunctionRef, HandsArgumentsOn) {
    std::string word = "a";
    const auto append = [](std::string& s) -> std::string& { return s += "b"; };
    const FunctionRef<std::string&(std::string&)> f(append);
    EXPECT_EQ(&f(word), &word);
    EXPECT_EQ(word, "ab");
    const auto take = [](std::unique_ptr<int> p) { return *p; };
    const FunctionRef<int(std::unique_ptr<int>)> g(take);
    EXPECT_EQ(g(std::make_unique<int>(9)), 9);
}

static_assert(!std::is_constructible_v<FunctionRef<int(int)>, int (&)(std::string)>);
static_assert(sizeof(FunctionRef<void()>) == 2 * sizeof(void*));

}  // namespace
}  // namespace abut::test
