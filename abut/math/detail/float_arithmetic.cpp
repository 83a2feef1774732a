// What the promise of equal bits needs of the compiler: IEEE 754 arithmetic, without rules that are only nearly true.
// vec.hpp checks that each operation is rounded to its own type, in the users' code too.

#include <limits>

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559,
              "abut needs IEEE 754 numbers");
#ifdef __FAST_MATH__
#error "abut needs exact arithmetic: build it without -ffast-math"
#endif
