#pragma once

// The extensions of compilers that the library uses outside its vector code. For .cpp files.

#include <hwy/cache_control.h>

/// After the parameters of a lambda function: inlined wherever it is called. C++20 has no place there for an attribute
/// of the function.
#if defined(__GNUC__)
#define ABUT_INLINE_LAMBDA __attribute__((always_inline))
#else
#define ABUT_INLINE_LAMBDA
#endif

namespace abut::detail {

/// Begins to load the cache line of an address that is needed soon.
inline void prefetch(const void* address) {
    hwy::Prefetch(static_cast<const char*>(address));
}

}  // namespace abut::detail
