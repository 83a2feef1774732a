#include "tool/faults/gaps.hpp"

#include "tool/faults/necks.hpp"
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace abut::tool {

using namespace detail;

namespace {

constexpr int max_steps = 256;
// Relative to a neck's width: the step along a passage, and the tolerated decrease in width.
constexpr double step = 0.5, max_narrowing = 0.01;
// The sine of the steepest neck between things that stand beside each other: 45 degrees.
constexpr double max_rise = 0.7071;

// Directions in which a passage may run: all directions across the neck, up to sign.
std::vector<DVec<2>> directions(const std::array<DVec<2>, 1>& along) {
    return {along[0]};
}
std::vector<DVec<3>> directions(const std::array<DVec<3>, 2>& along) {
    // Every 22.5 degrees: the principal axes first, then the diagonals.
    constexpr double c = 0.92387953251128674, s = 0.38268343236508977, r = 0.70710678118654752;
    constexpr std::array<std::array<double, 2>, 8> turns{
        {{1, 0}, {0, 1}, {r, r}, {r, -r}, {c, s}, {c, -s}, {s, c}, {s, -c}}};
    std::vector<DVec<3>> result;
    for (const auto& [x, y] : turns) result.push_back(along[0] * x + along[1] * y);
    return result;
}

// The place where the passage opens in a direction, as gaps.hpp defines. A passage that exceeds the step limit counts
// as open.
template <int D>
std::optional<DVec<D>> opening(const FacetTree<D>& facets, const Neck<D>& neck, DVec<D> direction, double width) {
    DVec<D> position = neck.middle, across = neck.across;
    const double stride = step * neck.width;
    for (int i = 0; i < max_steps; ++i) {
        if (facets.first_hit(position, direction, stride)) return std::nullopt;
        const DVec<D> next = position + direction * stride;
        const auto reach = [&](const DVec<D>& towards) {
            const auto hit = facets.first_hit(next, towards, width);
            return hit ? hit->distance : width;
        };
        const double before = reach(-across), behind = reach(across);
        if (before + behind >= width) return next;
        if (before + behind < neck.width * (1 - max_narrowing)) return std::nullopt;
        const DVec<D> middle = next + across * (0.5 * (behind - before));
        direction = normalized(middle - position);
        across = normalized(across - direction * dot(across, direction));
        position = middle;
    }
    return position;
}

// Tests if a neck is a passage, and if a walking character reaches both ends.
template <int D>
bool is_passage(const FacetTree<D>& facets, Neck<D>& neck, const GapOptions<D>& options) {
    const Walkable<D>* walkable = options.walkable;
    if (walkable != nullptr && options.up && D == 3 && std::abs(dot(neck.across, *options.up)) > max_rise) return false;
    if (walkable != nullptr && !walkable->has_headroom(neck.middle)) return false;
    for (const DVec<D>& direction : directions(neck.along)) {
        const std::optional<DVec<D>> one = opening<D>(facets, neck, direction, options.width);
        const std::optional<DVec<D>> other = one ? opening<D>(facets, neck, -direction, options.width) : std::nullopt;
        if (!other) continue;
        if (walkable == nullptr) return true;
        const bool reaches_one = walkable->reaches(*one, options.width, neck.middle),
                   reaches_other = walkable->reaches(*other, options.width, neck.middle);
        if (!reaches_one && !reaches_other) continue;
        neck.is_detour = reaches_one && reaches_other;
        return true;
    }
    return false;
}

}  // namespace

template <int D>
std::vector<Gap<D>> find_gaps(const FacetTree<D>& facets, const GapOptions<D>& options) {
    std::vector<Neck<D>> necks;
    for (Neck<D>& neck : find_necks(facets, options))
        if (is_passage(facets, neck, options)) necks.push_back(neck);
    std::stable_sort(necks.begin(), necks.end(), [](const Neck<D>& a, const Neck<D>& b) { return a.width < b.width; });
    std::vector<Neck<D>> reported;
    for (const Neck<D>& neck : necks) {
        const bool is_reported = std::any_of(reported.begin(), reported.end(), [&](const Neck<D>& other) {
            return length(other.middle - neck.middle) < options.width && facets.is_visible(other.middle, neck.middle);
        });
        if (!is_reported) reported.push_back(neck);
    }
    std::vector<Gap<D>> result;
    for (const Neck<D>& neck : reported) {
        const DVec<D> half = neck.across * (0.5 * neck.width);
        Gap<D> gap{neck.a,
                   neck.b,
                   static_cast<float>(neck.width),
                   Vec<D>(neck.middle),
                   Vec<D>(neck.middle - half),
                   Vec<D>(neck.middle + half),
                   neck.is_detour};
        if (gap.a > gap.b) {
            std::swap(gap.a, gap.b);
            std::swap(gap.on_a, gap.on_b);
        }
        result.push_back(gap);
    }
    std::stable_sort(result.begin(), result.end(), [](const Gap<D>& a, const Gap<D>& b) {
        return std::tie(a.a, a.b, a.width) < std::tie(b.a, b.b, b.width);
    });
    return result;
}

template std::vector<Gap<2>> find_gaps(const FacetTree<2>&, const GapOptions<2>&);
template std::vector<Gap<3>> find_gaps(const FacetTree<3>&, const GapOptions<3>&);

}  // namespace abut::tool
