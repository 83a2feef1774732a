#include "tool/faults/faults.hpp"

#include <algorithm>
#include <utility>

namespace abut::tool {
namespace {

template <int D>
Result<std::optional<Vec<D>>> parse_up_direction(const FaultOptions& options) {
    const UpDirection up = options.up.value_or(UpDirection{D == 3 ? 1 : -1, 1});
    if (up.axis >= D) return Problem{ProblemCode::bad_argument, "--up: a 2D level has no such axis"};
    if (up.axis < 0) return std::optional<Vec<D>>();
    Vec<D> direction{};
    direction[up.axis] = up.sign;
    return std::optional(direction);
}

template <int D>
Result<std::vector<std::size_t>> spawns_of(const LevelView<D>& level, const FaultOptions& options) {
    if (options.spawns.empty()) return options.pairs.empty() ? default_spawns(level) : std::vector<std::size_t>();
    std::vector<std::size_t> result;
    for (const std::string& pattern : options.spawns) {
        const std::vector<std::size_t> described = matching_places(level, pattern);
        if (described.empty()) return Problem{ProblemCode::bad_argument, "--spawn: nothing is named '" + pattern + "'"};
        result.insert(result.end(), described.begin(), described.end());
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

template <int D>
bool matches_any(const std::vector<std::string>& patterns, const ViewedObject<D>& object) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) { return matches_name(pattern, object); });
}

template <int D>
Result<std::vector<LevelLeak>> leaks_of(const LevelView<D>& level, const FaultOptions& options) {
    if (D == 2 && !options.closed.empty())
        return Problem{ProblemCode::bad_argument, "--closed: leaks are checked in 3D only"};
    for (const std::string& pattern : options.closed)
        if (std::none_of(level.objects.begin(), level.objects.end(),
                         [&](const auto& object) { return matches_any<D>({pattern}, object); }))
            return Problem{ProblemCode::bad_argument, "--closed: no object is named '" + pattern + "'"};
    if constexpr (D == 3) {
        if (!options.closed.empty())
            return find_leaks(level.objects,
                              [&](const ViewedObject<3>& object) { return matches_any(options.closed, object); });
        if (options.pairs.empty()) return find_leaks(level.objects, nullptr);
    }
    return std::vector<LevelLeak>();
}

template <int D>
void find_selected_duplicates(const LevelView<D>& level, const PairFilter& filter, const FaultOptions& options,
                              Duplicates<D>& result) {
    result = find_duplicates(level.objects);
    if (options.pairs.empty()) return;
    result.facets.clear();
    std::erase_if(result.groups, [&](const CopyGroup<D>& group) {
        for (const std::size_t i : group.objects)
            for (const std::size_t j : group.objects)
                if (i < j && filter.has(i, j)) return false;
        return true;
    });
}

// Where the character walks, for the check of gaps; nothing, and a note, if that is unknown.
template <int D>
std::optional<Walkable<D>> walkable_of(const LevelView<D>& level, const FacetTree<D>& facets,
                                       const std::vector<std::size_t>& spawns,
                                       const std::optional<Character>& character, const std::optional<Vec<D>>& up,
                                       std::vector<std::string>& notes) {
    if (!character) return std::nullopt;
    std::vector<Vec<D>> positions;
    for (const std::size_t spawn : spawns) positions.push_back(level.places[spawn].position);
    const char* all_count = ": gaps are reported everywhere, also where nobody walks";
    if (positions.empty()) {
        notes.push_back(std::string("there is no spawn") + all_count);
        return std::nullopt;
    }
    Walkable<D> walkable(facets, *character, up, positions);
    if (walkable.size() > 0 && walkable.is_complete()) return walkable;
    notes.push_back((walkable.size() == 0 ? "the character can stand at no spawn"
                                          : "the level is too large to walk through for a character of that size") +
                    std::string(all_count));
    return std::nullopt;
}

}  // namespace

std::optional<GapRange> gap_range(const FaultOptions& options) {
    if (options.gap || !options.character) return options.gap;
    const float width = 2 * options.character->radius;
    return GapRange{default_min_gap * width, width};
}

template <int D>
Result<LevelFaults<D>> find_faults(const LevelView<D>& level, const FaultOptions& options,
                                   const Severities& severities) {
    const Result<std::optional<Vec<D>>> up = parse_up_direction<D>(options);
    if (!up) return up.problem();
    const Result<std::vector<std::size_t>> spawns = spawns_of(level, options);
    if (!spawns) return spawns.problem();
    LevelFaults<D> result;
    if (severities.checks(Kind::leak)) {
        Result<std::vector<LevelLeak>> leaks = leaks_of(level, options);
        if (!leaks) return leaks.problem();
        result.leaks = *std::move(leaks);
    }
    if (severities.checks(Kind::spawn)) {
        result.spawns_tested = spawns->size();
        if (!spawns->empty())
            result.spawns = find_spawn_faults(level, *spawns, {options.character, *up, options.allow});
    }
    const PairFilter filter(level.objects, options.pairs);
    if (severities.checks(Kind::gap)) result.gap_range = gap_range(options);
    if (result.gap_range) {
        GapOptions<D> gap{result.gap_range->width, result.gap_range->min_width};
        if (*up) gap.up = DVec<D>(**up);
        gap.is_selected = [&](std::size_t i, std::size_t j) { return filter.has(i, j); };
        const FacetTree<D> facets(level.objects);
        std::vector<ViewedObject<D>> obstacles;
        for (const std::size_t i : obstacles_of(level, *spawns)) obstacles.push_back(level.objects[i]);
        const FacetTree<D> ways(obstacles);
        const std::optional<Walkable<D>> walkable =
            walkable_of<D>(level, ways, *spawns, options.character, *up, result.notes);
        if (walkable) gap.walkable = &*walkable;
        result.gaps = find_gaps(facets, gap);
    }
    if (severities.checks(Kind::floating) && *up) {
        const std::vector<std::size_t> numbers = obstacles_of(level, *spawns);
        std::vector<ViewedObject<D>> objects;
        for (const std::size_t i : numbers) objects.push_back(level.objects[i]);
        result.floating = find_floating(objects, **up);
        for (FloatingObject<D>& floating : result.floating) {
            floating.object = numbers[floating.object];
            floating.nearest = numbers[floating.nearest];
        }
    }
    if (severities.checks(Kind::duplicate)) find_selected_duplicates(level, filter, options, result.duplicates);
    return result;
}

template Result<LevelFaults<2>> find_faults(const LevelView<2>&, const FaultOptions&, const Severities&);
template Result<LevelFaults<3>> find_faults(const LevelView<3>&, const FaultOptions&, const Severities&);

}  // namespace abut::tool
