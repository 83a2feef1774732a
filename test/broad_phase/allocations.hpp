#pragma once

#include <cstddef>

namespace abut::test {

/// How often this program has allocated so far.
std::size_t allocations();
/// Held now by operator new, as the C library counts them; without what is aligned beyond the usual.
std::size_t allocated_bytes();

}  // namespace abut::test
