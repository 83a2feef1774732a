#include "tool/faults/gaps.hpp"

#include "tool/faults/necks.hpp"
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <tuple>

namespace abut::tool {

using namespace detail;

namespace {

constexpr int max_steps = 256;
// Relative to a neck's width: the step along a passage, and the tolerated decrease in width.
constexpr double step = 0.5, max_narrowing = 0.01;

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

// True if the passage opens in a direction, as gaps.hpp defines. A passage that exceeds the step limit counts as open.
template <int D>
bool opens(const FacetTree<D>& facets, const Neck<D>& neck, DVec<D> direction, double width) {
    DVec<D> position = neck.middle, across = neck.across;
    const double stride = step * neck.width;
    for (int i = 0; i < max_steps; ++i) {
        if (facets.first_hit(position, direction, stride)) return false;
        const DVec<D> next = position + direction * stride;
        const auto reach = [&](const DVec<D>& towards) {
            const auto hit = facets.first_hit(next, towards, width);
            return hit ? hit->distance : width;
        };
        const double before = reach(-across), behind = reach(across);
        if (before + behind >= width) return true;
        if (before + behind < neck.width * (1 - max_narrowing)) return false;
        const DVec<D> middle = next + across * (0.5 * (behind - before));
        direction = normalized(middle - position);
        across = normalized(across - direction * dot(across, direction));
        position = middle;
    }
    return true;
}

template <int D>
bool is_passage(const FacetTree<D>& facets, const Neck<D>& neck, double width) {
    for (const DVec<D>& direction : directions(neck.along))
        if (opens<D>(facets, neck, direction, width) && opens<D>(facets, neck, -direction, width)) return true;
    return false;
}

}  // namespace

template <int D>
std::vector<Gap<D>> find_gaps(const FacetTree<D>& facets, const GapOptions<D>& options) {
    std::vector<Neck<D>> necks = find_necks(facets, options);
    std::erase_if(necks, [&](const Neck<D>& neck) { return !is_passage(facets, neck, options.width); });
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
                   Vec<D>(neck.middle + half)};
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
