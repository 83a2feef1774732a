#include "tool/shared/format.hpp"
#include "tool/verbs.hpp"
#include <abut/io/file/read_file.hpp>
#include <abut/world/replay.hpp>

#include <string>
#include <vector>

#include <fmt/format.h>

namespace abut::tool {
namespace {

std::string text_of(const std::string& file, const ReplayReport& report) {
    std::string text = fmt::format("{}\n\n", file);
    for (const ReplayDifference& each : report.differences) {
        text += fmt::format("entry {}, frame {}: {} differs in {}\n  recorded  {}\n  now       {}\n", each.entry,
                            each.frame, each.question, each.field, each.recorded, each.now);
        if (!each.code.empty()) text += "\n" + each.code;
        text += "\n";
    }
    if (report.differences.size() < report.difference_count)
        text += fmt::format("and {} more (--max lists more)\n\n", report.difference_count - report.differences.size());
    text += fmt::format("dimension   {}\nframes      {}\nentries     {}\nquestions   {}\ndifferences {}\n",
                        report.dimension, report.frames, report.entries, report.questions, report.difference_count);
    if (report.is_cut) text += fmt::format("note: the file ends within entry {}\n", report.entries);
    return text;
}

std::string json_of(const ReplayReport& report) {
    Json list = Json::array();
    for (const ReplayDifference& each : report.differences)
        list.push_back({{"entry", each.entry},
                        {"frame", each.frame},
                        {"question", each.question},
                        {"field", each.field},
                        {"recorded", each.recorded},
                        {"now", each.now},
                        {"code", each.code}});
    return to_text({{"dimension", report.dimension},
                    {"frames", report.frames},
                    {"entries", report.entries},
                    {"questions", report.questions},
                    {"difference_count", report.difference_count},
                    {"differences", std::move(list)},
                    {"cut", report.is_cut}});
}

}  // namespace

Result<ExitCode> run_replay(const ReplayRequest& request) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(request.file);
    if (!bytes) return Problem{bytes.problem().code, request.file + ": " + bytes.problem().message};
    const Result<ReplayReport> report = replay(*bytes, {.max_differences = request.max_differences});
    if (!report) return Problem{report.problem().code, request.file + ": " + report.problem().message};
    return print(request.json ? json_of(*report) : text_of(request.file, *report),
                 report->difference_count > 0 ? found : fine);
}

}  // namespace abut::tool
