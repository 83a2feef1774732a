#pragma once

// Assertions for misuse by the programmer: checked in debug builds, replaceable by the user.

namespace abut {

/// Called if an ABUT_ASSERT fails. The default prints the expression and its location to stderr and aborts. A program
/// replaces it by defining a function with this signature, as for `operator new`. If it returns, the library continues
/// with the behaviour documented for release builds.
void assert_failed(const char* expression, const char* file, int line);

}  // namespace abut

#if defined(NDEBUG) && !defined(ABUT_ENABLE_ASSERTS)
#define ABUT_ASSERT(condition) static_cast<void>(0)
#else
#define ABUT_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::abut::assert_failed(#condition, __FILE__, __LINE__))
#endif
