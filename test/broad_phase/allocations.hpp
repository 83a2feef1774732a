#pragma once

#include <cstddef>

namespace abut::test {

/// How often this program has allocated so far.
std::size_t allocations();

}  // namespace abut::test
