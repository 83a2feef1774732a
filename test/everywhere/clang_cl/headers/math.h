// Microsoft's C library has these as functions for C++, MinGW-w64's as macros.
#pragma once
#include_next <math.h>
#undef fpclassify
#undef isfinite
#undef isgreater
#undef isgreaterequal
#undef isinf
#undef isless
#undef islessequal
#undef islessgreater
#undef isnan
#undef isnormal
#undef isunordered
#undef signbit
// clang-format off
extern "C++" {
#define FOR_ONE(name) template <class T> constexpr bool name(T x) { return __builtin_##name(x); }
FOR_ONE(isfinite) FOR_ONE(isinf) FOR_ONE(isnan) FOR_ONE(isnormal) FOR_ONE(signbit)
#undef FOR_ONE
#define FOR_TWO(name) template <class T> constexpr bool name(T x, T y) { return __builtin_##name(x, y); }
FOR_TWO(isgreater) FOR_TWO(isgreaterequal) FOR_TWO(isless) FOR_TWO(islessequal) FOR_TWO(islessgreater) FOR_TWO(isunordered)
#undef FOR_TWO
template <class T> int fpclassify(T x) { return __builtin_fpclassify(0, 1, 2, 3, 4, x); }
}
// clang-format on
