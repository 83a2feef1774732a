#include <abut/walk/walk_path_flip.hpp>
#include <abut/walk/walk_path_pull.hpp>
#include <abut/walk/walk_path_shorten.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

constexpr int most_rounds = 1000;
constexpr int most_passes = 64;
/// Triangles of a part of the way that is tried round all the corners beside it.
constexpr std::uint32_t most_tried = 64;
/// Ways cheaper by less are as dear.
constexpr double least_gain = 1e-9;

void add_sides(const WalkMeshData& data, std::vector<WalkSide>& sides, const std::vector<WalkSide>& more,
               std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) add_side(data, sides, more[i]);
}
void add_sides(const WalkMeshData& data, std::vector<WalkSide>& sides, const std::vector<WalkSide>& more) {
    add_sides(data, sides, more, 0, more.size());
}

class Tightener {
public:
    explicit Tightener(const WalkPathRules& rules) : rules_(rules), puller_(rules) {}

    WalkTaut& run(WalkStrip strip) {
        way_.strip = std::move(strip);
        puller_.pull(way_);
        settle();
        return way_;
    }

    /// Round corners that it doesn't turn at, or that the cost changes at.
    void improve(Tightener& scratch) {
        for (int pass = 0; pass < most_passes; ++pass) {
            WalkTaut next;
            next.strip = emptied();
            if (!(rules_.alike ? try_beside(scratch, next.strip) : try_touched(scratch, next.strip))) return;
            puller_.pull(next);
            if (!(next.cost < way_.cost)) return;
            std::swap(way_, next);
            settle();
        }
    }

private:
    /// How much is led round at once. There may be many corners in a row of which the way touches but one.
    enum class Reach : std::uint8_t {
        corner,  ///< that the way turns at
        row,     ///< also those on its hand, up to a straight line between where it turns before and after
        run,     ///< those on both hands, up to a straight line past all the next corners that it may be led round
    };
    /// Round the other side of corners until it turns at none where that is shorter; by as many as helps.
    void settle() {
        Reach most = Reach::run, reach = most;
        for (int round = 0; rules_.alike && round < most_rounds; ++round) {
            next_.strip = emptied();
            const bool any = flip_all(next_.strip.sides, reach);
            if (any) puller_.pull(next_);
            if (any && next_.cost < way_.cost) {
                std::swap(way_, next_);
                reach = most;
            } else if (reach == Reach::run) {
                most = reach = Reach::row;
            } else if (reach == Reach::row && any) {
                reach = Reach::corner;
            } else {
                return;
            }
        }
    }
    WalkStrip emptied() const { return {way_.strip.from, way_.strip.to, {}, way_.strip.before, way_.strip.after}; }

    bool may_flip(std::size_t i) {
        const DVec<2> at = way_.knots[i].at, before = way_.knots[i - 1].at - at, after = way_.knots[i + 1].at - at;
        return find_other_side(rules_, way_, corner_at(i), round_, &before, &after);
    }
    WalkCorner corner_at(std::size_t knot) const {
        return corner_of(way_.plane, way_.knots[knot].first, way_.knots[knot].kind == WalkKnot::Kind::left);
    }

    /// Where the surface on the other side is less than half a turn wide, but for corners next to one another.
    bool flip_all(std::vector<WalkSide>& sides, Reach reach) {
        std::uint32_t copied = 0;
        bool any = false;
        const auto flip = [&](const WalkCorner& corner) {
            add_sides(rules_.data, sides, way_.strip.sides, copied, corner.first);
            add_sides(rules_.data, sides, round_);
            copied = corner.last + 1;
            any = true;
        };
        for (std::size_t i = 1; i + 1 < way_.knots.size(); ++i) {
            const WalkCorner corner = corner_at(i);
            if (corner.first < copied || !may_flip(i)) continue;
            if (reach == Reach::corner) {
                flip(corner);
                continue;
            }
            const std::size_t before = i - 1;
            while (reach == Reach::run && i + 2 < way_.knots.size() && may_flip(i + 1)) ++i;
            const WalkKnot &last = way_.knots[before], &next = way_.knots[i + 1];
            const DVec<2> straight = next.at - last.at;
            const std::uint32_t start = std::min(before == 0 ? 0 : last.last + 1, corner.first);
            for (std::uint32_t p = std::max(copied, start); p < std::max(next.first, corner.first + 1); ++p) {
                const bool is_knot = reach == Reach::row && p == corner.first;
                const bool left = reach == Reach::row ? corner.left : way_.plane.portals[p].new_left;
                if (!is_knot && way_.plane.portals[p].new_left != left) continue;
                const WalkCorner beside = corner_of(way_.plane, p, left);
                if (beside.first < copied) continue;
                const double side = cross(straight, beside.at - last.at);
                const bool is_between = beside.first == p && beside.last < next.first && (left ? side <= 0 : side >= 0);
                if ((is_knot || is_between) && find_other_side(rules_, way_, beside, round_)) flip(beside);
            }
        }
        add_sides(rules_.data, sides, way_.strip.sides, copied, way_.strip.sides.size());
        return any;
    }

