// What the promise of equal bits needs of the compiler: IEEE 754 arithmetic, each operation rounded to its own type.

#include <cfloat>
#include <limits>

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559,
              "abut needs IEEE 754 numbers");
static_assert(FLT_EVAL_METHOD == 0, "abut needs numbers without excess precision; on i386: -msse2 -mfpmath=sse");
#ifdef __FAST_MATH__
#error "abut needs exact arithmetic: build it without -ffast-math"
#endif
