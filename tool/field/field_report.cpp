#include "tool/field/field_report.hpp"

#include "tool/shared/format.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace abut::tool {
namespace {

constexpr double max_uncertain_fraction = 1e-3;

// "12 %"; a small nonzero fraction is "less than 0.01 %".
std::string percent(std::size_t part, std::size_t whole) {
    const double share = whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
    if (part > 0 && share < 0.01) return "less than 0.01 %";
    return fmt::format("{:.3g} %", share);
}

template <int D>
constexpr const char* surface_name = D == 2 ? "level" : "mesh";

std::string surface_line(const FieldOutcome<3>& outcome) {
    const FieldReport& report = outcome.report;
    std::string text = counted(outcome.parts, "triangle", "triangles") + ": ";
    text += report.closed ? "closed" : "not closed";
    if (report.gaps > 0) text += ", " + counted(report.gaps, "edge", "edges") + " on the boundary";
    if (report.rewound > 0) text += ", " + counted(report.rewound, "triangle", "triangles") + " reversed";
    return text;
}
std::string surface_line(const FieldOutcome<2>& outcome) {
    return counted(outcome.parts, "object", "objects");
}

std::string signs_line(const FieldReport& report) {
    if (report.closed) return "all certain";
    if (report.uncertain == 0) return "none uncertain";
    return fmt::format("{} of the samples uncertain: the winding number there is near 0.5, the threshold of inside",
                       percent(report.uncertain, report.samples));
}

std::string error_line(const FieldError& error, double cell) {
    if (error.points == 0) return "no point";
    return fmt::format("{:.3f} cells root mean square, {:.3g} at most; {} on the wrong side; {}",
                       error.root_mean_square / cell, error.largest / cell, percent(error.wrong_side, error.points),
                       counted(error.points, "point", "points"));
}

Json json_of(const FieldError& error) {
    return {{"points", error.points},
            {"rms", error.root_mean_square},
            {"max", error.largest},
            {"wrong_side", error.wrong_side}};
}

}  // namespace

bool has_uncertain_signs(const FieldReport& report) {
    return report.gaps > 0 ||
           static_cast<double>(report.uncertain) > max_uncertain_fraction * static_cast<double>(report.samples);
}

std::string megabytes(std::size_t bytes) {
    const double count = static_cast<double>(bytes);
    return count < 1e5 ? fmt::format("{:.3g} kB", 1e-3 * count) : fmt::format("{:.3g} MB", 1e-6 * count);
}

template <int D>
std::string described(const Field<D>& field) {
    const detail::FieldData<D>& data = field.data();
    std::string cells;
    for (int i = 0; i < D; ++i) cells += (i == 0 ? "" : " x ") + std::to_string(data.cells[i]);
    std::string text = fmt::format("volume      {} cells of {}, from {} on\n", cells,
                                   number(static_cast<double>(field.cell())), vector(field.volume().min));
    const std::string storage =
        data.store == FieldStore::dense
            ? "dense"
            : fmt::format("{} of {} blocks have bricks",
                          data.brick.size() - static_cast<std::size_t>(
                                                  std::count(data.brick.begin(), data.brick.end(), detail::no_brick)),
                          data.brick.size());
    text += fmt::format("samples     {} of {} bits, {}{}{}: {}\n", data.samples(), data.steps.empty() ? 32 : 16,
                        storage, data.lookup == FieldLookup::gradient ? ", with gradients" : "",
                        data.closest.empty() ? "" : ", with closest points", megabytes(field.bytes()));
    return text;
}
template std::string described(const Field<2>&);
template std::string described(const Field<3>&);

template <int D>
Json json_of(const Field<D>& field) {
    const detail::FieldData<D>& data = field.data();
    Json cells = Json::array();
    for (int i = 0; i < D; ++i) cells.push_back(data.cells[i]);
    const Aabb<D> volume = field.volume();
    return {{"dimension", D},
            {"cells", std::move(cells)},
            {"cell", field.cell()},
            {"min", numbers(volume.min)},
            {"max", numbers(volume.max)},
            {"store", data.store == FieldStore::dense ? "dense" : "sparse"},
            {"lookup", data.lookup == FieldLookup::linear ? "linear" : "gradient"},
            {"bits", data.steps.empty() ? 32 : 16},
            {"closest_points", !data.closest.empty()},
            {"samples", data.samples()},
            {"bytes", field.bytes()}};
}
template Json json_of(const Field<2>&);
template Json json_of(const Field<3>&);

template <int D>
std::string text_report(const FieldRequest& request, const FieldOutcome<D>& outcome) {
    std::string text = fmt::format("{} -> {}\n\n", request.mesh, request.output);
    for (const std::string& warning : outcome.warnings) text += "note: " + warning + "\n";
    const double cell = static_cast<double>(outcome.field.cell());
    text += fmt::format("{:<12}{}\n", surface_name<D>, surface_line(outcome));
    text += described(outcome.field);
    text += fmt::format("file        {}\n", megabytes(outcome.file_bytes));
    text += "signs       " + signs_line(outcome.report) + "\n";
    text += "error       near the surface " + error_line(outcome.errors.near, cell) + "\n";
    text += "            everywhere " + error_line(outcome.errors.volume, cell) + "\n";
    return text + fmt::format("time        {} s to read, {} to bake, {} to measure, {} to write\n",
                              number(outcome.read_seconds), number(outcome.bake_seconds),
                              number(outcome.measure_seconds), number(outcome.write_seconds));
}
template std::string text_report(const FieldRequest&, const FieldOutcome<2>&);
template std::string text_report(const FieldRequest&, const FieldOutcome<3>&);

template <int D>
std::string json_report(const FieldRequest& request, const FieldOutcome<D>& outcome) {
    const FieldReport& report = outcome.report;
    Json json = {{"output", request.output}, {D == 2 ? "objects" : "triangles", outcome.parts}};
    json["field"] = json_of(outcome.field);
    json["file_bytes"] = outcome.file_bytes;
    json["closed"] = report.closed;
    json["gaps"] = report.gaps;
    json["rewound"] = report.rewound;
    json["doubtful"] = report.uncertain;
    json["error"] = {{"near", json_of(outcome.errors.near)}, {"volume", json_of(outcome.errors.volume)}};
    json["warnings"] = outcome.warnings;
    json["seconds"] = {{"read", outcome.read_seconds},
                       {"bake", outcome.bake_seconds},
                       {"measure", outcome.measure_seconds},
                       {"write", outcome.write_seconds}};
    return to_text(json);
}
template std::string json_report(const FieldRequest&, const FieldOutcome<2>&);
template std::string json_report(const FieldRequest&, const FieldOutcome<3>&);

}  // namespace abut::tool
