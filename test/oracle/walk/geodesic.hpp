#pragma once

// A reference implementation of the walks of abut/walk/walk_mesh.hpp, for any number type. It traces a geodesic in
// space from edge to edge, and rotates the direction about each edge by vectors.

#include "../triangle_adjacency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::length;
using detail::unit;

/// The end of a walk, with the transported vectors.
template <class Real>
struct GeodesicEnd {
    std::uint32_t triangle = 0;
    RealVec3<Real> point;
    RealVec3<Real> first_direction, direction;  ///< of length 1: of the step, and at the end
    RealVec3<Real> first_normal, normal;        ///< of the first triangle, and transported to the end
    Real requested = 0;                         ///< the length of the step along the surface
    Real length = 0, lost = 0;
    WalkMet met = WalkMet::nothing;
    WalkSide side;                ///< the first border on the walk
    std::uint32_t crossings = 0;  ///< approximate if the walk went around a corner
    bool passed_corner = false;   ///< it came within the tolerance of a corner
    bool near_corner = false;     ///< of a corner whose two sides lead to different ends
    bool near_head_on = false;    ///< so perpendicular to a border that sliding and stopping are both right
};

/// Traces geodesics over triangles. A path within `tolerance` of a corner whose two sides lead to different
/// ends is followed past both. The number of such branches is limited; `is_complete` returns whether all were followed.
template <class Real>
class Geodesic {
public:
    using Point = RealVec3<Real>;
    using End = GeodesicEnd<Real>;

    Geodesic(const TriangleAdjacency& adjacency, const Real& tolerance)
        : adjacency_(adjacency), tolerance_(tolerance) {}

    /// All ends that are correct.
    std::vector<End> walk(const WalkPoint& place, const Vec3& step) {
        // The projection is done twice: if the step is nearly normal to the surface, the first leaves a rounding error
        // of the normal part. A remainder that may be all rounding counts as zero.
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
    /// A walk in progress, at a point inside of its triangle, on a side or at a corner, with the direction inwards.
    struct Path {
        End end;
        At at = At::inside;
        std::uint32_t number = 0;             ///< the index of the side or corner
        Real remaining = 0;                   ///< of the step
        Real done = 0;                        ///< of the step
        std::uint32_t passed = no_walk_side;  ///< the corner that the path last came close to
        Real passed_at = 0;
    };
    /// The continuation of a path at a corner.
    enum class Leads { in, along, nowhere };

    static constexpr std::size_t max_paths = 16;
    static constexpr double perpendicular_cosine = 1e-7;  // below it, a direction counts as perpendicular to a border
    static constexpr int max_events = 100'000, max_fan = 100'000;

    Point corner(std::uint32_t t, std::uint32_t k) const { return Point(adjacency_.corner(t, k)); }
    /// The unit vector from corner k to the next.
    Point along(std::uint32_t t, std::uint32_t k) const { return unit(corner(t, k + 1) - corner(t, k)); }
    /// The unit normal of side k in the triangle's plane, inwards.
    Point inwards(std::uint32_t t, std::uint32_t k) const {
        const Point e = along(t, k), other = corner(t, k + 2) - corner(t, k);
        return unit(other - e * dot(e, other));
    }

    std::vector<End> walk_along(const WalkPoint& place, const Point& step) {
        Path path;
        End& end = path.end;
        end.triangle = place.triangle;
        end.point = point_of(place);
        end.first_normal = end.normal = normal_of(place.triangle);
        end.requested = length(step);
        ends_.clear();
        paths_.clear();
        complete_ = true;
        if (!(end.requested > 0)) return {end};
        end.first_direction = end.direction = step * (1 / end.requested);
        path.remaining = end.requested;
        begin(path, place);
        for (std::size_t i = 0; i < paths_.size(); ++i) run(paths_[i]);
        return ends_;
    }

    void begin(Path& path, const WalkPoint& place) {
        // Weights that are negligible in the sums that follow count as 0.
        const double negligible =
            1e-25 * static_cast<double>(std::max({place.weights.x, place.weights.y, place.weights.z}));
        std::uint32_t zeros = 0, zero = 0, other = 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (static_cast<double>(place.weights[static_cast<glm::length_t>(k)]) <= negligible) {
                ++zeros;
                zero = k;
            } else {
                other = k;
            }
        }
        if (zeros == 2) {
            leave_corner(path, other);
        } else if (zeros == 1) {
            const std::uint32_t side = (zero + 1) % 3;
            path.at = At::side;
            path.number = side;
            if (dot(path.end.direction, inwards(place.triangle, side)) >= 0)
                push(path);
            else
                cross_or_slide(path, side);
        } else {
            push(path);
        }
    }

