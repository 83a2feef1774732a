#include "tool/check/check_file.hpp"
#include "tool/check/config.hpp"
#include "tool/verbs.hpp"
#include <abut/io/file/read_file.hpp>
#include <abut/io/write_file.hpp>

#include <algorithm>
#include <set>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

constexpr const char* preface =
    "# Options of `abut check` for the levels here and in the folders below; `abut check --help` says what they do.\n"
    "# Those above the first [level.\"NAME\"] are for all levels, the others for files whose name matches.\n\n";

// A path as a pattern that matches it: characters with a meaning become `?`.
std::string pattern_of(const std::string& path) {
    std::string pattern = path;
    std::replace_if(
        pattern.begin(), pattern.end(),
        [](char c) { return c == ':' || c == '*' || static_cast<unsigned char>(c) < ' '; }, '?');
    return pattern;
}

// One pattern for each set of objects, with the code of what is found.
std::vector<SettingText> ignores_of(const FileReport& report) {
    std::set<std::string> patterns;
    for (const Finding& finding : report.findings) {
        std::string pattern = std::string(info(finding.rule).code) + " " + pattern_of(finding.objects.front().path);
        if (finding.objects.size() > 1) pattern += ":" + pattern_of(finding.objects.back().path);
        patterns.insert(std::move(pattern));
    }
    std::vector<SettingText> result;
    for (const std::string& pattern : patterns) result.push_back({pattern, {}});
    return result;
}

}  // namespace

Result<ExitCode> run_init(const InitRequest& request) {
    const std::filesystem::path scene(request.scene), config = scene.parent_path() / config_name;
    const std::string name = scene.filename().string();
    std::string text = preface;
    Settings above;
    if (const std::optional<std::filesystem::path> found = find_config(scene)) {
        const Result<Settings> settings = read_config(*found, scene);
        if (!settings) return settings.problem();
        above = *settings;
        if (*found == config) {
            const Result<std::vector<std::byte>> bytes = detail::read_file(config);
            if (!bytes) return Problem{bytes.problem().code, config.string() + ": " + bytes.problem().message};
            text.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
            text += text.empty() || text.back() == '\n' ? "\n" : "\n\n";
        }
    }
    const Result<CheckPlan> plan = plan_of(merged(above, request.settings));
    if (!plan) return plan.problem();
    Result<FileReport> report =
        check_file(request.scene, *plan, std::max<std::size_t>(1, std::thread::hardware_concurrency()));
    if (!report) return report.problem();
    Settings section = request.settings;
    const std::vector<SettingText> ignored = ignores_of(*report);
    if (!ignored.empty()) {
        std::vector<SettingText>& all = section["ignore"];
        all.insert(all.end(), ignored.begin(), ignored.end());
    }
    text += config_section(name, section);
    // An older section for this level would be there twice.
    if (const Result<Settings> parsed = settings_of_config(text, config, name); !parsed)
        return Problem{ProblemCode::bad_argument,
                       fmt::format("{}: there is a section for {} already: remove it first", config.string(), name)};
    if (std::optional<Problem> problem = write_file(config, text))
        return Problem{problem->code, config.string() + ": " + problem->message};
    return print(fmt::format("{}: ignores {} of {}\n", config.string(),
                             counted(report->findings.size(), "finding", "findings"), request.scene),
                 fine);
}

}  // namespace abut::tool
