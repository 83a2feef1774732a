#pragma once

// Misuse by the programmer: checked in debug builds, replaceable by the user.

namespace abut {

/// Called when an ABUT_ASSERT fails. The library's own prints the expression with its place on stderr and aborts.
/// A program replaces it as it would replace `operator new`: by defining a function of this name and signature.
/// If that one returns, the library goes on with the answer documented for release builds.
void assert_failed(const char* expression, const char* file, int line);

}  // namespace abut

#if defined(NDEBUG) && !defined(ABUT_ENABLE_ASSERTS)
#define ABUT_ASSERT(condition) static_cast<void>(0)
#else
#define ABUT_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::abut::assert_failed(#condition, __FILE__, __LINE__))
#endif
