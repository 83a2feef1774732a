#pragma once

// A strip of triangles between two places, unfolded into a plane, and the shortest path through it. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/walk/data.hpp>
#include <abut/walk/frame.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::detail {

/// Costs and permissions of a path search.
struct WalkPathRules {
    const WalkMeshData& data;
    const WalkPathOptions& options;
    bool uniform_cost = true;       ///< all open areas cost 1
    bool has_closed_areas = false;  ///< some areas are closed

    WalkPathRules(const WalkMeshData& mesh_data, const WalkPathOptions& path_options);

    /// The cost per unit of length, above 0; infinite if the area is closed.
    double cost(const WalkTriangle& walk) const {
        if ((uniform_cost && !has_closed_areas) || walk.area >= options.area_costs.size()) return 1;
        const float given = options.area_costs[walk.area];
        return given > 0 ? static_cast<double>(given) : std::numeric_limits<double>::infinity();
    }
    bool is_open(std::uint32_t triangle) const {
        return !has_closed_areas || cost(data.walk[triangle]) <= std::numeric_limits<double>::max();
    }
    /// True if a path may cross the side, which has a neighbour.
    bool may_cross(const WalkSide& from, const WalkLink& link) const {
        return is_open(link.triangle()) && (!options.allow || (*options.allow)(from, {link.triangle(), link.side()}));
    }
    /// The minimum cost of all areas.
    double min_cost() const;
};

/// A sequence of adjacent triangles from `from` to `to`. Side i belongs to triangle i; triangle i + 1 is beyond it.
struct WalkStrip {
    WalkPoint from, to;
    std::vector<WalkSide> sides;
    std::vector<WalkSide> before, after;  ///< trimmed sides, at an end of the path
};

/// Removes the triangles that the path need not enter because its end is on the side that leads there.
void trim(const WalkMeshData& data, WalkStrip& strip);
/// Adds a side, or removes the last one if the new side leads back over it.
void add_side(const WalkMeshData& data, std::vector<WalkSide>& sides, const WalkSide& side);

/// A side of the strip in the direction of the path.
struct WalkPortal {
    DVec<2> left, right;
    bool new_left = false;  ///< shares its right end with the previous portal; otherwise its left end
};

/// The fraction of the portal, from left to right, at which the line through two points crosses it. A line along the
/// portal crosses it at its first point.
inline double crossing_fraction(const WalkPortal& portal, const DVec<2>& from, const DVec<2>& to) {
    const DVec<2> along = to - from, side = portal.right - portal.left;
    const double sine = cross(along, side), square = dot(side, side);
    const double fraction = sine * sine <= 1e-24 * square * dot(along, along) ? dot(from - portal.left, side) / square
                                                                              : cross(portal.left - from, along) / sine;
    return std::clamp(fraction, 0.0, 1.0);
}

/// The triangles of a strip, unfolded into the plane of the first.
struct WalkUnfolded {
    std::vector<WalkPortal> portals;     ///< one per side of the strip
    std::vector<std::uint8_t> mirrored;  ///< one per triangle: unfolded upside down
    DVec<2> from, to;
    DVec<2> first;  ///< the first triangle's corner opposite the first portal
    DVec<2> last;   ///< the last triangle's corner opposite the last portal; corner 2 if there is no portal
};
void unfold(const WalkMeshData& data, const WalkStrip& strip, WalkUnfolded& result);

/// The corner at the left end of a side, as seen when leaving or entering the triangle by it.
inline std::uint32_t left_leaving(std::uint32_t side, bool mirrored) {
    return mirrored ? side : next_corner(side);
}
inline std::uint32_t left_entering(std::uint32_t side, bool mirrored) {
    return mirrored ? next_corner(side) : side;
}
/// The neighbour's opposite corner, unfolded.
inline DVec<2> beyond_side(const WalkTriangle& walk, std::uint32_t side, bool mirrored, const DVec<2>& left,
                           const DVec<2>& right) {
    const lanes::Double2 at =
        corner_beyond(walk, side, mirrored, lanes::double2(left.x, left.y), lanes::double2(right.x, right.y));
    return {at[0], at[1]};
}

/// A point at which a path through a strip bends, or its cost changes: an end of several portals, or a point of one.
struct WalkKnot {
    enum class Kind : std::uint8_t { end, left, right, crossing };
    DVec<2> at;
    Kind kind = Kind::end;
    std::uint32_t first = 0, last = 0;  ///< the portals that contain it
    double fraction = 0;                ///< of a crossing: the fraction of its portal, from left to right
};

/// A point of a portal as a place in the triangle before it, or in the one beyond.
WalkPoint point_on_portal(const WalkMeshData& data, const WalkStrip& strip, const WalkUnfolded& plane,
                          std::uint32_t portal, double fraction, bool beyond);

/// An end of a portal, and all consecutive portals that share it.
struct WalkCorner {
    DVec<2> at;
    bool left = false;
    std::uint32_t first = 0, last = 0;
};
WalkCorner corner_of(const WalkUnfolded& plane, std::uint32_t portal, bool left);

/// A path that cannot be shortened within its strip.
struct WalkTautPath {
    WalkStrip strip;
    WalkUnfolded plane;
    std::vector<WalkKnot> knots;  ///< the start, the bends and cost changes, and the end
    double cost = 0;
};

/// The shortest path in the plane through portals `first` to `last - 1`; appends its corners. The funnel algorithm:
/// Chazelle 1982; Lee & Preparata 1984. O(last - first).
class Funnel {
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
    std::vector<std::uint32_t> chain_;  ///< the funnel, from its left end over the apex to its right end
    std::size_t front_ = 0, apex_ = 0, back_ = 0;
};

}  // namespace abut::detail
