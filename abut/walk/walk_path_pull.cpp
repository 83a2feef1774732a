#include <abut/walk/walk_path_pull.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

constexpr int most_rounds = 64;
constexpr double least_gain = 1e-12;

}  // namespace

double cheapest_share(const WalkPortal& portal, const DVec<2>& from, double cost_from, const DVec<2>& to,
                      double cost_to, int halvings) {
    // Crossings this close to an end of their portal are there.
    constexpr double least_share = 1e-9;
    const DVec<2> along = portal.right - portal.left;
    const auto slope = [&](double share) {
        const DVec<2> at = portal.left + along * share;
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
    const double share = 0.5 * (low + high);
    return share < least_share ? 0.0 : (share > 1 - least_share ? 1.0 : share);
}

double WalkPuller::cost(const WalkTaut& way, std::size_t knot) const {
    const WalkKnot& a = way.knots[knot];
    const double piece = length(way.knots[knot + 1].at - a.at);
    if (rules_.alike) return piece;
    const std::uint32_t triangle = knot == 0 ? 0 : a.last + 1;
    const WalkMeshData& data = rules_.data;
    if (triangle == 0) return piece * rules_.cost(data.walk[way.strip.from.triangle]);
    const WalkSide& side = way.strip.sides[triangle - 1];
    return piece * rules_.cost(data.walk[data.walk[side.triangle].link[side.side].triangle()]);
}

void WalkPuller::pull_once(WalkTaut& way) {
    const std::vector<WalkPortal>& portals = way.plane.portals;
    const auto count = static_cast<std::uint32_t>(portals.size());
    way.knots.assign(1, {way.plane.from, WalkKnot::Kind::end, 0, 0, 0});
    std::uint32_t first = 0;
    for (const Crossing& crossing : crossings_) {
        const WalkPortal& portal = portals[crossing.portal];
        const DVec<2> at = portal.left + (portal.right - portal.left) * crossing.share;
        const DVec<2> from = way.knots.back().at;
        funnel_.pull(portals, first, crossing.portal, from, at, way.knots);
        way.knots.push_back({at, WalkKnot::Kind::crossing, crossing.portal, crossing.portal, crossing.share});
        first = crossing.portal + 1;
    }
    const DVec<2> from = way.knots.back().at;
    funnel_.pull(portals, first, count, from, way.plane.to, way.knots);
    way.knots.push_back({way.plane.to, WalkKnot::Kind::end, count, count, 0});
    way.cost = 0;
    for (std::size_t i = 0; i + 1 < way.knots.size(); ++i) way.cost += cost(way, i);
}

void WalkPuller::find_crossings(const WalkTaut& way) {
    crossings_.clear();
    const WalkMeshData& data = rules_.data;
    double before = rules_.cost(data.walk[way.strip.from.triangle]);
    std::size_t knot = 1;
    for (std::uint32_t i = 0; i < way.strip.sides.size(); ++i) {
        const WalkSide& side = way.strip.sides[i];
        const double after = rules_.cost(data.walk[data.walk[side.triangle].link[side.side].triangle()]);
        while (knot + 1 < way.knots.size() && way.knots[knot].last < i) ++knot;
        if (after != before) {
            const WalkKnot& to = way.knots[knot];
            const double share =
                to.first <= i ? to.share : crossed_at(way.plane.portals[i], way.knots[knot - 1].at, to.at);
            crossings_.push_back({i, share, before, after});
        }
        before = after;
    }
}

void WalkPuller::move_crossings(const WalkTaut& way) {
    std::size_t knot = 0;
    DVec<2> from(0.0);
    for (Crossing& crossing : crossings_) {
        const std::size_t last = knot;
        while (way.knots[knot].kind != WalkKnot::Kind::crossing || way.knots[knot].first != crossing.portal) ++knot;
        // What was moved before is where it is now.
        if (knot - 1 != last || last == 0) from = way.knots[knot - 1].at;
        const WalkPortal& portal = way.plane.portals[crossing.portal];
        crossing.share = cheapest_share(portal, from, crossing.before, way.knots[knot + 1].at, crossing.after, 48);
        from = portal.left + (portal.right - portal.left) * crossing.share;
    }
}

void WalkPuller::pull(WalkTaut& way) {
    trim(rules_.data, way.strip);
    unfold(rules_.data, way.strip, way.plane);
    crossings_.clear();
    pull_once(way);
    if (rules_.alike) return;
    find_crossings(way);
    if (crossings_.empty()) return;
    pull_once(way);
    best_ = crossings_;
    double best = way.cost;
    int idle = 0;
    for (int round = 0; round < most_rounds && idle < 3; ++round) {
        move_crossings(way);
        pull_once(way);
        idle = way.cost < best * (1 - least_gain) ? 0 : idle + 1;
        if (way.cost < best) {
            best = way.cost;
            best_ = crossings_;
        }
    }
    crossings_ = best_;
    pull_once(way);
}

}  // namespace abut