    /// Starts at a corner in a direction that may lead out of the triangle. The answer is the limit of starts inside
    /// the triangle that approach the corner. If these pass it on both sides, both are right unless one leads nowhere.
    void leave_corner(const Path& path, std::uint32_t k) {
        const End& end = path.end;
        Path nearer = path, farther = path;
        nearer.at = farther.at = At::corner;
        nearer.number = farther.number = k;
        if (is_between(end.triangle, k, end.direction)) {
            push(nearer);
            return;
        }
        // Between the two limits, rounding decides.
        const bool may_pass_either = is_between(end.triangle, k, end.direction * Real(-1), -1e-9);
        const bool passes_both = is_between(end.triangle, k, end.direction * Real(-1), 1e-9);
        const Point middle = along(end.triangle, k) - along(end.triangle, (k + 2) % 3);
        const bool is_left = dot(cross(middle, end.direction), normal_of(end.triangle)) > 0;
        const std::uint32_t right_side = k, left_side = (k + 2) % 3;
        const Leads near_leads = rotate_about_corner(nearer, is_left ? left_side : right_side);
        const Leads far_leads = rotate_about_corner(farther, is_left ? right_side : left_side);
        const bool far_leads_on = far_leads != Leads::nowhere;
        if (near_leads != Leads::nowhere || !far_leads_on || !passes_both) continue_with(nearer, near_leads);
        if (far_leads_on && (may_pass_either || near_leads != Leads::in)) continue_with(farther, far_leads);
    }

    void continue_with(Path& path, Leads leads) {
        if (leads == Leads::in) push(path);
        if (leads == Leads::along) slide(path, path.number);
        if (leads == Leads::nowhere) {
            reach_border(path, path.number);
            stop(path);
        }
    }

    void push(const Path& path) {
        if (paths_.size() < max_paths)
            paths_.push_back(path);
        else
            complete_ = false;
    }

    static Real abs(const Real& x) { return x < 0 ? Real(-x) : x; }

    /// Whether a direction leads from corner k into its triangle or along one of its sides, with the sine of the angle
    /// to both at least `min_sine`.
    bool is_between(std::uint32_t t, std::uint32_t k, const Point& direction, const Real& min_sine = -1e-15) const {
        const Point normal = normal_of(t), right = along(t, k), left = along(t, (k + 2) % 3) * Real(-1);
        return dot(cross(right, direction), normal) >= min_sine && dot(cross(direction, left), normal) >= min_sine;
    }

    /// Moves the path into the triangle across a side; the point stays.
    void cross_side(Path& path, std::uint32_t side, const WalkSide& to) const {
        End& end = path.end;
        const Point e = along(end.triangle, side), in = inwards(end.triangle, side);
        const Point on = inwards(to.triangle, to.side);
        // The outward component continues in the next triangle; the normal stays on its side of the two triangles.
        const Real outward = -dot(end.direction, in), along_edge = dot(end.direction, e);
        const Real orientation = dot(cross(e, in), end.normal);
        end.direction = e * along_edge + on * outward;
        end.normal = cross(on, e) * orientation;
        end.triangle = to.triangle;
        ++end.crossings;
        path.at = At::side;
        path.number = to.side;
    }