    /// The part of the way between two of its knots.
    struct Part {
        std::uint32_t first = 0, last = 0;  ///< its portals; one more
        WalkStrip strip;                    ///< without sides
        double cost = 0;
    };
    Part part(std::size_t from, std::size_t to) const {
        const WalkKnot &a = way_.knots[from], &b = way_.knots[to];
        Part result;
        result.first = from == 0 ? 0 : a.last + 1;
        result.last = b.first;
        result.strip.from =
            from == 0 ? way_.strip.from : place_on(rules_.data, way_.strip, way_.plane, a.last, a.share, true);
        result.strip.to = to + 1 == way_.knots.size()
                              ? way_.strip.to
                              : place_on(rules_.data, way_.strip, way_.plane, b.first, b.share, false);
        return result;
    }
    /// The part led round the other side of a corner, where that is cheaper.
    bool try_part(Tightener& scratch, const Part& part, const WalkCorner& corner, double cost,
                  std::vector<WalkSide>& result) {
        WalkStrip strip = part.strip;
        add_sides(rules_.data, strip.sides, way_.strip.sides, part.first, corner.first);
        add_sides(rules_.data, strip.sides, round_);
        add_sides(rules_.data, strip.sides, way_.strip.sides, corner.last + 1, part.last);
        const WalkTaut& found = scratch.run(std::move(strip));
        if (!(found.cost < cost * (1 - least_gain))) return false;
        add_sides(rules_.data, result, found.strip.before);
        add_sides(rules_.data, result, found.strip.sides);
        add_sides(rules_.data, result, found.strip.after);
        return true;
    }

    /// Corners that the way passes by. Those far from where it turns only where the angle between these two places is
    /// less on the other side.
    bool try_beside(Tightener& scratch, WalkStrip& next) {
        bool any = false;
        std::uint32_t copied = 0;
        for (std::size_t i = 0; i + 1 < way_.knots.size(); ++i) {
            const Part straight = part(i, i + 1);
            if (straight.first < copied) continue;
            const std::size_t from = i > 0 && part(i - 1, i).first >= copied ? i - 1 : i;
            const std::size_t to = std::min(i + 2, way_.knots.size() - 1);
            const Part around = part(from, to);
            double cost = 0;
            for (std::size_t k = from; k < to; ++k) cost += puller_.cost(way_, k);
            const bool is_short = around.last - around.first <= most_tried;
            bool found = false;
            for (std::uint32_t p = straight.first; p < straight.last && !found; ++p) {
                const WalkCorner corner = corner_of(way_.plane, p, way_.plane.portals[p].new_left);
                if (corner.first != p || corner.last >= straight.last) continue;
                const DVec<2> before = way_.knots[i].at - corner.at, after = way_.knots[i + 1].at - corner.at;
                double product = 0;
                if (!find_other_side(rules_, way_, corner, round_, &before, &after, &product)) continue;
                if (!is_short && !(product > dot(before, after))) continue;
                std::vector<WalkSide> sides;
                found = try_part(scratch, around, corner, cost, sides);
                if (!found) continue;
                add_sides(rules_.data, next.sides, way_.strip.sides, copied, around.first);
                add_sides(rules_.data, next.sides, sides);
                copied = around.last;
            }
            any = any || found;
        }
        add_sides(rules_.data, next.sides, way_.strip.sides, copied, way_.strip.sides.size());
        return any;
    }

    /// Corners that the way touches.
    bool try_touched(Tightener& scratch, WalkStrip& next) {
        bool any = false;
        std::uint32_t copied = 0;
        for (std::size_t i = 1; i + 1 < way_.knots.size(); ++i) {
            const WalkKnot& knot = way_.knots[i];
            if (knot.share != 0 && knot.share != 1) continue;
            const WalkCorner corner = corner_of(way_.plane, knot.first, knot.share == 0);
            std::size_t from = i - 1, to = i + 1;
            while (from > 0 && way_.knots[from].last + 1 > corner.first) --from;
            while (to + 1 < way_.knots.size() && way_.knots[to].first < corner.last + 1) ++to;
            from -= from > 0;
            to += to + 1 < way_.knots.size();
            const Part around = part(from, to);
            if (around.first < copied || around.first > corner.first || around.last < corner.last + 1) continue;
            if (!find_other_side(rules_, way_, corner, round_)) continue;
            double cost = 0;
            for (std::size_t k = from; k < to; ++k) cost += puller_.cost(way_, k);
            std::vector<WalkSide> sides;
            if (!try_part(scratch, around, corner, cost, sides)) continue;
            add_sides(rules_.data, next.sides, way_.strip.sides, copied, around.first);
            add_sides(rules_.data, next.sides, sides);
            copied = around.last;
            any = true;
        }
        add_sides(rules_.data, next.sides, way_.strip.sides, copied, way_.strip.sides.size());
        return any;
    }

    const WalkPathRules& rules_;
    WalkPuller puller_;
    WalkTaut way_, next_;
    std::vector<WalkSide> round_;
};

}  // namespace

WalkTaut pulled_tight(const WalkPathRules& rules, WalkStrip strip) {
    Tightener tightener(rules), scratch(rules);
    WalkTaut& way = tightener.run(std::move(strip));
    tightener.improve(scratch);
    return std::move(way);
}

}  // namespace abut
