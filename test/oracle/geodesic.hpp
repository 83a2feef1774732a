#pragma once

// Walks on triangles as the doors of abut/walk/walk_mesh.hpp describe them, plainly and in as many digits as wanted: in
// space, edge by edge, each direction turned about the edge by vectors.

#include "joined_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace abut::oracle {

/// Where a walk ends, and what it carries.
template <class Real>
struct GeodesicEnd {
    std::uint32_t triangle = 0;
    Space<Real> point;
    Space<Real> first_way, way;  ///< the step's direction of length 1, and what it has become
    Space<Real> first_up, up;    ///< the same of the triangle's normal
    Real asked = 0;              ///< the length of the step along the surface
    Real length = 0, lost = 0;
    WalkMet met = WalkMet::nothing;
    WalkSide side;                ///< the first border that was met
    std::uint32_t crossings = 0;  ///< not exact where it went round a corner
    bool passed_corner = false;   ///< it came within the margin of a corner
    bool near_corner = false;     ///< of one where its sides differ
    bool near_head_on = false;    ///< it met a border so squarely that it is open whether it slid
};

/// Straight on over triangles. A way that comes within `margin` of a corner where its two sides differ is followed past
/// both; where there are many such, `is_complete` tells whether all were.
template <class Real>
class Geodesic {
public:
    using Point = Space<Real>;
    using End = GeodesicEnd<Real>;

    Geodesic(const JoinedTriangles& triangles, const Real& margin) : triangles_(triangles), margin_(margin) {}

    /// All ends that are right.
    std::vector<End> walk(const WalkPoint& place, const Vec3& step) {
        // Twice: where the normal is most of the step, the first time leaves a rounding error of it. What that may all
        // be is nothing.
        const Point normal = normal_of(place.triangle), s(step), once = s - normal * dot(s, normal);
        const Point along_surface = once - normal * dot(once, normal);
        return walk_along(place, length(along_surface) > Real(1e-17) * length(s) ? along_surface : Point());
    }
    std::vector<End> walk(const WalkPoint& place, const Vec2& step) {
        const Point first = unit(corner(place.triangle, 1) - corner(place.triangle, 0));
        const Point second = cross(normal_of(place.triangle), first);
        return walk_along(place, first * static_cast<Real>(step.x) + second * static_cast<Real>(step.y));
    }
    bool is_complete() const { return complete_; }

