#include <abut/walk/path/corner_flip.hpp>
#include <abut/walk/path/shorten.hpp>
#include <abut/walk/path/string_pulling.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

constexpr int max_shortening_rounds = 1000;
constexpr int max_passes = 64;
/// Maximum number of triangles of a part for which flips around all adjacent corners are tried.
constexpr std::uint32_t max_triangles_tried = 64;
/// Smaller relative gains don't count.
constexpr double min_shortening = 1e-9;

void add_sides(const WalkMeshData& data, std::vector<WalkSide>& sides, const std::vector<WalkSide>& more,
               std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) add_side(data, sides, more[i]);
}
void add_sides(const WalkMeshData& data, std::vector<WalkSide>& sides, const std::vector<WalkSide>& more) {
    add_sides(data, sides, more, 0, more.size());
}

class PathShortener {
public:
    explicit PathShortener(const WalkPathRules& rules) : rules_(rules), string_puller_(rules) {}

    WalkTautPath& run(WalkStrip strip) {
        path_.strip = std::move(strip);
        string_puller_.pull(path_);
        flip_corners();
        return path_;
    }

    /// Tries flips around corners at which the path doesn't bend, or at which the cost changes.
    void improve_by_detours(PathShortener& scratch) {
        for (int pass = 0; pass < max_passes; ++pass) {
            WalkTautPath next;
            next.strip = emptied();
            if (!(rules_.uniform_cost ? try_passed_corners(scratch, next.strip)
                                      : try_touched_corners(scratch, next.strip)))
                return;
            string_puller_.pull(next);
            if (!(next.cost < path_.cost)) return;
            std::swap(path_, next);
            flip_corners();
        }
    }

private:
    /// How many corners are flipped at once. There may be many corners in a row of which the path touches only one.
    enum class FlipScope : std::uint8_t {
        corner,  ///< one at which the path bends
        row,     ///< also those on the same side, up to the straight line between the previous bend and the next
        run,     ///< those on both sides, up to the straight line past all consecutive corners that can be flipped
    };
    /// Flips the path around corners as long as this shortens it, as many at once as possible.
    void flip_corners() {
        FlipScope max_scope = FlipScope::run, scope = max_scope;
        for (int round = 0; rules_.uniform_cost && round < max_shortening_rounds; ++round) {
            next_.strip = emptied();
            const bool any = flip_all(next_.strip.sides, scope);
            if (any) string_puller_.pull(next_);
            if (any && next_.cost < path_.cost) {
                std::swap(path_, next_);
                scope = max_scope;
            } else if (scope == FlipScope::run) {
                max_scope = scope = FlipScope::row;
            } else if (scope == FlipScope::row && any) {
                scope = FlipScope::corner;
            } else {
                return;
            }
        }
    }
    WalkStrip emptied() const { return {path_.strip.from, path_.strip.to, {}, path_.strip.before, path_.strip.after}; }

    bool may_flip(std::size_t i) {
        const DVec<2> at = path_.knots[i].at, before = path_.knots[i - 1].at - at, after = path_.knots[i + 1].at - at;
        return sides_around_corner(rules_, path_, corner_at(i), sides_around_, &before, &after);
    }
    WalkCorner corner_at(std::size_t knot) const {
        return corner_of(path_.plane, path_.knots[knot].first, path_.knots[knot].kind == WalkKnot::Kind::left);
    }

    /// Flips around all corners whose other side has an angle below 180 degrees, except for adjacent ones.
    bool flip_all(std::vector<WalkSide>& sides, FlipScope scope) {
        std::uint32_t copied = 0;
        bool any = false;
        const auto flip = [&](const WalkCorner& corner) {
            add_sides(rules_.data, sides, path_.strip.sides, copied, corner.first);
            add_sides(rules_.data, sides, sides_around_);
            copied = corner.last + 1;
            any = true;
        };
        for (std::size_t i = 1; i + 1 < path_.knots.size(); ++i) {
            const WalkCorner corner = corner_at(i);
            if (corner.first < copied || !may_flip(i)) continue;
            if (scope == FlipScope::corner) {
                flip(corner);
                continue;
            }
            const std::size_t before = i - 1;
            while (scope == FlipScope::run && i + 2 < path_.knots.size() && may_flip(i + 1)) ++i;
            const WalkKnot &last = path_.knots[before], &next = path_.knots[i + 1];
            const DVec<2> straight = next.at - last.at;
            const std::uint32_t start = std::min(before == 0 ? 0 : last.last + 1, corner.first);
            for (std::uint32_t p = std::max(copied, start); p < std::max(next.first, corner.first + 1); ++p) {
                const bool is_knot = scope == FlipScope::row && p == corner.first;
                const bool left = scope == FlipScope::row ? corner.left : path_.plane.portals[p].new_left;
                if (!is_knot && path_.plane.portals[p].new_left != left) continue;
                const WalkCorner beside = corner_of(path_.plane, p, left);
                if (beside.first < copied) continue;
                const double side = cross(straight, beside.at - last.at);
                const bool is_between = beside.first == p && beside.last < next.first && (left ? side <= 0 : side >= 0);
                if ((is_knot || is_between) && sides_around_corner(rules_, path_, beside, sides_around_)) flip(beside);
            }
        }
        add_sides(rules_.data, sides, path_.strip.sides, copied, path_.strip.sides.size());
        return any;
    }

