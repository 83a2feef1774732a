#include "tool/check/check_file.hpp"
#include "tool/check/config.hpp"
#include "tool/check/report_files.hpp"
#include "tool/check/report_json.hpp"
#include "tool/check/report_text.hpp"
#include "tool/check/scene_list.hpp"
#include "tool/page/report_template.hpp"
#include "tool/shared/version.hpp"
#include "tool/verbs.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// The settings of a scene's abut.toml, below those of the command line.
Result<CheckPlan> plan_for(const std::string& scene, const CheckRequest& request) {
    std::optional<std::filesystem::path> config;
    if (!request.config)
        config = find_config(scene);
    else if (!request.config->empty())
        config = *request.config;
    if (!config) return plan_of(request.settings);
    const Result<Settings> settings = read_config(*config, scene);
    if (!settings) return settings.problem();
    return plan_of(merged(*settings, request.settings));
}

std::vector<CheckedFile> check_all(const std::vector<std::string>& scenes, const CheckRequest& request) {
    const std::size_t threads =
        request.threads > 0 ? request.threads : std::max<std::size_t>(1, std::thread::hardware_concurrency());
    std::vector<CheckedFile> checked;
    for (const std::string& scene : scenes) {
        Result<CheckPlan> plan = plan_for(scene, request);
        if (plan) {
            plan->wants_page = request.page.has_value();
            plan->wants_picture = request.picture.has_value();
        }
        checked.push_back({scene, plan ? check_file(scene, *plan, threads) : Result<FileReport>(plan.problem())});
    }
    return checked;
}

Json json_of_all(const std::vector<CheckedFile>& checked) {
    Json files = Json::array();
    for (const CheckedFile& file : checked)
        files.push_back(file.report ? json_of(*file.report)
                                    : Json{{"file", file.file},
                                           {"version", version()},
                                           {"verdict", "unreadable"},
                                           {"problem", file.report.problem().message}});
    return {{"version", version()}, {"summary", summary_of(checked)}, {"files", std::move(files)}};
}

std::string text_of_all(const std::vector<CheckedFile>& checked) {
    std::string text;
    for (const CheckedFile& file : checked) {
        if (!file.report) continue;
        text += file.report->findings.empty() ? file.file + ": clean\n" : "\n" + text_of(*file.report) + "\n";
    }
    return text + "\n" + summary_of(checked) + "\n";
}

ExitCode exit_code_of(const std::vector<CheckedFile>& checked) {
    ExitCode code = fine;
    for (const CheckedFile& file : checked) {
        if (!file.report) return unusable;
        if (file.report->count(Severity::error) > 0) code = found;
    }
    return code;
}

// The page and the picture are of one scene.
std::optional<Problem> check_documents(const CheckRequest& request, std::size_t scenes) {
    for (const auto& [option, file] : {std::pair("--report", request.page), std::pair("--svg", request.picture)})
        if (file && scenes != 1)
            return Problem{ProblemCode::bad_argument,
                           fmt::format("{} takes one scene, and here are {}", option, scenes)};
    if (request.page && report_template.empty())
        return Problem{ProblemCode::bad_argument, "--report: this abut was built without npm and has no page to write"};
    return std::nullopt;
}

std::optional<Problem> write_documents(const CheckRequest& request, const std::vector<CheckedFile>& checked) {
    if (checked.size() != 1 || !checked[0].report) return std::nullopt;
    std::optional<Problem> problem;
    if (request.page) problem = write_picture(*request.page, checked[0].report->page);
    if (!problem && request.picture) problem = write_picture(*request.picture, checked[0].report->picture);
    return problem;
}

}  // namespace

Result<ExitCode> run_check(const CheckRequest& request) {
    if (const Result<CheckPlan> plan = plan_of(request.settings); !plan) return plan.problem();
    const Result<std::vector<std::string>> scenes = scenes_of(request.scenes);
    if (!scenes) return scenes.problem();
    if (const std::optional<Problem> problem = check_documents(request, scenes->size())) return *problem;
    const std::vector<CheckedFile> checked = check_all(*scenes, request);
    if (std::optional<Problem> problem = write_documents(request, checked)) return *std::move(problem);
    if (request.sarif)
        if (std::optional<Problem> problem = write_picture(*request.sarif, sarif_of(checked)))
            return *std::move(problem);
    if (request.junit)
        if (std::optional<Problem> problem = write_picture(*request.junit, junit_of(checked)))
            return *std::move(problem);

    // One scene on the command line has a report of its own form, also if it can't be read.
    const bool is_single = request.scenes.size() == 1 && *scenes == request.scenes;
    std::string text = request.github ? github_of(checked) : "";
    if (is_single && !checked[0].report) {
        if (!text.empty()) std::fputs(text.c_str(), stdout);
        return checked[0].report.problem();
    }
    for (const CheckedFile& file : checked)
        if (!file.report) std::fputs(one_line(file.report.problem().message).c_str(), stderr);
    if (request.json)
        text += to_text(is_single ? json_of(*checked[0].report) : json_of_all(checked));
    else
        text += is_single ? text_of(*checked[0].report) : text_of_all(checked);
    return print(text, exit_code_of(checked));
}

}  // namespace abut::tool
