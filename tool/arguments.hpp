#pragma once

// Arguments as they are typed, and what they mean.

#include "check.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <string>

namespace abut::tool {

/// A finite length, not below zero.
Result<float> parse_length(const std::string& text);

/// A number of frames, 1 to a million.
Result<std::size_t> parse_frames(const std::string& text);

/// Two patterns with one ':' between them.
Result<PairPattern> parse_pair(const std::string& text);

}  // namespace abut::tool
