#include "faults_report.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// Beyond these a person reads no further; --json has them all.
constexpr std::size_t most_entries = 100;
constexpr std::size_t most_places = 5;

std::string and_more(std::size_t told, std::size_t all, const char* what) {
    return told < all ? fmt::format("      and {} more {} (--json lists them all)\n", all - told, what) : "";
}

std::string sharing(std::size_t objects) {
    return objects > 1 ? fmt::format("  (and {} of the same mesh)", counted(objects - 1, "object", "objects")) : "";
}

template <int D>
std::string how(const SpawnFinding<D>& finding, const LevelView<D>& level) {
    const std::string object = finding.object ? level.objects[*finding.object].path : "";
    switch (finding.fault) {
        case SpawnFault::beneath:
            return fmt::format("is below {}, which is seen from behind there", object);
        case SpawnFault::no_ground:
            return "has nothing below it to stand on";
        case SpawnFault::inside:
            break;
    }
    const std::string depth = fmt::format("is {} deep in {}", number(finding.depth), object);
    if (!finding.free) return depth + "; no free place was found near it";
    const Vec<D> way = *finding.free - level.places[finding.place].position;
    return depth +
           fmt::format("; free at {}, {} away", vector(*finding.free), number(static_cast<double>(glm::length(way))));
}

template <int D>
std::string spawns(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "spawns\n";
    const std::size_t told = std::min(faults.spawns.size(), most_entries);
    for (std::size_t i = 0; i < told; ++i) {
        const NamedPlace<D>& place = level.places[faults.spawns[i].place];
        text += fmt::format("{:4}. {}  at {}\n        {}\n", i + 1, place.path, vector(place.position),
                            how(faults.spawns[i], level));
    }
    return text + and_more(told, faults.spawns.size(), "spawns") + "\n";
}

template <int D>
std::string gaps(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<const Gap<D>*>> by_pair;
    for (const Gap<D>& gap : faults.gaps) by_pair[{gap.a, gap.b}].push_back(&gap);
    std::string text = fmt::format("gaps narrower than {}\n", number(faults.gap_range->width));
    std::size_t told = 0;
    for (const auto& [pair, places] : by_pair) {
        if (told == most_entries) break;
        const std::string &a = level.objects[pair.first].path, &b = level.objects[pair.second].path;
        text += fmt::format("{:4}. {}\n", ++told, pair.first == pair.second ? "within " + a : a + "  and  " + b);
        for (std::size_t i = 0; i < places.size() && i < most_places; ++i)
            text += fmt::format("        {} wide at {}\n", number(places[i]->width), vector(places[i]->position));
        if (places.size() > most_places) text += fmt::format("        and {} more\n", places.size() - most_places);
    }
    return text + and_more(told, by_pair.size(), "pairs") + "\n";
}

template <int D>
std::string duplicates(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "duplicates\n";
    std::size_t told = 0;
    for (const CopyGroup<D>& group : faults.duplicates.groups) {
        if (told == most_entries) break;
        text += fmt::format("{:4}. {}\n", ++told, level.objects[group.objects.front()].path);
        for (std::size_t i = 1; i < group.objects.size() && i <= most_places; ++i)
            text += fmt::format("        again as {}\n", level.objects[group.objects[i]].path);
        if (group.objects.size() > most_places + 1)
            text += fmt::format("        and {} more times\n", group.objects.size() - 1 - most_places);
        text += fmt::format("        {} at {}\n",
                            group.apart > 0 ? fmt::format("at most {} apart", number(group.apart)) : "exactly the same",
                            vector(group.position));
    }
    for (const DoubledFacets<D>& doubled : faults.duplicates.facets) {
        if (told == most_entries) break;
        text += fmt::format("{:4}. {}{}\n        {} there again, the first is number {}, at {}\n", ++told,
                            level.objects[doubled.object].path, sharing(doubled.objects),
                            D == 3 ? counted(doubled.count, "triangle is", "triangles are")
                                   : counted(doubled.count, "segment is", "segments are"),
                            doubled.first, vector(doubled.position));
    }
    return text + and_more(told, faults.duplicates.groups.size() + faults.duplicates.facets.size(), "of these") + "\n";
}

