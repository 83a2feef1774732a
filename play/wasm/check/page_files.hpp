#pragma once

// The files that a page has been given. There are no folders: a name counts from behind its last slash.

#include <cstddef>
#include <span>
#include <string_view>

namespace abut::play {

void add_file(std::string_view name, std::span<const std::byte> bytes);

}  // namespace abut::play
