#pragma once

// Text from files, made safe for terminals and reports.

#include <abut/io/level.hpp>
#include <abut/io/scene.hpp>

#include <string>
#include <string_view>

namespace abut::tool {

/// The text with everything escaped that moves the cursor, starts a terminal sequence or reorders text: control
/// characters as "\x1b", bidirectional controls and line separators as "\u202e", bytes that aren't UTF-8 as "\xff".
/// All other characters stay, a backslash too.
std::string printable(std::string_view text);

/// Makes all names and warnings printable, so that reports need no care of their own.
void make_printable(Scene& scene);
void make_printable(Level& level);

}  // namespace abut::tool
