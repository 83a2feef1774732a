#include <abut/math/assert.hpp>

#include <cstdio>
#include <cstdlib>

namespace abut {

// Alone in its file, and weak: a program's own definition wins, even if all objects are linked.
[[gnu::weak]] void assert_failed(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: abut: assertion failed: %s\n", file, line, expression);
    std::abort();
}

}  // namespace abut
