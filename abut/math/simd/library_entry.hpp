#pragma once

// SSE code called with AVX state: the entry of a public function that is compiled in the library. For .cpp files.

namespace abut::detail {

/// Clears the upper halves of the vector registers. A public function in a .cpp file calls it first.
///
/// The library is compiled for SSE2. If its caller left the upper halves in use, the first SSE instruction costs 100 to
/// 200 ns on Intel's processors, whatever the function does: a look-up of 2 ns takes 200 ns. The library knows nothing
/// of its caller, so it clears them always: 0.5 ns. Templates that are compiled with the caller use upper_halves.hpp,
/// which costs nothing in callers without AVX.
///
/// The compiler may move a float argument to another register before the clearing. A function that has one passes it on
/// at once, to a function that is not inlined.
[[gnu::always_inline]] inline void enter_library() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX__)
    if (__builtin_cpu_supports("avx")) asm volatile("vzeroupper" ::: "memory");
#endif
}

}  // namespace abut::detail
