#pragma once

// A strip of triangles from one place to another, laid out in a plane, and the shortest way through it. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_frame.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut {

/// What ways over the surface go by.
struct WalkPathRules {
    const WalkMeshData& data;
    const WalkPathOptions& options;
    bool alike = true;    ///< all open areas cost 1
    bool closes = false;  ///< some are closed

    WalkPathRules(const WalkMeshData& mesh_data, const WalkPathOptions& path_options);

    /// What a unit of length costs; above 0, infinite where the area is closed.
    double cost(const WalkTriangle& walk) const {
        if ((alike && !closes) || walk.area >= options.area_costs.size()) return 1;
        const float given = options.area_costs[walk.area];
        return given > 0 ? static_cast<double>(given) : std::numeric_limits<double>::infinity();
    }
    bool is_open(std::uint32_t triangle) const {
        return !closes || cost(data.walk[triangle]) <= std::numeric_limits<double>::max();
    }
    /// Whether a way may lead over a side, which has a triangle beyond it.
    bool may_cross(const WalkSide& from, const WalkLink& link) const {
        return is_open(link.triangle()) && (!options.allow || (*options.allow)(from, {link.triangle(), link.side()}));
    }
    /// The least that any area costs.
    double least_cost() const;
};

/// Triangles one beyond another, from `from` to `to`. Side i is of triangle i; triangle i + 1 is beyond it.
struct WalkStrip {
    WalkPoint from, to;
    std::vector<WalkSide> sides;
    std::vector<WalkSide> before, after;  ///< what was trimmed: sides at an end of the way
};

/// Leaves out the triangles that the way need not enter, since an end of it is on the side that leads there.
void trim(const WalkMeshData& data, WalkStrip& strip);
/// Adds a side; where it leads back over the last one, that is taken away instead.
void add_side(const WalkMeshData& data, std::vector<WalkSide>& sides, const WalkSide& side);

/// A side of the strip as it is walked over, from one triangle to the next.
struct WalkPortal {
    DVec<2> left, right;
    bool new_left = false;  ///< its right end is that of the portal before; else its left one is
};

/// How far from its left end to its right one a portal is crossed by the line through two points. By one that leads
/// along it, as soon as it comes to it.
inline double crossed_at(const WalkPortal& portal, const DVec<2>& from, const DVec<2>& to) {
    const DVec<2> along = to - from, side = portal.right - portal.left;
    const double sine = cross(along, side), square = dot(side, side);
    const double share = sine * sine <= 1e-24 * square * dot(along, along) ? dot(from - portal.left, side) / square
                                                                           : cross(portal.left - from, along) / sine;
    return std::clamp(share, 0.0, 1.0);
}

/// A strip whose triangles are unfolded into the plane of the first one.
struct WalkUnfolded {
    std::vector<WalkPortal> portals;     ///< one a side of the strip
    std::vector<std::uint8_t> mirrored;  ///< by triangle, one more: laid out upside down
    DVec<2> from, to;
    DVec<2> first;  ///< the corner of the first triangle that is opposite of the first portal
    DVec<2> last;   ///< that of the last triangle opposite of the last portal; where there is none, its corner 2
};
void unfold(const WalkMeshData& data, const WalkStrip& strip, WalkUnfolded& result);

/// Which corner of a triangle is the left end of its side as one leaves it, or enters it.
inline std::uint32_t left_leaving(std::uint32_t side, bool mirrored) {
    return mirrored ? side : next_corner(side);
}
inline std::uint32_t left_entering(std::uint32_t side, bool mirrored) {
    return mirrored ? next_corner(side) : side;
}
/// Where the corner beyond a side is, unfolded.
inline DVec<2> beyond_side(const WalkTriangle& walk, std::uint32_t side, bool mirrored, const DVec<2>& left,
                           const DVec<2>& right) {
    const lanes::Both at =
        corner_beyond(walk, side, mirrored, lanes::both(left.x, left.y), lanes::both(right.x, right.y));
    return {at[0], at[1]};
}

/// Where a way through a strip turns, or is told apart: an end of some portals, or a point of one.
struct WalkKnot {
    enum class Kind : std::uint8_t { end, left, right, crossing };
    DVec<2> at;
    Kind kind = Kind::end;
    std::uint32_t first = 0, last = 0;  ///< the portals that it is on
    double share = 0;                   ///< of a crossing: how far from the left end of its portal to the right one
};

/// A point of a portal, so far from its left end to its right one, in the triangle before it or in that beyond.
WalkPoint place_on(const WalkMeshData& data, const WalkStrip& strip, const WalkUnfolded& plane, std::uint32_t portal,
                   double share, bool beyond);

/// An end of a portal, and all the portals next to it that have it.
struct WalkCorner {
    DVec<2> at;
    bool left = false;
    std::uint32_t first = 0, last = 0;
};
WalkCorner corner_of(const WalkUnfolded& plane, std::uint32_t portal, bool left);

/// A way that can't be pulled any tighter within its strip.
struct WalkTaut {
    WalkStrip strip;
    WalkUnfolded plane;
    std::vector<WalkKnot> knots;  ///< the start, corners and places where the cost changes, the end
    double cost = 0;
};

/// The shortest way in the plane through portals `first` to `last - 1`, from one point to another; appends its corners.
/// By a funnel: Chazelle 1982; Lee & Preparata 1984. O(last - first).
class WalkFunnel {
public:
    void pull(const std::vector<WalkPortal>& portals, std::uint32_t first, std::uint32_t last, const DVec<2>& from,
              const DVec<2>& to, std::vector<WalkKnot>& knots);

private:
    struct Point {
        DVec<2> at;
        std::uint32_t portal = 0, parent = 0;
        bool left = false;
    };
    void add(const DVec<2>& at, std::uint32_t portal, bool left);
    const DVec<2>& at(std::size_t place) const { return points_[chain_[place]].at; }

    std::vector<Point> points_;
    std::uint32_t count_ = 0;
    std::vector<std::uint32_t> chain_;  ///< from the left end of the last portal to its right one, by the apex
    std::size_t front_ = 0, apex_ = 0, back_ = 0;
};

}  // namespace abut