    /// A part of the path between two of its knots.
    struct Part {
        std::uint32_t first = 0, last = 0;  ///< its portals: first and past the last
        WalkStrip strip;                    ///< without sides
        double cost = 0;
    };
    Part part(std::size_t from, std::size_t to) const {
        const WalkKnot &a = path_.knots[from], &b = path_.knots[to];
        Part result;
        result.first = from == 0 ? 0 : a.last + 1;
        result.last = b.first;
        result.strip.from = from == 0
                                ? path_.strip.from
                                : point_on_portal(rules_.data, path_.strip, path_.plane, a.last, a.fraction, true);
        result.strip.to = to + 1 == path_.knots.size()
                              ? path_.strip.to
                              : point_on_portal(rules_.data, path_.strip, path_.plane, b.first, b.fraction, false);
        return result;
    }
    /// Flips a part around a corner. Returns false if that isn't cheaper.
    bool try_part(PathShortener& scratch, const Part& part, const WalkCorner& corner, double cost,
                  std::vector<WalkSide>& result) {
        WalkStrip strip = part.strip;
        add_sides(rules_.data, strip.sides, path_.strip.sides, part.first, corner.first);
        add_sides(rules_.data, strip.sides, sides_around_);
        add_sides(rules_.data, strip.sides, path_.strip.sides, corner.last + 1, part.last);
        const WalkTautPath& found = scratch.run(std::move(strip));
        if (!(found.cost < cost * (1 - min_shortening))) return false;
        add_sides(rules_.data, result, found.strip.before);
        add_sides(rules_.data, result, found.strip.sides);
        add_sides(rules_.data, result, found.strip.after);
        return true;
    }

    /// Tries the corners that the path passes. Far from a bend, only those at which the angle between the adjacent
    /// knots is smaller on the other side.
    bool try_passed_corners(PathShortener& scratch, WalkStrip& next) {
        bool any = false;
        std::uint32_t copied = 0;
        for (std::size_t i = 0; i + 1 < path_.knots.size(); ++i) {
            const Part straight = part(i, i + 1);
            if (straight.first < copied) continue;
            const std::size_t from = i > 0 && part(i - 1, i).first >= copied ? i - 1 : i;
            const std::size_t to = std::min(i + 2, path_.knots.size() - 1);
            const Part around = part(from, to);
            double cost = 0;
            for (std::size_t k = from; k < to; ++k) cost += string_puller_.cost(path_, k);
            const bool is_short = around.last - around.first <= max_triangles_tried;
            bool found = false;
            for (std::uint32_t p = straight.first; p < straight.last && !found; ++p) {
                const WalkCorner corner = corner_of(path_.plane, p, path_.plane.portals[p].new_left);
                if (corner.first != p || corner.last >= straight.last) continue;
                const DVec<2> before = path_.knots[i].at - corner.at, after = path_.knots[i + 1].at - corner.at;
                double product = 0;
                if (!sides_around_corner(rules_, path_, corner, sides_around_, &before, &after, &product)) continue;
                if (!is_short && !(product > dot(before, after))) continue;
                std::vector<WalkSide> sides;
                found = try_part(scratch, around, corner, cost, sides);
                if (!found) continue;
                add_sides(rules_.data, next.sides, path_.strip.sides, copied, around.first);
                add_sides(rules_.data, next.sides, sides);
                copied = around.last;
            }
            any = any || found;
        }
        add_sides(rules_.data, next.sides, path_.strip.sides, copied, path_.strip.sides.size());
        return any;
    }

    /// Tries the corners that the path touches.
    bool try_touched_corners(PathShortener& scratch, WalkStrip& next) {
        bool any = false;
        std::uint32_t copied = 0;
        for (std::size_t i = 1; i + 1 < path_.knots.size(); ++i) {
            const WalkKnot& knot = path_.knots[i];
            if (knot.fraction != 0 && knot.fraction != 1) continue;
            const WalkCorner corner = corner_of(path_.plane, knot.first, knot.fraction == 0);
            std::size_t from = i - 1, to = i + 1;
            while (from > 0 && path_.knots[from].last + 1 > corner.first) --from;
            while (to + 1 < path_.knots.size() && path_.knots[to].first < corner.last + 1) ++to;
            from -= from > 0;
            to += to + 1 < path_.knots.size();
            const Part around = part(from, to);
            if (around.first < copied || around.first > corner.first || around.last < corner.last + 1) continue;
            if (!sides_around_corner(rules_, path_, corner, sides_around_)) continue;
            double cost = 0;
            for (std::size_t k = from; k < to; ++k) cost += string_puller_.cost(path_, k);
            std::vector<WalkSide> sides;
            if (!try_part(scratch, around, corner, cost, sides)) continue;
            add_sides(rules_.data, next.sides, path_.strip.sides, copied, around.first);
            add_sides(rules_.data, next.sides, sides);
            copied = around.last;
            any = true;
        }
        add_sides(rules_.data, next.sides, path_.strip.sides, copied, path_.strip.sides.size());
        return any;
    }

    const WalkPathRules& rules_;
    StringPuller string_puller_;
    WalkTautPath path_, next_;
    std::vector<WalkSide> sides_around_;
};

}  // namespace

WalkTautPath shorten_path(const WalkPathRules& rules, WalkStrip strip) {
    PathShortener shortener(rules), scratch(rules);
    WalkTautPath& path = shortener.run(std::move(strip));
    shortener.improve_by_detours(scratch);
    return std::move(path);
}

}  // namespace abut::detail