    /// Moves around the corner of the path, across `side` first, until the direction leads in or a border ends the fan
    /// of triangles; then `number` is the border's side. `came_from` is set if the fan holds the direction back.
    Leads rotate_about_corner(Path& path, std::uint32_t side, bool* came_from = nullptr) const {
        End& end = path.end;
        const std::uint32_t vertex = adjacency_.vertex(end.triangle, path.number);
        for (int i = 0; i < max_fan; ++i) {
            const WalkSide to = adjacency_.across(end.triangle, side);
            if (to.triangle == no_walk_side) {
                const bool starts_here = adjacency_.vertex(end.triangle, side) == vertex;
                const Real cosine = dot(end.direction, along(end.triangle, side)) * Real(starts_here ? 1 : -1);
                path.number = side;
                return cosine > 0 ? Leads::along : Leads::nowhere;
            }
            cross_side(path, side, to);
            const bool starts_here = adjacency_.vertex(to.triangle, to.side) == vertex;
            path.at = At::corner;
            path.number = starts_here ? to.side : (to.side + 1) % 3;
            if (came_from != nullptr && is_between(to.triangle, path.number, end.direction * Real(-1)))
                *came_from = true;
            if (is_between(to.triangle, path.number, end.direction)) return Leads::in;
            side = starts_here ? (to.side + 2) % 3 : (to.side + 1) % 3;
        }
        return Leads::nowhere;
    }

