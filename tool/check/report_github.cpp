#include "tool/check/report_files.hpp"

#include <string_view>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Escapes these characters, and those that end a line.
std::string escaped(const std::string& text, std::string_view special) {
    std::string result;
    for (const char c : text) {
        const bool is_special = static_cast<unsigned char>(c) < ' ' || special.find(c) != std::string_view::npos;
        result += is_special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
    }
    return result;
}

std::string annotation(Severity severity, const std::string& file, const std::string& title, const std::string& text) {
    return fmt::format("::{} file={},title={}::{}\n", name_of(severity), escaped(file, "%:,"), escaped(title, "%:,"),
                       escaped(text, "%"));
}

}  // namespace

std::string github_of(const std::vector<CheckedFile>& files) {
    std::string text;
    for (const CheckedFile& file : files) {
        if (!file.report) {
            text += annotation(Severity::error, file.file, "unreadable", file.report.problem().message);
            continue;
        }
        for (const Finding& finding : file.report->findings)
            text +=
                annotation(finding.severity, file.file,
                           fmt::format("{} {}", info(finding.rule).code, info(finding.rule).name), sentence(finding));
    }
    return text;
}

}  // namespace abut::tool
