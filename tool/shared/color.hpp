#pragma once

// Colours of text on terminals.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace abut::tool {

enum class Tone : std::uint8_t { heading, error, warning, fine, soft };

/// True if stdout is a terminal that shows colours, and the environment doesn't set NO_COLOR.
bool has_colors();

/// The text in its colour, or unchanged if there are no colours.
std::string colored(Tone tone, std::string_view text);

/// Columns of the terminal of stdout, by itself or by COLUMNS: 40 to 120; 80 elsewhere.
std::size_t terminal_width();

}  // namespace abut::tool
