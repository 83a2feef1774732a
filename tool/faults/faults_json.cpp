#include "tool/faults/faults_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace abut::tool {
namespace {

const char* name_of(SpawnFault fault) {
    switch (fault) {
        case SpawnFault::beneath:
            return "beneath";
        case SpawnFault::no_ground:
            return "no ground";
        case SpawnFault::inside:
            break;
    }
    return "inside";
}

const char* name_of(LeakKind kind) {
    switch (kind) {
        case LeakKind::crack:
            return "crack";
        case LeakKind::non_manifold:
            return "crowded";
        case LeakKind::flipped:
            return "flipped";
        case LeakKind::hole:
            break;
    }
    return "hole";
}

template <int D>
Json json(const SpawnFinding<D>& finding, const LevelView<D>& level) {
    const NamedPlace<D>& place = level.places[finding.place];
    Json result = {{"name", place.path}, {"position", numbers(place.position)}, {"fault", name_of(finding.fault)}};
    if (finding.object) result["object"] = level.objects[*finding.object].path;
    if (finding.fault == SpawnFault::inside) result["depth"] = finding.depth;
    if (finding.free) result["free"] = numbers(*finding.free);
    return result;
}

template <int D>
Json json(const Gap<D>& gap, const LevelView<D>& level) {
    return {{"a", level.objects[gap.a].path},
            {"b", level.objects[gap.b].path},
            {"width", gap.width},
            {"position", numbers(gap.position)},
            {"points", {numbers(gap.on_a), numbers(gap.on_b)}}};
}

template <int D>
Json json(const CopyGroup<D>& group, const LevelView<D>& level) {
    Json objects = Json::array();
    for (const std::size_t i : group.objects) objects.push_back(level.objects[i].path);
    return {{"objects", std::move(objects)}, {"apart", group.apart}, {"position", numbers(group.position)}};
}

template <int D>
Json json(const DuplicateFacets<D>& duplicate, const LevelView<D>& level) {
    return {{"objects", {level.objects[duplicate.object].path}},
            {"of_this_mesh", duplicate.objects},
            {"pieces", duplicate.count},
            {"first_piece", duplicate.first},
            {"position", numbers(duplicate.position)}};
}

template <int D>
Json json(const LevelLeak& leak, const LevelView<D>& level) {
    Json result = {{"object", level.objects[leak.object].path},
                   {"of_this_mesh", leak.objects},
                   {"kind", name_of(leak.kind)},
                   {"position", numbers(leak.center)},
                   {"triangle", leak.triangle}};
    if (leak.kind == LeakKind::flipped) {
        result["triangles"] = leak.count;
        return result;
    }
    result["edges"] = leak.count;
    result["length"] = leak.length;
    result["extent"] = leak.extent;
    return result;
}

template <class Findings, int D>
Json list(const Findings& findings, const LevelView<D>& level) {
    Json result = Json::array();
    for (const auto& finding : findings) result.push_back(json(finding, level));
    return result;
}

// Duplicate objects first, then duplicate facets.
template <int D>
Json list(const Duplicates<D>& duplicates, const LevelView<D>& level) {
    Json result = list(duplicates.groups, level);
    for (Json& duplicate : list(duplicates.facets, level)) result.push_back(std::move(duplicate));
    return result;
}

// All members that identify a fault, except for its position and sizes.
std::string names_in(const Json& entry) {
    std::string names;
    for (const char* key : {"name", "fault", "a", "b", "object", "objects", "kind", "pieces"})
        if (entry.contains(key)) names += entry[key].dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    return names;
}

std::optional<double> distance(const Json& a, const Json& b) {
    if (!a.is_array() || !b.is_array() || a.size() != b.size()) return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!a[i].is_number() || !b[i].is_number()) return std::nullopt;
        const double difference = a[i].get<double>() - b[i].get<double>();
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

template <class Findings, int D>
std::size_t remove_known_from(Findings& findings, const LevelView<D>& level, const Json& baseline, const char* array) {
    if (!baseline.contains(array) || !baseline[array].is_array()) return 0;
    return std::erase_if(findings, [&](const auto& finding) {
        const Json entry = json(finding, level);
        const std::string names = names_in(entry);
        double reach = std::numeric_limits<double>::infinity();
        for (const char* key : {"width", "extent"})
            if (entry.contains(key)) reach = entry[key].template get<double>();
        return std::any_of(baseline[array].begin(), baseline[array].end(), [&](const Json& old) {
            if (!old.is_object() || !old.contains("position") || names_in(old) != names) return false;
            const std::optional<double> offset = distance(entry["position"], old["position"]);
            return offset && *offset <= reach;
        });
    });
}

}  // namespace

template <int D>
Json json_of(const LevelFaults<D>& faults, const LevelView<D>& level) {
    return {{"spawn_points", faults.spawns_tested},
            {"spawns", list(faults.spawns, level)},
            {"gaps", list(faults.gaps, level)},
            {"duplicates", list(faults.duplicates, level)},
            {"leaks", list(faults.leaks, level)}};
}

template <int D>
void remove_known(LevelFaults<D>& faults, const LevelView<D>& level, const Json& baseline) {
    faults.known += remove_known_from(faults.spawns, level, baseline, "spawns");
    faults.known += remove_known_from(faults.gaps, level, baseline, "gaps");
    faults.known += remove_known_from(faults.duplicates.groups, level, baseline, "duplicates");
    faults.known += remove_known_from(faults.duplicates.facets, level, baseline, "duplicates");
    faults.known += remove_known_from(faults.leaks, level, baseline, "leaks");
}

template Json json_of(const LevelFaults<2>&, const LevelView<2>&);
template Json json_of(const LevelFaults<3>&, const LevelView<3>&);
template void remove_known(LevelFaults<2>&, const LevelView<2>&, const Json&);
template void remove_known(LevelFaults<3>&, const LevelView<3>&, const Json&);

}  // namespace abut::tool
