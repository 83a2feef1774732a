#include "tool/faults/fault_report.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// A line names at most this many of equal objects; JSON reports list all.
constexpr std::size_t max_named = 5;

// Words of JSON reports.
const char* word_of(SpawnFault fault) {
    return fault == SpawnFault::beneath ? "beneath" : fault == SpawnFault::no_ground ? "no ground" : "inside";
}
const char* word_of(LeakKind kind) {
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

Rule rule_of(SpawnFault fault) {
    return fault == SpawnFault::beneath     ? Rule::spawn_beneath
           : fault == SpawnFault::no_ground ? Rule::spawn_no_ground
                                            : Rule::spawn_blocked;
}
Rule rule_of(LeakKind kind) {
    return kind == LeakKind::hole           ? Rule::hole
           : kind == LeakKind::crack        ? Rule::crack
           : kind == LeakKind::non_manifold ? Rule::non_manifold
                                            : Rule::flipped;
}

std::string sharing(std::size_t objects) {
    return objects > 1 ? fmt::format(" (and in {} of the same mesh)", counted(objects - 1, "object", "objects")) : "";
}

template <class Named>
ObjectName names_of(const Named& named) {
    return {named.path, named.name, named.type};
}

template <int D>
Finding finding_of(const SpawnFinding<D>& spawn, const LevelView<D>& level) {
    const NamedPlace<D>& place = level.places[spawn.place];
    Finding finding;
    finding.rule = rule_of(spawn.fault);
    finding.objects.push_back(names_of(place));
    finding.position = coordinates(place.position);
    finding.badness = std::numeric_limits<double>::infinity();
    finding.data = {{"name", place.path}, {"position", numbers(place.position)}, {"fault", word_of(spawn.fault)}};
    std::string object;
    if (spawn.object) {
        object = level.objects[*spawn.object].path;
        finding.objects.push_back(names_of(level.objects[*spawn.object]));
        finding.data["object"] = object;
    }
    if (spawn.fault == SpawnFault::beneath) finding.text = fmt::format("is below {}, behind its surface", object);
    if (spawn.fault == SpawnFault::no_ground) finding.text = "has nothing below it to stand on";
    if (spawn.fault == SpawnFault::inside) {
        finding.badness = static_cast<double>(spawn.depth);
        finding.data["depth"] = spawn.depth;
        finding.text = fmt::format("is {} deep in {}", number(static_cast<double>(spawn.depth)), object);
        if (spawn.free) {
            const auto away = static_cast<double>(glm::distance(*spawn.free, place.position));
            finding.text += fmt::format("; free at {}, {} away", vector(*spawn.free), number(away));
        } else {
            finding.text += "; no free place was found near it";
        }
    }
    if (spawn.free) finding.data["free"] = numbers(*spawn.free);
    finding.text += ", at " + vector(place.position);
    return finding;
}

template <int D>
Finding finding_of(const Gap<D>& gap, const LevelView<D>& level) {
    Finding finding;
    finding.rule = gap.is_detour ? Rule::narrow_detour : Rule::narrow_passage;
    finding.objects.push_back(names_of(level.objects[gap.a]));
    if (gap.a != gap.b) finding.objects.push_back(names_of(level.objects[gap.b]));
    finding.position = coordinates(gap.position);
    finding.badness = static_cast<double>(-gap.width);
    finding.text = fmt::format("{} wide at {}", number(static_cast<double>(gap.width)), vector(gap.position));
    if (gap.is_detour) finding.text += "; both ends are reached by another way";
    finding.data = {{"a", level.objects[gap.a].path},
                    {"b", level.objects[gap.b].path},
                    {"width", gap.width},
                    {"position", numbers(gap.position)},
                    {"points", {numbers(gap.on_a), numbers(gap.on_b)}}};
    return finding;
}

template <int D>
Finding finding_of(const CopyGroup<D>& group, const LevelView<D>& level) {
    Finding finding;
    finding.rule = Rule::same_object;
    finding.position = coordinates(group.position);
    finding.badness = static_cast<double>(group.objects.size());
    Json paths = Json::array();
    std::string again;
    for (std::size_t i = 0; i < group.objects.size(); ++i) {
        const ViewedObject<D>& object = level.objects[group.objects[i]];
        finding.objects.push_back(names_of(object));
        paths.push_back(object.path);
        if (i > 0 && i <= max_named) again += (i > 1 ? ", " : "") + object.path;
    }
    if (group.objects.size() > max_named + 1)
        again += fmt::format(" and {} more", group.objects.size() - 1 - max_named);
    finding.text =
        fmt::format("again as {}; {} at {}", again,
                    group.apart > 0 ? fmt::format("at most {} apart", number(static_cast<double>(group.apart)))
                                    : "exactly the same",
                    vector(group.position));
    finding.data = {{"objects", std::move(paths)}, {"apart", group.apart}, {"position", numbers(group.position)}};
    return finding;
}

template <int D>
Finding finding_of(const DuplicateFacets<D>& duplicate, const LevelView<D>& level) {
    Finding finding;
    finding.rule = Rule::same_facets;
    finding.objects.push_back(names_of(level.objects[duplicate.object]));
    finding.position = coordinates(duplicate.position);
    finding.text = fmt::format("{} there again, the first is number {}, at {}{}",
                               D == 3 ? counted(duplicate.count, "triangle is", "triangles are")
                                      : counted(duplicate.count, "segment is", "segments are"),
                               duplicate.first, vector(duplicate.position), sharing(duplicate.objects));
    finding.data = {{"objects", {level.objects[duplicate.object].path}},
                    {"of_this_mesh", duplicate.objects},
                    {"pieces", duplicate.count},
                    {"first_piece", duplicate.first},
                    {"position", numbers(duplicate.position)}};
    return finding;
}

std::string how(const Leak& leak) {
    const std::string length = number(static_cast<double>(leak.length));
    switch (leak.kind) {
        case LeakKind::hole:
            return fmt::format("a hole of {}, {} across, {} around", counted(leak.count, "edge", "edges"),
                               number(static_cast<double>(leak.extent)), length);
        case LeakKind::crack:
            return fmt::format("a crack of no width along {}, {} long: corners of one side aren't corners of the other",
                               counted(leak.count, "edge", "edges"), length);
        case LeakKind::non_manifold:
            return fmt::format("{} of more than two triangles (non-manifold), {} long",
                               counted(leak.count, "edge", "edges"), length);
        case LeakKind::flipped:
            break;
    }
    return fmt::format("{} in the wrong direction", counted(leak.count, "triangle faces", "triangles face"));
}

template <int D>
Finding finding_of(const LevelLeak& leak, const LevelView<D>& level) {
    Finding finding;
    finding.rule = rule_of(leak.kind);
    finding.objects.push_back(names_of(level.objects[leak.object]));
    finding.position = coordinates(leak.center);
    finding.badness = static_cast<double>(leak.extent);
    finding.text =
        fmt::format("{}, at {} (triangle {}){}", how(leak), vector(leak.center), leak.triangle, sharing(leak.objects));
    finding.data = {{"object", level.objects[leak.object].path},
                    {"of_this_mesh", leak.objects},
                    {"kind", word_of(leak.kind)},
                    {"position", numbers(leak.center)},
                    {"triangle", leak.triangle}};
    if (leak.kind == LeakKind::flipped) {
        finding.data["triangles"] = leak.count;
        return finding;
    }
    finding.data["edges"] = leak.count;
    finding.data["length"] = leak.length;
    finding.data["extent"] = leak.extent;
    return finding;
}

template <int D>
Finding finding_of(const FloatingObject<D>& floating, const LevelView<D>& level) {
    Finding finding;
    finding.rule = Rule::floating;
    finding.objects.push_back(names_of(level.objects[floating.object]));
    const std::string& nearest = level.objects[floating.nearest].path;
    finding.position = coordinates(floating.position);
    finding.badness = static_cast<double>(floating.distance);
    finding.text = fmt::format("touches nothing; the nearest below it is {}, {} away, at {}", nearest,
                               number(static_cast<double>(floating.distance)), vector(floating.position));
    finding.data = {{"object", level.objects[floating.object].path},
                    {"nearest", nearest},
                    {"distance", floating.distance},
                    {"position", numbers(floating.position)}};
    return finding;
}

}  // namespace

template <int D>
std::vector<Finding> findings_of(const LevelFaults<D>& faults, const LevelView<D>& level,
                                 const Severities& severities) {
    std::vector<Finding> findings;
    const auto add = [&](const auto& of_a_kind) {
        for (const auto& fault : of_a_kind) {
            Finding finding = finding_of(fault, level);
            finding.severity = severities.of(finding.rule);
            if (finding.severity != Severity::off) findings.push_back(std::move(finding));
        }
    };
    add(faults.spawns);
    add(faults.gaps);
    add(faults.duplicates.groups);
    add(faults.duplicates.facets);
    add(faults.leaks);
    add(faults.floating);
    return findings;
}

template std::vector<Finding> findings_of(const LevelFaults<2>&, const LevelView<2>&, const Severities&);
template std::vector<Finding> findings_of(const LevelFaults<3>&, const LevelView<3>&, const Severities&);

}  // namespace abut::tool
