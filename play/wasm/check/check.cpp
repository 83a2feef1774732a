// `abut check` for the page: files go in, the data of the report page comes out.

#include "page_files.hpp"
#include "tool/check/check_file.hpp"
#include "tool/check/report_text.hpp"
#include "tool/check/settings.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace {

using namespace abut;
using namespace abut::tool;
using Data = nlohmann::json;

// Each setting is a name of an option with the list of its values, all of them text.
std::optional<Settings> settings_in(const Data& request) {
    Settings settings;
    if (!request.contains("settings")) return settings;
    if (!request["settings"].is_object()) return std::nullopt;
    for (const auto& [name, values] : request["settings"].items()) {
        if (!values.is_array()) return std::nullopt;
        for (const Data& value : values) {
            if (!value.is_string()) return std::nullopt;
            settings[name].push_back({value.get<std::string>(), name});
        }
    }
    return settings;
}

Result<std::string> checked(std::string_view text) {
    const Data request = Data::parse(text, nullptr, false);
    const bool is_request = request.is_object() && request.contains("file") && request["file"].is_string();
    const std::optional<Settings> settings = is_request ? settings_in(request) : std::nullopt;
    if (!settings) return Problem{ProblemCode::bad_argument, "The page sent a wrong request"};
    Result<CheckPlan> plan = plan_of(*settings);
    if (!plan) return plan.problem();
    plan->wants_page = true;
    Result<FileReport> report = check_file(request["file"].get<std::string>(), *plan, 1);
    if (!report) return report.problem();
    return std::move(report->page);
}

std::string result;

}  // namespace

extern "C" {

/// Stores a copy of a file under its name, which has no folder.
[[clang::export_name("abut_check_add_file")]] void abut_check_add_file(const char* name, std::size_t name_size,
                                                                       const std::byte* bytes, std::size_t size) {
    play::add_file({name, name_size}, {bytes, size});
}

/// Checks one of the files: `{"file": name, "settings": {option: [value, ...]}}`. Returns whether that was possible.
/// The result is then the data of the report page, as JSON, and else a sentence.
[[clang::export_name("abut_check_run")]] bool abut_check_run(const char* request, std::size_t size) {
    Result<std::string> page = checked({request, size});
    result = page ? *std::move(page) : page.problem().message;
    return static_cast<bool>(page);
}

[[clang::export_name("abut_check_result")]] const char* abut_check_result() {
    return result.data();
}
[[clang::export_name("abut_check_result_size")]] std::size_t abut_check_result_size() {
    return result.size();
}
}
