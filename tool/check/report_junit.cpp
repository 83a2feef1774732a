#include "tool/check/report_files.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace abut::tool {
namespace {

// XML has no control characters, whatever a name holds.
std::string xml_text(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\n'; }, '?');
    return text;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name).set_value(xml_text(value).c_str());
}

// Returns whether the case fails.
bool add_case(pugi::xml_node suite, const FileReport& report, Kind kind) {
    pugi::xml_node test = suite.append_child("testcase");
    set(test, "classname", report.file);
    set(test, "name", name_of(kind));
    std::string errors, warnings;
    std::size_t count = 0;
    for (const Finding& finding : report.findings) {
        if (info(finding.rule).kind != kind) continue;
        const bool is_error = finding.severity == Severity::error;
        count += is_error ? 1 : 0;
        (is_error ? errors : warnings) += fmt::format("{} {}\n", info(finding.rule).code, sentence(finding));
    }
    if (count > 0) {
        pugi::xml_node failure = test.append_child("failure");
        set(failure, "message", counted(count, "finding", "findings"));
        failure.text().set(xml_text(errors).c_str());
    }
    if (!warnings.empty()) test.append_child("system-out").text().set(xml_text(warnings).c_str());
    return count > 0;
}

}  // namespace

std::string junit_of(const std::vector<CheckedFile>& files) {
    pugi::xml_document document;
    pugi::xml_node root = document.append_child("testsuites");
    set(root, "name", "abut check");
    for (const CheckedFile& file : files) {
        pugi::xml_node suite = root.append_child("testsuite");
        set(suite, "name", file.file);
        if (!file.report) {
            set(suite, "tests", "1");
            set(suite, "failures", "0");
            set(suite, "errors", "1");
            pugi::xml_node test = suite.append_child("testcase");
            set(test, "classname", file.file);
            set(test, "name", "read");
            set(test.append_child("error"), "message", file.report.problem().message);
            continue;
        }
        std::size_t failures = 0;
        for (std::size_t kind = 0; kind < count_kinds; ++kind)
            failures += add_case(suite, *file.report, static_cast<Kind>(kind)) ? 1 : 0;
        set(suite, "tests", std::to_string(count_kinds));
        set(suite, "failures", std::to_string(failures));
        set(suite, "errors", "0");
    }
    std::ostringstream text;
    document.save(text, "  ");
    return text.str();
}

}  // namespace abut::tool
