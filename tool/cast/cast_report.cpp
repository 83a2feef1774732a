#include "tool/cast/cast_report.hpp"

#include "tool/shared/format.hpp"

#include <fmt/format.h>

namespace abut::tool {
namespace {

template <int D>
std::string place(const CastReport<D>& report, const CastHit<D>& hit) {
    const Object<D>& object = report.objects[hit.object];
    std::string text = fmt::format("at {}, normal {}", vector(hit.hit.point), vector(hit.hit.normal));
    if (!object.solid) text += fmt::format(", {} {}", object.part_name, hit.hit.feature.part);
    if (hit.hit.started_inside) text += ", from inside";
    return text;
}

template <int D>
std::string verdict(const CastReport<D>& report) {
    const CastOptions<D>& options = report.options;
    const std::vector<CastHit<D>>& hits = report.result.hits;
    if (options.bounces == 0 && hits.empty())
        return fmt::format("CLEAR: nothing between {} and {}\n", vector(options.from), vector(options.to));
    if (options.bounces == 0)
        return fmt::format(
            "HIT: {} is in the way, {} from {}{}\n", report.objects[hits.front().object].path,
            number(hits.front().travelled), vector(options.from),
            hits.size() > 1 ? ", and " + counted(hits.size() - 1, "thing", "things") + " behind it" : "");
    if (hits.empty()) return "CLEAR: nothing is hit\n";
    const std::string all = "HIT: " + counted(hits.size(), "thing, one", "things, one");
    if (report.result.end)
        return all + " after the other; the last bounce ends at " + vector(*report.result.end) + "\n";
    return all + " after the other; then it leaves the scene\n";
}

}  // namespace

template <int D>
std::string text_report(const CastReport<D>& report, const std::string& scene_name) {
    std::string text = scene_name + "\n\n";
    const std::vector<CastHit<D>>& hits = report.result.hits;
    for (std::size_t i = 0; i < hits.size() && i < max_listed; ++i)
        text += fmt::format("{:4}. {}\n        after {}, {}\n", i + 1, report.objects[hits[i].object].path,
                            number(hits[i].travelled), place(report, hits[i]));
    if (hits.size() > max_listed)
        text += fmt::format("      and {} more (--json lists them all)\n", hits.size() - max_listed);
    if (!hits.empty()) text += "\n";
    for (const std::string& note : report.notes) text += "note: " + note + "\n";
    if (!report.notes.empty()) text += "\n";
    if (!report.left_out.empty()) text += "left out  " + text_of(report.left_out) + "\n";
    text += fmt::format("objects   {}\nseconds   read {:.3f}, build {:.3f}, cast {:.3f}\n", report.objects.size(),
                        report.read_seconds, report.build_seconds, report.cast_seconds);
    return text + "\n" + verdict(report);
}

template <int D>
std::string json_report(const CastReport<D>& report) {
    Json hits = Json::array();
    for (const CastHit<D>& hit : report.result.hits)
        hits.push_back({{"object", report.objects[hit.object].path},
                        {"distance", hit.hit.distance},
                        {"travelled", hit.travelled},
                        {"point", numbers(hit.hit.point)},
                        {"normal", numbers(hit.hit.normal)},
                        {"part", hit.hit.feature.part},
                        {"started_inside", hit.hit.started_inside}});
    Json end = nullptr;
    if (report.result.end) end = numbers(*report.result.end);
    return to_text(
        {{"objects", report.objects.size()},
         {"from", numbers(report.options.from)},
         {"to", numbers(report.options.to)},
         {"bounces", report.options.bounces},
         {"time", report.time},
         {"clear", report.result.hits.empty()},
         {"hits", std::move(hits)},
         {"end", std::move(end)},
         {"left_out", json_of(report.left_out)},
         {"warnings", report.notes},
         {"seconds", {{"read", report.read_seconds}, {"build", report.build_seconds}, {"cast", report.cast_seconds}}}});
}

template std::string text_report(const CastReport<2>& report, const std::string& scene_name);
template std::string text_report(const CastReport<3>& report, const std::string& scene_name);
template std::string json_report(const CastReport<2>& report);
template std::string json_report(const CastReport<3>& report);

}  // namespace abut::tool