std::string how(const Leak& leak) {
    switch (leak.kind) {
        case LeakKind::hole:
            return fmt::format("a hole of {}, {} across, {} around", counted(leak.count, "edge", "edges"),
                               number(leak.extent), number(leak.length));
        case LeakKind::crack:
            return fmt::format("a crack of no width along {}, {} long: corners of one side aren't corners of the other",
                               counted(leak.count, "edge", "edges"), number(leak.length));
        case LeakKind::crowded:
            return fmt::format("{} with three triangles or more, {} long", counted(leak.count, "edge", "edges"),
                               number(leak.length));
        case LeakKind::flipped:
            break;
    }
    return fmt::format("{} the wrong way", counted(leak.count, "triangle faces", "triangles face"));
}

template <int D>
std::string leaks(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "leaks\n";
    const std::vector<LevelLeak>& all = faults.leaks;
    std::size_t told = 0, objects = 0;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].object == all[begin].object) ++end;
        if (++objects > most_entries) continue;
        ++told;
        text += fmt::format("{:4}. {}{}\n", told, level.objects[all[begin].object].path, sharing(all[begin].objects));
        for (std::size_t i = begin; i < end && i < begin + most_places; ++i)
            text +=
                fmt::format("        {}, at {} (triangle {})\n", how(all[i]), vector(all[i].center), all[i].triangle);
        if (end - begin > most_places) text += fmt::format("        and {} more\n", end - begin - most_places);
    }
    return text + and_more(told, objects, "objects") + "\n";
}

}  // namespace

template <int D>
std::string text_of(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text;
    if (!faults.spawns.empty()) text += spawns(faults, level);
    if (!faults.gaps.empty()) text += gaps(faults, level);
    if (!faults.duplicates.groups.empty() || !faults.duplicates.facets.empty()) text += duplicates(faults, level);
    if (!faults.leaks.empty()) text += leaks(faults, level);
    return text;
}

template <int D>
std::string summary_of(const LevelFaults<D>& faults) {
    std::string text;
    if (faults.spawns_looked_at > 0)
        text +=
            fmt::format("spawns    {} of {} blocked or out of place\n", faults.spawns.size(), faults.spawns_looked_at);
    if (faults.gap_range)
        text += fmt::format("gaps      {} from {} to {} wide\n", faults.gaps.size(), number(faults.gap_range->least),
                            number(faults.gap_range->width));
    if (faults.known > 0)
        text += fmt::format("baseline  has {} more of spawns, gaps, duplicates and leaks\n", faults.known);
    return text;
}

template <int D>
std::vector<std::string> verdicts_of(const LevelFaults<D>& faults) {
    std::vector<std::string> result;
    const auto add = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) result.push_back(counted(count, one, many));
    };
    add(faults.spawns.size(), "spawn is no place to be", "spawns are no places to be");
    add(faults.gaps.size(), "passage is too narrow", "passages are too narrow");
    add(faults.duplicates.groups.size(), "object is there again", "objects are there again");
    if (D == 3)
        add(faults.duplicates.facets.size(), "mesh has doubled triangles", "meshes have doubled triangles");
    else
        add(faults.duplicates.facets.size(), "object has doubled segments", "objects have doubled segments");
    add(faults.leaks.size(), "leak", "leaks");
    return result;
}

template std::string text_of(const LevelFaults<2>&, const LevelView<2>&);
template std::string text_of(const LevelFaults<3>&, const LevelView<3>&);
template std::string summary_of(const LevelFaults<2>&);
template std::string summary_of(const LevelFaults<3>&);
template std::vector<std::string> verdicts_of(const LevelFaults<2>&);
template std::vector<std::string> verdicts_of(const LevelFaults<3>&);

}  // namespace abut::tool
