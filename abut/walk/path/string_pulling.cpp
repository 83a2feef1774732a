#include <abut/walk/path/string_pulling.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

constexpr int max_rounds = 64;
constexpr double min_gain = 1e-12;

}  // namespace

double cheapest_fraction(const WalkPortal& portal, const DVec<2>& from, double cost_from, const DVec<2>& to,
                         double cost_to, int halvings) {
    // Crossings this close to an end of their portal are moved to it.
    constexpr double min_fraction = 1e-9;
    const DVec<2> along = portal.right - portal.left;
    const auto slope = [&](double fraction) {
        const DVec<2> at = portal.left + along * fraction;
        const double a = length(at - from), b = length(at - to);
        return (a > 0 ? cost_from * dot(at - from, along) / a : 0.0) +
               (b > 0 ? cost_to * dot(at - to, along) / b : 0.0);
    };
    if (slope(0) >= 0) return 0;
    if (slope(1) <= 0) return 1;
    double low = 0, high = 1;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(middle) < 0 ? low : high) = middle;
    }
    const double fraction = 0.5 * (low + high);
    return fraction < min_fraction ? 0.0 : (fraction > 1 - min_fraction ? 1.0 : fraction);
}

double StringPuller::cost(const WalkTautPath& path, std::size_t knot) const {
    const WalkKnot& a = path.knots[knot];
    const double piece = length(path.knots[knot + 1].at - a.at);
    if (rules_.uniform_cost) return piece;
    const std::uint32_t triangle = knot == 0 ? 0 : a.last + 1;
    const WalkMeshData& data = rules_.data;
    if (triangle == 0) return piece * rules_.cost(data.walk[path.strip.from.triangle]);
    const WalkSide& side = path.strip.sides[triangle - 1];
    return piece * rules_.cost(data.walk[data.walk[side.triangle].link[side.side].triangle()]);
}

void StringPuller::pull_once(WalkTautPath& path) {
    const std::vector<WalkPortal>& portals = path.plane.portals;
    const auto count = static_cast<std::uint32_t>(portals.size());
    path.knots.assign(1, {path.plane.from, WalkKnot::Kind::end, 0, 0, 0});
    std::uint32_t first = 0;
    for (const Crossing& crossing : crossings_) {
        const WalkPortal& portal = portals[crossing.portal];
        const DVec<2> at = portal.left + (portal.right - portal.left) * crossing.fraction;
        const DVec<2> from = path.knots.back().at;
        funnel_.pull(portals, first, crossing.portal, from, at, path.knots);
        path.knots.push_back({at, WalkKnot::Kind::crossing, crossing.portal, crossing.portal, crossing.fraction});
        first = crossing.portal + 1;
    }
    const DVec<2> from = path.knots.back().at;
    funnel_.pull(portals, first, count, from, path.plane.to, path.knots);
    path.knots.push_back({path.plane.to, WalkKnot::Kind::end, count, count, 0});
    path.cost = 0;
    for (std::size_t i = 0; i + 1 < path.knots.size(); ++i) path.cost += cost(path, i);
}

void StringPuller::find_crossings(const WalkTautPath& path) {
    crossings_.clear();
    const WalkMeshData& data = rules_.data;
    double before = rules_.cost(data.walk[path.strip.from.triangle]);
    std::size_t knot = 1;
    for (std::uint32_t i = 0; i < path.strip.sides.size(); ++i) {
        const WalkSide& side = path.strip.sides[i];
        const double after = rules_.cost(data.walk[data.walk[side.triangle].link[side.side].triangle()]);
        while (knot + 1 < path.knots.size() && path.knots[knot].last < i) ++knot;
        if (after != before) {
            const WalkKnot& to = path.knots[knot];
            const double fraction =
                to.first <= i ? to.fraction : crossing_fraction(path.plane.portals[i], path.knots[knot - 1].at, to.at);
            crossings_.push_back({i, fraction, before, after});
        }
        before = after;
    }
}

void StringPuller::move_crossings(const WalkTautPath& path) {
    std::size_t knot = 0;
    DVec<2> from(0.0);
    for (Crossing& crossing : crossings_) {
        const std::size_t last = knot;
        while (path.knots[knot].kind != WalkKnot::Kind::crossing || path.knots[knot].first != crossing.portal) ++knot;
        // If the previous crossing was moved, the new position counts.
        if (knot - 1 != last || last == 0) from = path.knots[knot - 1].at;
        const WalkPortal& portal = path.plane.portals[crossing.portal];
        crossing.fraction =
            cheapest_fraction(portal, from, crossing.before, path.knots[knot + 1].at, crossing.after, 48);
        from = portal.left + (portal.right - portal.left) * crossing.fraction;
    }
}

void StringPuller::pull(WalkTautPath& path) {
    trim(rules_.data, path.strip);
    unfold(rules_.data, path.strip, path.plane);
    crossings_.clear();
    pull_once(path);
    if (rules_.uniform_cost) return;
    find_crossings(path);
    if (crossings_.empty()) return;
    pull_once(path);
    best_ = crossings_;
    double best = path.cost;
    int rounds_without_gain = 0;
    for (int round = 0; round < max_rounds && rounds_without_gain < 3; ++round) {
        move_crossings(path);
        pull_once(path);
        rounds_without_gain = path.cost < best * (1 - min_gain) ? 0 : rounds_without_gain + 1;
        if (path.cost < best) {
            best = path.cost;
            best_ = crossings_;
        }
    }
    crossings_ = best_;
    pull_once(path);
}

}  // namespace abut::detail
