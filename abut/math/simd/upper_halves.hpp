#pragma once

// AVX to SSE transitions at the boundary between a caller's AVX code and the library.

namespace abut::detail {

/// Clears the upper halves of the vector registers if the caller is compiled for AVX; otherwise does nothing. The
/// library is compiled for SSE2 with run-time dispatch. Intel's processors preserve dirty upper halves through each SSE
/// instruction, which then depends on the last write of the register: a distance query of 29 ns takes 188 ns. Clearing
/// takes one to four cycles. Compilers insert it only where they see the use, not after a call that left the registers
/// dirty.
[[gnu::always_inline]] inline void clear_upper_halves() {
#if defined(__AVX__) && defined(__GNUC__)
    __builtin_ia32_vzeroupper();
#endif
}

}  // namespace abut::detail
