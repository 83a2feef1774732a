#pragma once

#include <cstdint>

namespace abut::detail {

/// The answer of a closed form to a question about a pair: `unknown` if only the general algorithms can decide, or if a
/// number isn't finite.
enum class PairAnswer : std::uint8_t { no, yes, unknown };

}  // namespace abut::detail
