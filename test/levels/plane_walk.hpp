#pragma once

// A map of Freedoom from above: its walls, the reachable squares, and paths through it.

#include "real_levels.hpp"
#include "walks.hpp"
#include <abut/math/predicates.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/segment.hpp>

#include <queue>

namespace abut::test {

using detail::DVec;
using detail::length;

/// The radius of a player of the game.
inline constexpr float player_radius = 16;

/// Walls and barriers, each an item, or one compound of all; ledges are chains with one side.
class PlaneLevel {
public:
    PlaneLevel(const scenes::WadMap& map, bool as_compound) {
        std::vector<AnyShape<2>> walls;
        for (const auto* lines : {&map.one_sided, &map.barriers})
            for (const glm::uvec2& line : *lines) {
                const Vec2 a = map.points[line.x], b = map.points[line.y];
                if (a == b) continue;
                walls.push_back(Segment2{a, b});
                pieces_.add(oracle::hull_of<2>({a, b}));
            }
        if (as_compound)
            world_.add(*Compound2::build(walls), {.fixed = true});
        else
            for (const AnyShape<2>& wall : walls) world_.add(wall, {.fixed = true});
        for (const glm::uvec2& line : map.ledges) {
            const Vec2 a = map.points[line.x], b = map.points[line.y];
            if (a == b) continue;
            world_.add(*Chain::build({a, b}, false, {.one_sided = true}), {.fixed = true});
            ledges_.push_back({a, b});
        }
        pieces_.build();
        ledge_boxes_.clear();
        for (const Segment2& ledge : ledges_)
            ledge_boxes_.push_back(merged(Aabb2{ledge.a, ledge.a}, Aabb2{ledge.b, ledge.b}));
        ledge_tree_.build(ledge_boxes_);
    }

    const World2& world() const { return world_; }
    const Pieces<2>& pieces() const { return pieces_; }

    /// Whether the segment from a to b crosses a wall, or a ledge upwards.
    bool blocked(const Vec2& a, const Vec2& b) const { return crosses_wall(a, b) || climbs(a, b); }
    bool crosses_wall(const Vec2& a, const Vec2& b) const {
        bool result = false;
        pieces_.tree().each_overlapping(merged(Aabb2{a, a}, Aabb2{b, b}), [&](std::uint32_t i) {
            result = result || crosses(a, b, pieces_[i].points[0], pieces_[i].points[1]);
            return !result;
        });
        return result;
    }
    bool climbs(const Vec2& a, const Vec2& b) const {
        bool result = false;
        ledge_tree_.each_overlapping(merged(Aabb2{a, a}, Aabb2{b, b}), [&](std::uint32_t i) {
            const Segment2& ledge = ledges_[i];
            // The low side is on the right.
            result = result || (crosses(a, b, ledge.a, ledge.b) && orientation(ledge.a, ledge.b, a) < 0);
            return !result;
        });
        return result;
    }
    double clearance(const Vec2& point, float reach) const {
        double result = static_cast<double>(reach);
        pieces_.tree().each_overlapping(grown(Aabb2{point, point}, reach), [&](std::uint32_t i) {
            const DVec<2> a(pieces_[i].points[0]), b(pieces_[i].points[1]);
            result = std::min(result, length(DVec<2>(point) - oracle::nearest_on_segment(DVec<2>(point), a, b)));
        });
        ledge_tree_.each_overlapping(grown(Aabb2{point, point}, reach), [&](std::uint32_t i) {
            const DVec<2> a(ledges_[i].a), b(ledges_[i].b);
            result = std::min(result, length(DVec<2>(point) - oracle::nearest_on_segment(DVec<2>(point), a, b)));
        });
        return result;
    }

private:
    static bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
        return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
    }

    World2 world_;
    Pieces<2> pieces_;
    std::vector<Segment2> ledges_;
    std::vector<Aabb2> ledge_boxes_;
    Bvh<2> ledge_tree_;
};

/// A grid of squares over a level, with a breadth-first search that crosses no wall.
class PlaneGrid {
public:
    /// The search enters only squares whose centers have a clearance of `reach`.
    PlaneGrid(const PlaneLevel& level, float cell, float room, const Vec2& start) : level_(level), cell_(cell) {
        const Aabb2 all = level.pieces().bounds();
        low_ = all.min;
        columns_ = static_cast<int>((all.max.x - all.min.x) / cell) + 2;
        rows_ = static_cast<int>((all.max.y - all.min.y) / cell) + 2;
        from_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), none);
        // The search starts at a square near the start and visible from it.
        std::queue<int> open;
        for (const int begin : around(start))
            if (open.empty() && enters(begin, room) && !level.blocked(start, middle(begin))) {
                from_[static_cast<std::size_t>(begin)] = begin;
                open.push(begin);
            }
        while (!open.empty()) {
            const int here = open.front();
            open.pop();
            last_ = here;
            ++reached_;
            for (const auto& [dx, dy] :
                 {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
                const int x = here % columns_ + dx, y = here / columns_ + dy;
                if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
                const int next = y * columns_ + x;
                if (from_[static_cast<std::size_t>(next)] != none || !enters(next, room)) continue;
                if (level_.blocked(middle(here), middle(next))) continue;
                from_[static_cast<std::size_t>(next)] = here;
                open.push(next);
            }
        }
    }

    int reached() const { return reached_; }
    /// The centers of the squares on the path to the farthest one, by steps.
    std::vector<Vec2> path_to_the_end() const {
        std::vector<Vec2> result;
        if (reached_ == 0) return result;
        for (int at = last_;; at = from_[static_cast<std::size_t>(at)]) {
            result.push_back(middle(at));
            if (from_[static_cast<std::size_t>(at)] == at) break;
        }
        std::reverse(result.begin(), result.end());
        return result;
    }
    /// Whether the search reached a square near the position and visible from it.
    bool holds(const Vec2& place) const {
        for (const int square : around(place))
            if (from_[static_cast<std::size_t>(square)] != none && !level_.crosses_wall(place, middle(square)))
                return true;
        return false;
    }

private:
    static constexpr int none = -1;

    Vec2 middle(int square) const {
        return low_ +
               cell_ * Vec2(static_cast<float>(square % columns_) + 0.5f, static_cast<float>(square / columns_) + 0.5f);
    }
    bool enters(int square, float room) const {
        return room == 0 || level_.clearance(middle(square), room) >= static_cast<double>(room);
    }
    std::vector<int> around(const Vec2& place) const {
        std::vector<int> result;
        const Vec2 at = (place - low_) / cell_;
        const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
        for (int j = y - 2; j <= y + 2; ++j)
            for (int i = x - 2; i <= x + 2; ++i)
                if (i >= 0 && j >= 0 && i < columns_ && j < rows_) result.push_back(j * columns_ + i);
        std::sort(result.begin(), result.end(), [&](int a, int b) {
            const double to_a = length(DVec<2>(middle(a) - place)), to_b = length(DVec<2>(middle(b) - place));
            return to_a < to_b || (to_a == to_b && a < b);
        });
        return result;
    }

    const PlaneLevel& level_;
    float cell_;
    Vec2 low_{};
    int columns_ = 0, rows_ = 0, last_ = 0, reached_ = 0;
    std::vector<int> from_;  // the predecessor of each square; the start is its own
};

}  // namespace abut::test