    /// Whether the angles around a corner sum to 2 pi: then both sides of the corner have one continuation.
    bool is_flat(std::uint32_t t, std::uint32_t k) const {
        double angle = 0;
        const std::uint32_t first = t;
        for (int i = 0; i < max_fan; ++i) {
            const Real cosine = -dot(along(t, k), along(t, (k + 2) % 3));
            angle += std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0));
            const std::uint32_t vertex = adjacency_.vertex(t, k), side = (k + 2) % 3;
            const WalkSide to = adjacency_.across(t, side);
            if (to.triangle == no_walk_side || adjacency_.across(to.triangle, to.side).triangle == no_walk_side)
                return false;
            const bool starts_here = adjacency_.vertex(to.triangle, to.side) == vertex;
            if (!starts_here) return false;  // reversed winding counts as not flat
            t = to.triangle;
            k = to.side;
            if (t == first) return std::abs(angle - 2 * 3.14159265358979323846) < 1e-9;
        }
        return false;
    }

    /// Follows the path past the other side of a corner that it comes close to.
    void pass_other_side(const Path& path, std::uint32_t k, std::uint32_t exit, const Real& ahead) {
        Path other = path;
        End& end = other.end;
        const std::uint32_t side = exit == k ? (k + 2) % 3 : k;
        end.point = corner(end.triangle, k);
        end.length += ahead;
        other.done += ahead;
        other.remaining -= ahead;
        other.at = At::corner;
        other.number = k;
        bool came_from = is_between(end.triangle, k, end.direction * Real(-1));
        const Leads leads = rotate_about_corner(other, side, &came_from);
        if (leads == Leads::in) {
            push(other);
        } else if (came_from) {
            const bool is_perpendicular =
                abs(dot(end.direction, along(end.triangle, other.number))) < perpendicular_cosine;
            if (leads == Leads::along || is_perpendicular) continue_with(other, leads);
        }
    }

    void run(Path path) {
        for (int event = 0; event < max_events; ++event) {
            End& end = path.end;
            const std::uint32_t t = end.triangle;
            const Point normal = normal_of(t);
            std::array<Real, 3> left_distance;  // the distance of each corner to the left of the path
            for (std::uint32_t k = 0; k < 3; ++k)
                left_distance[k] = dot(cross(end.direction, corner(t, k) - end.point), normal);
            const std::uint32_t exit = exit_side(path, left_distance), next = (exit + 1) % 3;
            for (const std::uint32_t k : {exit, next}) check_corner(path, k, exit, left_distance[k]);
            const Real width = left_distance[next] - left_distance[exit];
            const Real share = width > 0 ? std::clamp<Real>(-left_distance[exit] / width, 0, 1) : Real(0.5);
            const Point out = corner(t, exit) + (corner(t, next) - corner(t, exit)) * share;
            const Real distance = std::max<Real>(0, dot(out - end.point, end.direction));
            if (distance >= path.remaining) {
                end.point = end.point + end.direction * path.remaining;
                end.length += path.remaining;
                ends_.push_back(end);
                return;
            }
            end.point = out;
            end.length += distance;
            path.done += distance;
            path.remaining -= distance;
            const WalkSide to = adjacency_.across(t, exit);
            if (to.triangle == no_walk_side) {
                slide(path, exit);
                return;
            }
            cross_side(path, exit, to);
        }
        complete_ = false;
    }

    static std::uint32_t exit_side(const Path& path, const std::array<Real, 3>& left_distance) {
        if (path.at == At::corner) return (path.number + 1) % 3;
        if (path.at == At::side)
            return left_distance[(path.number + 2) % 3] > 0 ? (path.number + 1) % 3 : (path.number + 2) % 3;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (left_distance[k] <= 0 && left_distance[(k + 1) % 3] > 0) return k;
        return 0;
    }

    void check_corner(Path& path, std::uint32_t k, std::uint32_t exit, const Real& left_distance) {
        if (abs(left_distance) >= tolerance_) return;
        End& end = path.end;
        const std::uint32_t vertex = adjacency_.vertex(end.triangle, k);
        const Real ahead = dot(corner(end.triangle, k) - end.point, end.direction);
        if (ahead < -tolerance_ || ahead > path.remaining + tolerance_) return;
        const Real at = path.done + ahead;
        if (vertex == path.passed && abs(at - path.passed_at) < 4 * tolerance_) return;
        path.passed = vertex;
        path.passed_at = at;
        end.passed_corner = true;
        if (is_flat(end.triangle, k)) return;
        end.near_corner = true;
        pass_other_side(path, k, exit, ahead);
    }

    /// Slides from a point on a border, with the direction out across it or along it.
    void slide(Path& path, std::uint32_t side) {
        for (int event = 0; event < max_events; ++event) {
            End& end = path.end;
            reach_border(path, side);
            const std::uint32_t t = end.triangle;
            const Point e = along(t, side);
            const Real cosine = dot(end.direction, e), share = abs(cosine);
            if (share < perpendicular_cosine) {
                Path stopped = path;
                stop(stopped);
            }
            if (share == 0) return;
            const std::uint32_t to = cosine > 0 ? (side + 1) % 3 : side;
            const Real distance = length(corner(t, to) - end.point);
            if (distance >= path.remaining * share) {
                end.point = end.point + e * (cosine * path.remaining);
                end.length += path.remaining * share;
                end.lost += path.remaining * (1 - share);
                ends_.push_back(end);
                return;
            }
            end.point = corner(t, to);
            end.length += distance;
            end.lost += distance / share - distance;
            path.done += distance / share;
            path.remaining -= distance / share;
            path.at = At::corner;
            path.number = to;
            const Leads leads = rotate_about_corner(path, to == side ? (to + 2) % 3 : to);
            if (leads == Leads::in) return push(path);
            side = path.number;
            check_head_on(path, side);
            if (leads == Leads::nowhere) return stop(path);
        }
        complete_ = false;
    }

    void reach_border(Path& path, std::uint32_t side) const {
        path.end.met = WalkMet::border;
        check_head_on(path, side);
        if (path.end.side.triangle == no_walk_side) path.end.side = {path.end.triangle, side};
    }
    void check_head_on(Path& path, std::uint32_t side) const {
        if (abs(dot(path.end.direction, along(path.end.triangle, side))) < perpendicular_cosine)
            path.end.near_head_on = true;
    }
    void stop(Path& path) {
        path.end.met = WalkMet::corner;
        path.end.lost += path.remaining;
        ends_.push_back(path.end);
    }
    void cross_or_slide(Path& path, std::uint32_t side) {
        const WalkSide to = adjacency_.across(path.end.triangle, side);
        if (to.triangle == no_walk_side) return slide(path, side);
        cross_side(path, side, to);
        push(path);
    }

    const TriangleAdjacency& adjacency_;
    Real tolerance_;
    bool complete_ = true;
    std::vector<Path> paths_;
    std::vector<End> ends_;
};

}  // namespace abut::oracle
