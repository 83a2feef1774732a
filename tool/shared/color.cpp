#include "tool/shared/color.hpp"

#include <algorithm>
#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace abut::tool {
namespace {

constexpr std::size_t min_width = 40, max_width = 120, default_width = 80;

std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view() : value;
}

const char* code_of(Tone tone) {
    switch (tone) {
        case Tone::error:
            return "1;31";
        case Tone::warning:
            return "33";
        case Tone::fine:
            return "1;32";
        case Tone::soft:
            return "2";
        case Tone::heading:
            break;
    }
    return "1";
}

}  // namespace

bool has_colors() {
    const std::string_view terminal = environment("TERM");
    return isatty(STDOUT_FILENO) != 0 && environment("NO_COLOR").empty() && !terminal.empty() && terminal != "dumb";
}

std::string colored(Tone tone, std::string_view text) {
    if (!has_colors()) return std::string(text);
    return std::string("\x1b[") + code_of(tone) + "m" + std::string(text) + "\x1b[0m";
}

std::size_t terminal_width() {
    winsize size{};
    std::size_t width = default_width;
    if (const int columns = std::atoi(std::string(environment("COLUMNS")).c_str()); columns > 0)
        width = static_cast<std::size_t>(columns);
    else if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        width = size.ws_col;
    return std::clamp(width, min_width, max_width);
}

}  // namespace abut::tool
