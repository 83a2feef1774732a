// Stands for tool/shared/color.cpp, and for the template of the report page: the page takes its data as they are.

#include "tool/page/report_template.hpp"
#include "tool/shared/color.hpp"

namespace abut::tool {

bool has_colors() {
    return false;
}

std::string colored(Tone, std::string_view text) {
    return std::string(text);
}

std::size_t terminal_width() {
    return 80;
}

const std::string_view report_template = "@REPORT@";

}  // namespace abut::tool
