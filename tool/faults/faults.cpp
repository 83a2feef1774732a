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

}  // namespace

std::optional<GapRange> gap_range(const FaultOptions& options) {
    if (options.gap || !options.character) return options.gap;
    const float width = 2 * options.character->radius;
    return GapRange{default_min_gap * width, width};
}

template <int D>
Result<LevelFaults<D>> find_faults(const LevelView<D>& level, const FaultOptions& options) {
    const Result<std::optional<Vec<D>>> up = parse_up_direction<D>(options);
    if (!up) return up.problem();
    const Result<std::vector<std::size_t>> spawns = spawns_of(level, options);
    if (!spawns) return spawns.problem();
    Result<std::vector<LevelLeak>> leaks = leaks_of(level, options);
    if (!leaks) return leaks.problem();

    LevelFaults<D> result;
    result.leaks = *std::move(leaks);
    result.spawns_tested = spawns->size();
    if (!spawns->empty()) result.spawns = find_spawn_faults(level, *spawns, {options.character, *up, options.allow});
    const PairFilter filter(level.objects, options.pairs);
    result.gap_range = gap_range(options);
    if (result.gap_range) {
        GapOptions<D> gap{result.gap_range->width, result.gap_range->min_width};
        if (*up) gap.up = DVec<D>(**up);
        gap.is_selected = [&](std::size_t i, std::size_t j) { return filter.has(i, j); };
        result.gaps = find_gaps(FacetTree<D>(level.objects), gap);
    }
    result.duplicates = find_duplicates(level.objects);
    if (!options.pairs.empty()) {
        result.duplicates.facets.clear();
        std::erase_if(result.duplicates.groups, [&](const CopyGroup<D>& group) {
            for (const std::size_t i : group.objects)
                for (const std::size_t j : group.objects)
                    if (i < j && filter.has(i, j)) return false;
            return true;
        });
    }
    return result;
}

template Result<LevelFaults<2>> find_faults(const LevelView<2>&, const FaultOptions&);
template Result<LevelFaults<3>> find_faults(const LevelView<3>&, const FaultOptions&);

}  // namespace abut::tool
