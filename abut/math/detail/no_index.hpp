#pragma once

// The index that stands for none.

#include <cstdint>
#include <limits>

namespace abut::detail {

/// Stands in a table of indices where there is none.
inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

}  // namespace abut::detail
