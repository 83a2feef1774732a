#pragma once

// A solid at a place, as exact queries of solids need it: corners in double, triangles near a box, the triangles
// around an edge, and whether a point is inside. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/query/detail/solid/solid_surface.hpp>

#include <array>
#include <optional>

namespace abut::detail {

/// The corners of a placed triangle.
using Corners = std::array<DVec<3>, 3>;
inline std::size_t next_corner(std::size_t i) {
    return i == 2 ? 0 : i + 1;
}

/// A half-plane bounded by the axis of a fan, by a point on it, and whether the solid lies on either side of it.
struct FanBlade {
    DVec<3> point;
    bool inside_before;  ///< clockwise of it, seen against the direction of the axis
    bool inside_after;   ///< counter-clockwise
};

class PlacedSolid;

/// A solid near a generic point of an edge: the half-planes around the edge as axis. Refers to the solid.
class EdgeFan {
public:
    EdgeFan(const DVec<3>& start, const DVec<3>& end) : from(start), to(end) {}

    DVec<3> from, to;  ///< the axis

    /// Visits each blade, in no order.
    void each(FunctionRef<void(const FanBlade& blade)> visit) const;
    std::size_t count() const { return count_; }
    void add(const DVec<3>& point, bool inside_before, bool inside_after) {
        if (count_ < stored_.size()) stored_[count_] = {point, inside_before, inside_after};
        ++count_;
    }
    /// Makes `each` search the triangles again if more blades were added than are stored.
    void refer_to(const PlacedSolid& solid, std::uint32_t triangle, std::uint32_t own_side) {
        solid_ = &solid;
        triangle_ = triangle;
        own_side_ = own_side;
    }
    /// The same fan, with the direction of its axis reversed.
    EdgeFan reversed() const;

private:
    std::array<FanBlade, 4> stored_;
    std::size_t count_ = 0;
    const PlacedSolid* solid_ = nullptr;
    std::uint32_t triangle_ = 0, own_side_ = 0;
    bool is_reversed_ = false;
};

/// Whether two solids with the same axis share a sector around it, by exact predicates. Of a fan of fewer than two
/// blades, beside a triangle of zero area, nothing but the backs of its blades is known to be inside.
bool fans_overlap(const EdgeFan& a, const EdgeFan& b);

enum class PointSide : std::uint8_t { outside, on_surface, inside };

/// Refers to the shape. All answers are exact for the corners, which are the shape's points placed in double.
class PlacedSolid {
public:
    /// The shape is a solid mesh or a solid polytope.
    explicit PlacedSolid(const View<3>& shape);

    /// The solid after a translation.
    PlacedSolid moved(const DVec<3>& translation) const;

    const Aabb3& box() const { return box_; }
    /// Whether the corners of the shape's own triangles are clockwise seen from outside.
    bool is_flipped() const { return flipped_; }
    std::uint32_t triangle_count() const { return surface_.triangle_count(); }
    DVec<3> point(std::uint32_t index) const { return place_.point(DVec<3>(surface_.position(index))); }
    Corners corners(std::uint32_t triangle) const {
        const std::array<std::uint32_t, 3> t = surface_.triangle(triangle);
        return flipped_ ? Corners{point(t[0]), point(t[2]), point(t[1])}
                        : Corners{point(t[0]), point(t[1]), point(t[2])};
    }
    std::uint32_t point_count() const { return surface_.point_count(); }
    /// The smallest dot(direction, p) over the points, less what may be rounding.
    double lowest_along(const DVec<3>& direction) const;
    /// The index of a corner's point.
    std::uint32_t point_index(std::uint32_t triangle, std::size_t corner) const {
        const std::size_t own = flipped_ && corner > 0 ? 3 - corner : corner;
        return surface_.triangle(triangle)[own];
    }
    /// The triangle beyond the edge from a corner to the next, like that of a mesh.
    std::uint32_t neighbour(std::uint32_t triangle, std::size_t side) const {
        return surface_.neighbour(triangle, own_side(side));
    }
    /// One triangle of each connected component of the surface.
    std::span<const std::uint32_t> components() const { return surface_.components(); }

    /// Whether `each_triangle` goes down a tree. Otherwise it tests all triangles.
    bool has_tree() const { return surface_.has_tree(); }
    /// Visits at least the triangles whose boxes overlap the box; false stops.
    void each_triangle(const Aabb3& box, FunctionRef<bool(std::uint32_t triangle)> visit) const;

    /// The fan around the edge of a triangle from corner `side` to the next, as `corners` orders them, with that
    /// direction. Only the first of the triangles at an edge has it; none for the others.
    std::optional<EdgeFan> fan(std::uint32_t triangle, std::size_t side) const;

    PointSide side_of(const DVec<3>& point) const;

    /// Whether a point is inside that is infinitesimally near the first corner of a triangle, and behind the triangle.
    /// It is on no surface, whatever touches there.
    bool is_inside_behind(const Corners& triangle) const;

private:
    friend class EdgeFan;

    /// Visits the blades at an edge, with their triangles; false stops.
    void each_blade(std::uint32_t triangle, std::uint32_t own_side,
                    FunctionRef<bool(std::uint32_t triangle, const FanBlade& blade)> visit) const;

    /// Visits at least the triangles that a line along an axis meets, from a point on; false stops.
    template <class Visit>
    void each_triangle_from(const DVec<3>& point, int axis, bool up, const Visit& visit) const;
    bool is_in_box(const DVec<3>& point) const {
        for (int i = 0; i < 3; ++i)
            if (point[i] < static_cast<double>(box_.min[i]) || point[i] > static_cast<double>(box_.max[i]))
                return false;
        return true;
    }

    /// The side of the triangle as the surface orders its corners.
    std::uint32_t own_side(std::size_t side) const { return static_cast<std::uint32_t>(flipped_ ? 2 - side : side); }

    SolidSurface surface_;
    Affine<3> place_, to_local_;
    Aabb3 box_;
    bool flat_;     ///< the placement flattens the shape
    bool flipped_;  ///< corners of the surface's triangles are clockwise seen from outside
};

/// The axis along which the projection of a triangle is largest; -1 if the triangle has no area.
int projection_axis(const Corners& corners);

/// The box around corners, rounded outwards.
Aabb3 box_of(const Corners& corners);

}  // namespace abut::detail
