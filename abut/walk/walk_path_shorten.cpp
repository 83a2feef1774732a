#include <abut/walk/walk_path_flip.hpp>
#include <abut/walk/walk_path_shorten.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

constexpr int most_rounds = 1000;
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
            const WalkCorner corner = corner_of(way_.plane, knot.first, knot.kind == WalkKnot::Kind::left);
            if (corner.first < copied) continue;
            const DVec<2> before = way_.knots[i - 1].at - knot.at, after = way_.knots[i + 1].at - knot.at;
            if (!find_other_side(rules_, way_, corner, round_, &before, &after)) continue;
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
