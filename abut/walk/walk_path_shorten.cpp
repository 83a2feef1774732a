#include <abut/walk/walk_path_shorten.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

constexpr int most_rounds = 1000;
/// Angles this close to half a turn are half a turn, and ways this much cheaper are as dear.
constexpr double slack = 1e-10;

std::uint32_t other_side_at(std::uint32_t corner, std::uint32_t side) {
    return side == corner ? next_corner(next_corner(corner)) : corner;
}

/// The end of a portal that a knot is, and all the portals that have it.
struct Corner {
    DVec<2> at;
    bool left = false;
    std::uint32_t first = 0, last = 0;
};

Corner corner_of(const WalkUnfolded& plane, std::uint32_t portal, bool left) {
    Corner result{left ? plane.portals[portal].left : plane.portals[portal].right, left, portal, portal};
    while (result.first > 0 && plane.portals[result.first].new_left != left) --result.first;
    while (result.last + 1 < plane.portals.size() && plane.portals[result.last + 1].new_left != left) ++result.last;
    return result;
}

/// The triangles round a corner on the side of it that the strip is not on.
class OtherSide {
public:
    OtherSide(const WalkPathRules& rules, const WalkTaut& way, const Corner& corner)
        : rules_(rules), way_(way), corner_(corner) {}

    /// The sides to cross, from the first of the strip's triangles at the corner to the last. False where there is a
    /// border, or an edge that may not be crossed; and, where asked, where it is half a turn wide or more between the
    /// two directions.
    bool sides(std::vector<WalkSide>& result, const DVec<2>* before, const DVec<2>* after) const {
        result.clear();
        const std::vector<WalkSide>& strip = way_.strip.sides;
        const WalkMeshData& data = rules_.data;
        WalkSide side = strip[corner_.first];
        bool mirrored = way_.plane.mirrored[corner_.first];
        const bool starts_left = left_leaving(side.side, mirrored) == side.side;
        side.side = other_side_at(starts_left == corner_.left ? side.side : next_corner(side.side), side.side);
        const WalkLink out = link(strip[corner_.last]);
        const std::uint32_t left_out = left_entering(out.side(), way_.plane.mirrored[corner_.last + 1]);
        const bool out_starts_left = left_out == out.side();
        const WalkSide end{
            out.triangle(),
            other_side_at(out_starts_left == corner_.left ? out.side() : next_corner(out.side()), out.side())};

        DVec<2> ray = first_ray();
        for (std::size_t i = 0; i <= data.walk.size(); ++i) {
            if (before != nullptr && !is_less_than_half(*before, ray - corner_.at)) return false;
            const WalkLink beyond = link(side);
            if (beyond.is_border() || !rules_.may_cross(side, beyond)) return false;
            result.push_back(side);
            if (beyond.triangle() == end.triangle && beyond.side() == end.side)
                return before == nullptr || is_less_than_half(*before, turned(*after, ray));
            // The corner is to the right of this way where it was to the left of the other.
            ray = beyond_side(data.walk[side.triangle], side.side, mirrored, corner_.left ? ray : corner_.at,
                              corner_.left ? corner_.at : ray);
            mirrored = mirrored != beyond.mirrored();
            const bool entered_left = left_entering(beyond.side(), mirrored) == beyond.side();
            side = {beyond.triangle(),
                    other_side_at(entered_left != corner_.left ? beyond.side() : next_corner(beyond.side()),
                                  beyond.side())};
        }
        return false;
    }

private:
    WalkLink link(const WalkSide& side) const { return rules_.data.walk[side.triangle].link[side.side]; }

    DVec<2> end_of(std::size_t portal) const {
        return corner_.left ? way_.plane.portals[portal].left : way_.plane.portals[portal].right;
    }
    /// The end of the side that is crossed first.
    DVec<2> first_ray() const { return corner_.first > 0 ? end_of(corner_.first - 1) : way_.plane.first; }
    /// A direction in the last triangle, as this way round comes to it.
    DVec<2> turned(const DVec<2>& direction, const DVec<2>& ray) const {
        const DVec<2> was =
            (corner_.last + 1 < way_.plane.portals.size() ? end_of(corner_.last + 1) : way_.plane.last) - corner_.at;
        const DVec<2> is = ray - corner_.at;
        const double cosine = dot(was, is), sine = cross(was, is);
        return {cosine * direction.x - sine * direction.y, sine * direction.x + cosine * direction.y};
    }
    /// Of two directions of which the second is less than one and a half turns on.
    bool is_less_than_half(const DVec<2>& from, const DVec<2>& to) const {
        const double sine = (corner_.left ? -1 : 1) * cross(from, to);
        const double least = slack * std::sqrt(dot(from, from) * dot(to, to));
        return sine > least || (sine >= -least && dot(from, to) > 0);
    }

    const WalkPathRules& rules_;
    const WalkTaut& way_;
    const Corner corner_;
};

class Tightener {
public:
    Tightener(const WalkPathRules& rules, WalkStrip strip) : rules_(rules) {
        way_.strip = std::move(strip);
        pull(way_);
    }

    WalkTaut run() {
        for (int round = 0; round < most_rounds; ++round) {
            WalkTaut next;
            if (!flip_all(next)) break;
            pull(next);
            if (!(next.cost < way_.cost)) break;
            std::swap(way_, next);
        }
        return std::move(way_);
    }

private:
    void pull(WalkTaut& way) {
        trim(rules_.data, way.strip);
        unfold(rules_.data, way.strip, way.plane);
        way.knots.assign(1, {way.plane.from, WalkKnot::Kind::end, 0, 0});
        const auto count = static_cast<std::uint32_t>(way.plane.portals.size());
        funnel_.pull(way.plane.portals, 0, count, way.plane.from, way.plane.to, way.knots);
        way.knots.push_back({way.plane.to, WalkKnot::Kind::end, count, count});
        way.cost = 0;
        for (std::size_t i = 1; i < way.knots.size(); ++i) way.cost += length(way.knots[i].at - way.knots[i - 1].at);
    }

    /// Round the other side of every corner where that is shorter, but for those next to one another.
    bool flip_all(WalkTaut& next) {
        next.strip = {way_.strip.from, way_.strip.to, {}};
        std::vector<WalkSide>& sides = next.strip.sides;
        std::size_t copied = 0;
        bool any = false;
        for (std::size_t i = 1; i + 1 < way_.knots.size(); ++i) {
            const WalkKnot& knot = way_.knots[i];
            const Corner corner = corner_of(way_.plane, knot.first, knot.kind == WalkKnot::Kind::left);
            if (corner.first < copied) continue;
            const DVec<2> before = way_.knots[i - 1].at - knot.at, after = way_.knots[i + 1].at - knot.at;
            if (!OtherSide(rules_, way_, corner).sides(round_, &before, &after)) continue;
            for (; copied < corner.first; ++copied) add_side(rules_.data, sides, way_.strip.sides[copied]);
            for (const WalkSide& side : round_) add_side(rules_.data, sides, side);
            copied = corner.last + 1;
            any = true;
        }
        for (; copied < way_.strip.sides.size(); ++copied) add_side(rules_.data, sides, way_.strip.sides[copied]);
        return any;
    }

    const WalkPathRules& rules_;
    WalkTaut way_;
    WalkFunnel funnel_;
    std::vector<WalkSide> round_;
};

}  // namespace

WalkTaut pulled_tight(const WalkPathRules& rules, WalkStrip strip) {
    return Tightener(rules, std::move(strip)).run();
}

}  // namespace abut
