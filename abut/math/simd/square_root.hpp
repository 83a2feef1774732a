#pragma once

// The square root with the same bits on every machine. IEEE 754 demands it correctly rounded, but the C library of
// MinGW-w64 rounds that of a double twice: in the registers of x87, and from there to double. Compilers call it in code
// without optimisation, which the linker can choose for a function of a header that the library uses too. Here it is
// the instruction at every level of optimisation.

#include <cmath>

namespace abut::detail {

inline double square_root(double x) {
#if defined(__MINGW32__) && defined(__SSE2__)
    double result;
    __asm__("sqrtsd {%1, %0|%0, %1}" : "=x"(result) : "x"(x));
    return result;
#else
    return std::sqrt(x);
#endif
}

/// A float's root has the right bits after two roundings too: x87 has more than twice the bits of a float.
inline float square_root(float x) {
    return std::sqrt(x);
}

}  // namespace abut::detail
