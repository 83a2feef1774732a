#pragma once

#include <cstddef>

namespace abut::test {

/// The number of allocations of this program so far.
std::size_t allocations();
/// False in a program whose operator new is that of ThreadSanitizer.
bool counts_allocations();
/// The bytes allocated by operator new at present, as the C library counts them, without over-aligned blocks.
std::size_t allocated_bytes();

}  // namespace abut::test
