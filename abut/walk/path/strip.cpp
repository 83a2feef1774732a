#include <abut/math/assert.hpp>
#include <abut/walk/path/strip.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {
namespace {

/// Converts a place on a side to the neighbour.
WalkPoint beyond(const WalkPoint& place, std::uint32_t side, const WalkLink& link) {
    const auto weight = [&](std::uint32_t corner) { return place.weights[static_cast<glm::length_t>(corner)]; };
    const std::uint32_t start = link.mirrored() ? link.side() : next_corner(link.side());
    const std::uint32_t end = link.mirrored() ? next_corner(link.side()) : link.side();
    WalkPoint result{link.triangle(), Vec3(0.0f)};
    result.weights[static_cast<glm::length_t>(start)] = weight(side);
    result.weights[static_cast<glm::length_t>(end)] = weight(next_corner(side));
    return result;
}

bool is_on(const WalkPoint& place, std::uint32_t side) {
    return place.weights[static_cast<glm::length_t>(next_corner(next_corner(side)))] == 0;
}

}  // namespace

WalkPathRules::WalkPathRules(const WalkMeshData& mesh_data, const WalkPathOptions& path_options)
    : data(mesh_data), options(path_options) {
    for (const float each : options.area_costs) {
        const bool open = each > 0 && each <= std::numeric_limits<float>::max();
        ABUT_ASSERT(open || each == std::numeric_limits<float>::infinity());
        has_closed_areas = has_closed_areas || !open;
        uniform_cost = uniform_cost && (!open || each == 1.0f);
    }
}

double WalkPathRules::min_cost() const {
    double result = options.area_costs.size() < 256 ? 1.0 : std::numeric_limits<double>::max();
    for (const float each : options.area_costs)
        if (each > 0) result = std::min(result, static_cast<double>(each));
    return result;
}

void trim(const WalkMeshData& data, WalkStrip& strip) {
    std::size_t first = 0, last = strip.sides.size();
    while (first < last && is_on(strip.from, strip.sides[first].side)) {
        const WalkSide side = strip.sides[first++];
        strip.from = beyond(strip.from, side.side, data.walk[side.triangle].link[side.side]);
    }
    while (first < last) {
        const WalkSide side = strip.sides[last - 1];
        const WalkLink link = data.walk[side.triangle].link[side.side];
        if (!is_on(strip.to, link.side())) break;
        strip.to = beyond(strip.to, link.side(), WalkLink::to(side.triangle, side.side, link.mirrored()));
        --last;
    }
    strip.before.insert(strip.before.end(), strip.sides.begin(),
                        strip.sides.begin() + static_cast<std::ptrdiff_t>(first));
    strip.after.insert(strip.after.begin(), strip.sides.begin() + static_cast<std::ptrdiff_t>(last), strip.sides.end());
    strip.sides.erase(strip.sides.begin() + static_cast<std::ptrdiff_t>(last), strip.sides.end());
    strip.sides.erase(strip.sides.begin(), strip.sides.begin() + static_cast<std::ptrdiff_t>(first));
}

void add_side(const WalkMeshData& data, std::vector<WalkSide>& sides, const WalkSide& side) {
    if (!sides.empty()) {
        const WalkLink link = data.walk[sides.back().triangle].link[sides.back().side];
        if (link.triangle() == side.triangle && link.side() == side.side) {
            sides.pop_back();
            return;
        }
    }
    sides.push_back(side);
}

void unfold(const WalkMeshData& data, const WalkStrip& strip, WalkUnfolded& result) {
    result.portals.clear();
    result.mirrored.assign(1, false);
    const WalkFrame start(data.walk[strip.from.triangle]);
    DVec<2> corner[3] = {start.corner(0), start.corner(1), start.corner(2)};
    const auto placed = [&](const WalkPoint& place) {
        const WalkWeights weights = normalised_weights(place.weights);
        return corner[0] + (corner[1] - corner[0]) * weights.second + (corner[2] - corner[0]) * weights.third;
    };
    result.from = placed(strip.from);
    result.first = result.last = corner[2];
    bool mirrored = false;
    std::uint32_t entered = 3;
    for (const WalkSide& side : strip.sides) {
        WalkPortal portal;
        if (entered == 3) {
            portal.left = corner[left_leaving(side.side, false)];
            portal.right = corner[side.side];
            result.first = corner[next_corner(next_corner(side.side))];
        } else {
            // The side after the entered one shares its right end; in an upside-down triangle, its left end.
            const WalkPortal& last = result.portals.back();
            portal.new_left = (side.side == next_corner(entered)) != mirrored;
            portal.left = portal.new_left ? result.last : last.left;
            portal.right = portal.new_left ? last.right : result.last;
        }
        result.portals.push_back(portal);
        const WalkTriangle& walk = data.walk[side.triangle];
        result.last = beyond_side(walk, side.side, mirrored, portal.left, portal.right);
        const WalkLink link = walk.link[side.side];
        mirrored = mirrored != link.mirrored();
        entered = link.side();
        result.mirrored.push_back(mirrored);
    }
    if (entered < 3) {
        const std::uint32_t left = left_entering(entered, mirrored);
        corner[left] = result.portals.back().left;
        corner[left == entered ? next_corner(entered) : entered] = result.portals.back().right;
        corner[next_corner(next_corner(entered))] = result.last;
    }
    result.to = placed(strip.to);
}