    Point point_of(const WalkPoint& place) const {
        Point sum;
        Real weights = 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto weight = static_cast<Real>(place.weights[static_cast<glm::length_t>(k)]);
            sum = sum + corner(place.triangle, k) * weight;
            weights += weight;
        }
        return sum * (1 / weights);
    }
    Point normal_of(std::uint32_t t) const {
        return unit(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
    }

private:
    enum class At { inside, side, corner };
    /// A walk under way: inside of its triangle, on a side of it and inwards, or at a corner of it and inwards.
    struct Way {
        End end;
        At at = At::inside;
        std::uint32_t number = 0;             ///< of the side or corner
        Real left = 0;                        ///< of the step
        Real done = 0;                        ///< of the step
        std::uint32_t passed = no_walk_side;  ///< the corner that was last passed closely
        Real passed_at = 0;
    };
    enum class Leads { in, along, nowhere };

    static constexpr std::size_t most_ways = 16;
    static constexpr double square = 1e-7;  // the cosine of what is square to a border, but for so much
    static constexpr int most_events = 100'000, most_fan = 100'000;

    Point corner(std::uint32_t t, std::uint32_t k) const { return Point(triangles_.corner(t, k)); }
    /// From corner k to the next, of length 1.
    Point along(std::uint32_t t, std::uint32_t k) const { return unit(corner(t, k + 1) - corner(t, k)); }
    /// From side k into the triangle, of length 1.
    Point inwards(std::uint32_t t, std::uint32_t k) const {
        const Point e = along(t, k), other = corner(t, k + 2) - corner(t, k);
        return unit(other - e * dot(e, other));
    }

    std::vector<End> walk_along(const WalkPoint& place, const Point& step) {
        Way way;
        End& end = way.end;
        end.triangle = place.triangle;
        end.point = point_of(place);
        end.first_up = end.up = normal_of(place.triangle);
        end.asked = length(step);
        ends_.clear();
        ways_.clear();
        complete_ = true;
        if (!(end.asked > 0)) return {end};
        end.first_way = end.way = step * (1 / end.asked);
        way.left = end.asked;
        begin(way, place);
        for (std::size_t i = 0; i < ways_.size(); ++i) run(ways_[i]);
        return ends_;
    }

    void begin(Way& way, const WalkPoint& place) {
        // Weights too small to tell from 0 in the sums that follow are 0.
        const double least = 1e-25 * static_cast<double>(std::max({place.weights.x, place.weights.y, place.weights.z}));
        std::uint32_t zeros = 0, zero = 0, other = 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (static_cast<double>(place.weights[static_cast<glm::length_t>(k)]) <= least) {
                ++zeros;
                zero = k;
            } else {
                other = k;
            }
        }
        if (zeros == 2) {
            leave_corner(way, other);
        } else if (zeros == 1) {
            const std::uint32_t side = (zero + 1) % 3;
            way.at = At::side;
            way.number = side;
            if (dot(way.end.way, inwards(place.triangle, side)) >= 0)
                push(way);
            else
                over(way, side);
        } else {
            push(way);
        }
    }

    /// From a corner in a direction that may lie outside of the triangle: as from places within it that are ever nearer
    /// to the corner. Where these pass it on both sides, both are right, but for a side that leads nowhere.
    void leave_corner(const Way& way, std::uint32_t k) {
        const End& end = way.end;
        Way nearer = way, farther = way;
        nearer.at = farther.at = At::corner;
        nearer.number = farther.number = k;
        if (is_between(end.triangle, k, end.way)) {
            push(nearer);
            return;
        }
        // In between the two it may be either, by rounding.
        const bool may_pass_both = is_between(end.triangle, k, end.way * Real(-1), -1e-9);
        const bool passes_both = is_between(end.triangle, k, end.way * Real(-1), 1e-9);
        const Point middle = along(end.triangle, k) - along(end.triangle, (k + 2) % 3);
        const bool is_left = dot(cross(middle, end.way), normal_of(end.triangle)) > 0;
        const std::uint32_t right_side = k, left_side = (k + 2) % 3;
        const Leads near_leads = turn_round(nearer, is_left ? left_side : right_side);
        const Leads far_leads = turn_round(farther, is_left ? right_side : left_side);
        const bool far_leads_on = far_leads != Leads::nowhere;
        if (near_leads != Leads::nowhere || !far_leads_on || !passes_both) go_on(nearer, near_leads);
        if (far_leads_on && (may_pass_both || near_leads != Leads::in)) go_on(farther, far_leads);
    }

    void go_on(Way& way, Leads leads) {
        if (leads == Leads::in) push(way);
        if (leads == Leads::along) slide(way, way.number);
        if (leads == Leads::nowhere) {
            meet(way, way.number);
            stop(way);
        }
    }

    void push(const Way& way) {
        if (ways_.size() < most_ways)
            ways_.push_back(way);
        else
            complete_ = false;
    }

    static Real abs(const Real& x) { return x < 0 ? Real(-x) : x; }

    /// Whether a direction leads from corner k into its triangle, or along one of its sides; less `inside` of them.
    bool is_between(std::uint32_t t, std::uint32_t k, const Point& direction, const Real& inside = -1e-15) const {
        const Point normal = normal_of(t), right = along(t, k), left = along(t, (k + 2) % 3) * Real(-1);
        return dot(cross(right, direction), normal) >= inside && dot(cross(direction, left), normal) >= inside;
    }

    /// Into the triangle beyond a side, the point as it is.
    void cross_side(Way& way, std::uint32_t side, const WalkSide& to) const {
        End& end = way.end;
        const Point e = along(end.triangle, side), in = inwards(end.triangle, side);
        const Point on = inwards(to.triangle, to.side);
        // What leads out leads on; what is up stays on the same side of the two.
        const Real way_out = -dot(end.way, in), way_along = dot(end.way, e);
        const Real hand = dot(cross(e, in), end.up);
        end.way = e * way_along + on * way_out;
        end.up = cross(on, e) * hand;
        end.triangle = to.triangle;
        ++end.crossings;
        way.at = At::side;
        way.number = to.side;
    }

    /// Round the corner at which the way stands, over that side of it first, until the direction leads in or a border
    /// ends it; then `number` is the border's side. With `came_from` it tells whether what the way came from was seen.
    Leads turn_round(Way& way, std::uint32_t side, bool* came_from = nullptr) const {
        End& end = way.end;
        const std::uint32_t vertex = triangles_.vertex(end.triangle, way.number);
        for (int i = 0; i < most_fan; ++i) {
            const WalkSide to = triangles_.beyond(end.triangle, side);
            if (to.triangle == no_walk_side) {
                const bool starts_here = triangles_.vertex(end.triangle, side) == vertex;
                const Real cosine = dot(end.way, along(end.triangle, side)) * Real(starts_here ? 1 : -1);
                way.number = side;
                return cosine > 0 ? Leads::along : Leads::nowhere;
            }
            cross_side(way, side, to);
            const bool starts_here = triangles_.vertex(to.triangle, to.side) == vertex;
            way.at = At::corner;
            way.number = starts_here ? to.side : (to.side + 1) % 3;
            if (came_from != nullptr && is_between(to.triangle, way.number, end.way * Real(-1))) *came_from = true;
            if (is_between(to.triangle, way.number, end.way)) return Leads::in;
            side = starts_here ? (to.side + 2) % 3 : (to.side + 1) % 3;
        }
        return Leads::nowhere;
    }

    /// Whether the triangles round a corner could lie in a plane.
    bool is_flat(std::uint32_t t, std::uint32_t k) const {
        double angle = 0;
        const std::uint32_t first = t;
        for (int i = 0; i < most_fan; ++i) {
            const Real cosine = -dot(along(t, k), along(t, (k + 2) % 3));
            angle += std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0));
            const std::uint32_t vertex = triangles_.vertex(t, k), side = (k + 2) % 3;
            const WalkSide to = triangles_.beyond(t, side);
            if (to.triangle == no_walk_side || triangles_.beyond(to.triangle, to.side).triangle == no_walk_side)
                return false;
            const bool starts_here = triangles_.vertex(to.triangle, to.side) == vertex;
            if (!starts_here) return false;  // turned over: taken for bent
            t = to.triangle;
            k = to.side;
            if (t == first) return std::abs(angle - 2 * 3.14159265358979323846) < 1e-9;
        }
        return false;
    }

    /// Follows the way past the other side of a corner that it comes close to.
    void pass_other_side(const Way& way, std::uint32_t k, std::uint32_t exit, const Real& ahead) {
        Way other = way;
        End& end = other.end;
        const std::uint32_t side = exit == k ? (k + 2) % 3 : k;
        end.point = corner(end.triangle, k);
        end.length += ahead;
        other.done += ahead;
        other.left -= ahead;
        other.at = At::corner;
        other.number = k;
        bool came_from = is_between(end.triangle, k, end.way * Real(-1));
        const Leads leads = turn_round(other, side, &came_from);
        if (leads == Leads::in) {
            push(other);
        } else if (came_from) {
            const bool is_square = abs(dot(end.way, along(end.triangle, other.number))) < square;
            if (leads == Leads::along || is_square) go_on(other, leads);
        }
    }

    void run(Way way) {
        for (int event = 0; event < most_events; ++event) {
            End& end = way.end;
            const std::uint32_t t = end.triangle;
            const Point normal = normal_of(t);
            std::array<Real, 3> left_by;  // how far each corner is to the left of the way
            for (std::uint32_t k = 0; k < 3; ++k) left_by[k] = dot(cross(end.way, corner(t, k) - end.point), normal);
            const std::uint32_t exit = exit_side(way, left_by), next = (exit + 1) % 3;
            for (const std::uint32_t k : {exit, next}) look_at_corner(way, k, exit, left_by[k]);
            const Real width = left_by[next] - left_by[exit];
            const Real share = width > 0 ? std::clamp<Real>(-left_by[exit] / width, 0, 1) : Real(0.5);
            const Point out = corner(t, exit) + (corner(t, next) - corner(t, exit)) * share;
            const Real distance = std::max<Real>(0, dot(out - end.point, end.way));
            if (distance >= way.left) {
                end.point = end.point + end.way * way.left;
                end.length += way.left;
                ends_.push_back(end);
                return;
            }
            end.point = out;
            end.length += distance;
            way.done += distance;
            way.left -= distance;
            const WalkSide to = triangles_.beyond(t, exit);
            if (to.triangle == no_walk_side) {
                slide(way, exit);
                return;
            }
            cross_side(way, exit, to);
        }
        complete_ = false;
    }

    static std::uint32_t exit_side(const Way& way, const std::array<Real, 3>& left_by) {
        if (way.at == At::corner) return (way.number + 1) % 3;
        if (way.at == At::side) return left_by[(way.number + 2) % 3] > 0 ? (way.number + 1) % 3 : (way.number + 2) % 3;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (left_by[k] <= 0 && left_by[(k + 1) % 3] > 0) return k;
        return 0;
    }

    void look_at_corner(Way& way, std::uint32_t k, std::uint32_t exit, const Real& left_by) {
        if (abs(left_by) >= margin_) return;
        End& end = way.end;
        const std::uint32_t vertex = triangles_.vertex(end.triangle, k);
        const Real ahead = dot(corner(end.triangle, k) - end.point, end.way);
        if (ahead < -margin_ || ahead > way.left + margin_) return;
        const Real at = way.done + ahead;
        if (vertex == way.passed && abs(at - way.passed_at) < 4 * margin_) return;
        way.passed = vertex;
        way.passed_at = at;
        end.passed_corner = true;
        if (is_flat(end.triangle, k)) return;
        end.near_corner = true;
        pass_other_side(way, k, exit, ahead);
    }

    /// From a place on a border, the way leading out over it or along it.
    void slide(Way& way, std::uint32_t side) {
        for (int event = 0; event < most_events; ++event) {
            End& end = way.end;
            meet(way, side);
            const std::uint32_t t = end.triangle;
            const Point e = along(t, side);
            const Real cosine = dot(end.way, e), share = abs(cosine);
            if (share < square) {
                Way stays = way;
                stop(stays);
            }
            if (share == 0) return;
            const std::uint32_t to = cosine > 0 ? (side + 1) % 3 : side;
            const Real distance = length(corner(t, to) - end.point);
            if (distance >= way.left * share) {
                end.point = end.point + e * (cosine * way.left);
                end.length += way.left * share;
                end.lost += way.left * (1 - share);
                ends_.push_back(end);
                return;
            }
            end.point = corner(t, to);
            end.length += distance;
            end.lost += distance / share - distance;
            way.done += distance / share;
            way.left -= distance / share;
            way.at = At::corner;
            way.number = to;
            const Leads leads = turn_round(way, to == side ? (to + 2) % 3 : to);
            if (leads == Leads::in) return push(way);
            side = way.number;
            look_whether_square(way, side);
            if (leads == Leads::nowhere) return stop(way);
        }
        complete_ = false;
    }

    void meet(Way& way, std::uint32_t side) const {
        way.end.met = WalkMet::border;
        look_whether_square(way, side);
        if (way.end.side.triangle == no_walk_side) way.end.side = {way.end.triangle, side};
    }
    void look_whether_square(Way& way, std::uint32_t side) const {
        if (abs(dot(way.end.way, along(way.end.triangle, side))) < square) way.end.near_head_on = true;
    }
    void stop(Way& way) {
        way.end.met = WalkMet::corner;
        way.end.lost += way.left;
        ends_.push_back(way.end);
    }
    void over(Way& way, std::uint32_t side) {
        const WalkSide to = triangles_.beyond(way.end.triangle, side);
        if (to.triangle == no_walk_side) return slide(way, side);
        cross_side(way, side, to);
        push(way);
    }

    const JoinedTriangles& triangles_;
    Real margin_;
    bool complete_ = true;
    std::vector<Way> ways_;
    std::vector<End> ends_;
};

}  // namespace abut::oracle
