#pragma once

// The upper halves of the vector registers, at the border between a caller's AVX code and the library.

namespace abut::detail {

/// Clears them where the caller is compiled for AVX, and is nothing elsewhere. The library is compiled for SSE2 and
/// chooses wider code when it runs. Intel's processors keep upper halves that were in use through each SSE
/// instruction, which then waits for the last one that wrote the register: a distance of 29 ns takes 188 ns. Clearing
/// takes one to four cycles. Compilers do it themselves where they know of the use, but not always: not after a call
/// that left them in use.
[[gnu::always_inline]] inline void clear_upper_halves() {
#if defined(__AVX__) && defined(__GNUC__)
    __builtin_ia32_vzeroupper();
#endif
}

}  // namespace abut::detail