WalkPoint point_on_portal(const WalkMeshData& data, const WalkStrip& strip, const WalkUnfolded& plane,
                          std::uint32_t portal, double fraction, bool beyond) {
    const WalkSide& side = strip.sides[portal];
    const WalkLink link = data.walk[side.triangle].link[side.side];
    const std::uint32_t of = beyond ? link.side() : side.side;
    const std::uint32_t left =
        beyond ? left_entering(of, plane.mirrored[portal + 1]) : left_leaving(of, plane.mirrored[portal]);
    return {beyond ? link.triangle() : side.triangle, weights_on_side(of, left == of ? fraction : 1 - fraction)};
}

WalkCorner corner_of(const WalkUnfolded& plane, std::uint32_t portal, bool left) {
    WalkCorner result{left ? plane.portals[portal].left : plane.portals[portal].right, left, portal, portal};
    while (result.first > 0 && plane.portals[result.first].new_left != left) --result.first;
    while (result.last + 1 < plane.portals.size() && plane.portals[result.last + 1].new_left != left) ++result.last;
    return result;
}

void Funnel::add(const DVec<2>& point, std::uint32_t portal, bool left) {
    // Written for the left side; on the right all orientations are reversed.
    const double sign = left ? 1 : -1;
    const std::size_t step = left ? std::size_t{1} : ~std::size_t{0};  // towards the apex, and on along the other side
    std::size_t& end = left ? front_ : back_;
    const std::size_t other_end = left ? back_ : front_;
    // If the point is a corner of the funnel itself, these orientations are rounding: no path goes to the other side of
    // a portal and back.
    constexpr double tolerance = 1e-12;
    const auto is_cut = [&](const DVec<2>& to_end, const DVec<2>& on) {
        return sign * cross(to_end, on) <= tolerance * std::max(-dot(to_end, on), 0.0);
    };
    const auto is_beyond = [&](const DVec<2>& edge, const DVec<2>& there) {
        return sign * cross(edge, there) < -tolerance * dot(edge, edge);
    };
    while (end != apex_ && is_cut(at(end) - at(end + step), point - at(end))) end += step;
    if (end == apex_) {
        while (apex_ != other_end && is_beyond(at(apex_ + step) - at(apex_), point - at(apex_))) apex_ += step;
        end = apex_;
    }
    points_[count_] = {point, portal, chain_[end], left};
    end -= step;
    chain_[end] = count_++;
}

void Funnel::pull(const std::vector<WalkPortal>& portals, std::uint32_t first, std::uint32_t last, const DVec<2>& from,
                  const DVec<2>& to, std::vector<WalkKnot>& knots) {
    const std::size_t count = last - first;
    points_.resize(2 * count + 5);
    chain_.resize(2 * count + 5);
    front_ = apex_ = back_ = count + 2;
    points_[0] = {from, first, 0, false};
    count_ = 1;
    chain_[apex_] = 0;
    for (std::uint32_t i = first; i < last; ++i) {
        const WalkPortal& portal = portals[i];
        if (i == first || portal.new_left) add(portal.left, i, true);
        if (i == first || !portal.new_left) add(portal.right, i, false);
    }
    add(to, last, true);
    const std::size_t before = knots.size();
    for (std::uint32_t i = points_[count_ - 1].parent; i != 0; i = points_[i].parent) {
        const Point& point = points_[i];
        WalkKnot knot{point.at, point.left ? WalkKnot::Kind::left : WalkKnot::Kind::right, point.portal, point.portal,
                      point.left ? 0.0 : 1.0};
        while (knot.last + 1 < last && portals[knot.last + 1].new_left != point.left) ++knot.last;
        knots.push_back(knot);
    }
    std::reverse(knots.begin() + static_cast<std::ptrdiff_t>(before), knots.end());
}

}  // namespace abut::detail
