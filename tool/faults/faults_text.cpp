#include "tool/faults/faults_report.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// Limits of the text report; --json lists all.
constexpr std::size_t max_listed_places = 5;

std::string and_more(std::size_t listed, std::size_t all, const char* what) {
    return listed < all ? fmt::format("      and {} more {} (--json lists them all)\n", all - listed, what) : "";
}

std::string sharing(std::size_t objects) {
    return objects > 1 ? fmt::format("  (and {} of the same mesh)", counted(objects - 1, "object", "objects")) : "";
}

template <int D>
std::string how(const SpawnFinding<D>& finding, const LevelView<D>& level) {
    const std::string object = finding.object ? level.objects[*finding.object].path : "";
    switch (finding.fault) {
        case SpawnFault::beneath:
            return fmt::format("is below {}, behind its surface", object);
        case SpawnFault::no_ground:
            return "has nothing below it to stand on";
        case SpawnFault::inside:
            break;
    }
    const std::string depth = fmt::format("is {} deep in {}", number(finding.depth), object);
    if (!finding.free) return depth + "; no free place was found near it";
    const Vec<D> offset = *finding.free - level.places[finding.place].position;
    return depth + fmt::format("; free at {}, {} away", vector(*finding.free),
                               number(static_cast<double>(glm::length(offset))));
}

template <int D>
std::string spawns(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "spawns\n";
    const std::size_t listed = std::min(faults.spawns.size(), max_listed);
    for (std::size_t i = 0; i < listed; ++i) {
        const NamedPlace<D>& place = level.places[faults.spawns[i].place];
        text += fmt::format("{:4}. {}  at {}\n        {}\n", i + 1, place.path, vector(place.position),
                            how(faults.spawns[i], level));
    }
    return text + and_more(listed, faults.spawns.size(), "spawns") + "\n";
}

template <int D>
std::string gaps(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<const Gap<D>*>> by_pair;
    for (const Gap<D>& gap : faults.gaps) by_pair[{gap.a, gap.b}].push_back(&gap);
    std::string text = fmt::format("gaps narrower than {}\n", number(faults.gap_range->width));
    std::size_t listed = 0;
    for (const auto& [pair, places] : by_pair) {
        if (listed == max_listed) break;
        const std::string &a = level.objects[pair.first].path, &b = level.objects[pair.second].path;
        text += fmt::format("{:4}. {}\n", ++listed, pair.first == pair.second ? "within " + a : a + "  and  " + b);
        for (std::size_t i = 0; i < places.size() && i < max_listed_places; ++i)
            text += fmt::format("        {} wide at {}\n", number(places[i]->width), vector(places[i]->position));
        if (places.size() > max_listed_places)
            text += fmt::format("        and {} more\n", places.size() - max_listed_places);
    }
    return text + and_more(listed, by_pair.size(), "pairs") + "\n";
}

template <int D>
std::string duplicates(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "duplicates\n";
    std::size_t listed = 0;
    for (const CopyGroup<D>& group : faults.duplicates.groups) {
        if (listed == max_listed) break;
        text += fmt::format("{:4}. {}\n", ++listed, level.objects[group.objects.front()].path);
        for (std::size_t i = 1; i < group.objects.size() && i <= max_listed_places; ++i)
            text += fmt::format("        again as {}\n", level.objects[group.objects[i]].path);
        if (group.objects.size() > max_listed_places + 1)
            text += fmt::format("        and {} more times\n", group.objects.size() - 1 - max_listed_places);
        text += fmt::format("        {} at {}\n",
                            group.apart > 0 ? fmt::format("at most {} apart", number(group.apart)) : "exactly the same",
                            vector(group.position));
    }
    for (const DuplicateFacets<D>& duplicate : faults.duplicates.facets) {
        if (listed == max_listed) break;
        text += fmt::format("{:4}. {}{}\n        {} there again, the first is number {}, at {}\n", ++listed,
                            level.objects[duplicate.object].path, sharing(duplicate.objects),
                            D == 3 ? counted(duplicate.count, "triangle is", "triangles are")
                                   : counted(duplicate.count, "segment is", "segments are"),
                            duplicate.first, vector(duplicate.position));
    }
    return text + and_more(listed, faults.duplicates.groups.size() + faults.duplicates.facets.size(), "of these") +
           "\n";
}

std::string how(const Leak& leak) {
    switch (leak.kind) {
        case LeakKind::hole:
            return fmt::format("a hole of {}, {} across, {} around", counted(leak.count, "edge", "edges"),
                               number(leak.extent), number(leak.length));
        case LeakKind::crack:
            return fmt::format("a crack of no width along {}, {} long: corners of one side aren't corners of the other",
                               counted(leak.count, "edge", "edges"), number(leak.length));
        case LeakKind::non_manifold:
            return fmt::format("{} of more than two triangles (non-manifold), {} long",
                               counted(leak.count, "edge", "edges"), number(leak.length));
        case LeakKind::flipped:
            break;
    }
    return fmt::format("{} in the wrong direction", counted(leak.count, "triangle faces", "triangles face"));
}

template <int D>
std::string leaks(const LevelFaults<D>& faults, const LevelView<D>& level) {
    std::string text = "leaks\n";
    const std::vector<LevelLeak>& all = faults.leaks;
    std::size_t listed = 0, objects = 0;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].object == all[begin].object) ++end;
        if (++objects > max_listed) continue;
        ++listed;
        text += fmt::format("{:4}. {}{}\n", listed, level.objects[all[begin].object].path, sharing(all[begin].objects));
        for (std::size_t i = begin; i < end && i < begin + max_listed_places; ++i)
            text +=
                fmt::format("        {}, at {} (triangle {})\n", how(all[i]), vector(all[i].center), all[i].triangle);
        if (end - begin > max_listed_places)
            text += fmt::format("        and {} more\n", end - begin - max_listed_places);
    }
    return text + and_more(listed, objects, "objects") + "\n";
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
    if (faults.spawns_tested > 0)
        text += fmt::format("spawns    {} of {} blocked or out of place\n", faults.spawns.size(), faults.spawns_tested);
    if (faults.gap_range)
        text += fmt::format("gaps      {} from {} to {} wide\n", faults.gaps.size(),
                            number(faults.gap_range->min_width), number(faults.gap_range->width));
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
    add(faults.spawns.size(), "spawn is blocked or out of place", "spawns are blocked or out of place");
    add(faults.gaps.size(), "passage is too narrow", "passages are too narrow");
    add(faults.duplicates.groups.size(), "object is duplicated", "objects are duplicated");
    if (D == 3)
        add(faults.duplicates.facets.size(), "mesh has duplicate triangles", "meshes have duplicate triangles");
    else
        add(faults.duplicates.facets.size(), "object has duplicate segments", "objects have duplicate segments");
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
