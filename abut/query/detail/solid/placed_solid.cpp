#include <abut/math/detail/exact_orientation.hpp>
#include <abut/math/detail/next_float.hpp>
#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/shape/view/mapped_box.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

/// The first of some points, moved by an infinitesimal step towards each of the others, each step infinitely smaller
/// than the one before. The last steps are along the axes after the one of the line, so that the line along the axis
/// through it meets no edge.
struct SymbolicPoint {
    std::span<const DVec<3>> points;
    int axis;  ///< of the line

    bool is_above(const DVec<3>& corner) const {
        const int j = (axis + 2) % 3;
        if (corner[j] != points[0][j]) return corner[j] < points[0][j];
        for (const DVec<3>& towards : points)
            if (towards[j] != corner[j]) return towards[j] > corner[j];
        return true;
    }
    /// The side of the projected edge on which it lies; 0 counts as beyond the edge.
    int turn(const DVec<3>& from, const DVec<3>& to) const {
        for (const DVec<3>& point : points)
            if (const int turn = exact_turn(from, to, point, axis)) return turn;
        return 0;
    }
    /// The side of the plane; 0 if all points are in it.
    int side(const Corners& t) const {
        for (const DVec<3>& point : points)
            if (const int side = exact_side(t[0], t[1], t[2], point)) return side;
        return 0;
    }
    /// The signed crossing of the triangle by the line: 1, -1 or 0.
    int winding(const Corners& t) const {
        int winding = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec<3>&from = t[i], &to = t[(i + 1) % 3];
            const bool from_below = is_above(from), to_below = is_above(to);
            if (from_below == to_below) continue;
            const int left = turn(from, to);
            if (from_below && left > 0) ++winding;
            if (to_below && left < 0) --winding;
        }
        return winding;
    }
};

/// Whether a closed triangle contains a point.
bool is_in(const Corners& t, const DVec<3>& point) {
    if (exact_side(t[0], t[1], t[2], point) != 0) return false;
    const int projection = projection_axis(t);
    if (projection < 0) return false;
    const int front = exact_turn(t[0], t[1], t[2], projection);
    for (std::size_t i = 0; i < 3; ++i)
        if (exact_turn(t[i], t[(i + 1) % 3], point, projection) == -front) return false;
    return true;
}

/// How far a point is from a side of a box.
double exit_length(const Aabb3& box, const DVec<3>& point, int axis, bool up) {
    return up ? static_cast<double>(box.max[axis]) - point[axis] : point[axis] - static_cast<double>(box.min[axis]);
}

SolidSurface surface_of(const View<3>& shape) {
    const auto* composite = std::get_if<Composite<3>>(&shape);
    return composite != nullptr ? SolidSurface(*composite->solid) : SolidSurface(std::get<Convex<3>>(shape));
}

const Affine<3>& place_of(const View<3>& shape) {
    const auto* composite = std::get_if<Composite<3>>(&shape);
    return composite != nullptr ? composite->place : std::get<Convex<3>>(shape).place;
}

}  // namespace

int projection_axis(const Corners& corners) {
    const DVec<3> normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    for (int i = 0; i < 3; ++i, axis = (axis + 1) % 3)
        if (exact_turn(corners[0], corners[1], corners[2], axis) != 0) return axis;
    return -1;
}

Aabb3 box_of(const Corners& corners) {
    Aabb3 result;
    for (int i = 0; i < 3; ++i) {
        result.min[i] = next_down(static_cast<float>(std::min({corners[0][i], corners[1][i], corners[2][i]})));
        result.max[i] = next_up(static_cast<float>(std::max({corners[0][i], corners[1][i], corners[2][i]})));
    }
    return result;
}

PlacedSolid::PlacedSolid(const View<3>& shape) : surface_(surface_of(shape)), place_(place_of(shape)) {
    const double det = determinant(place_);
    flat_ = det == 0;
    flipped_ = surface_.is_inward() != (det < 0);
    to_local_ = flat_ ? Affine<3>() : inverse(place_, det);
    box_ = mapped_box(surface_.box(), place_);
}

PlacedSolid PlacedSolid::moved(const DVec<3>& translation) const {
    PlacedSolid result = *this;
    result.place_.offset += translation;
    result.to_local_.offset = -to_local_.vector(result.place_.offset);
    result.box_ = mapped_box(surface_.box(), result.place_);
    return result;
}

double PlacedSolid::lowest_along(const DVec<3>& direction) const {
    const DVec<3> local = place_.transposed(direction);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < point_count(); ++i)
        lowest = std::min(lowest, dot(local, DVec<3>(surface_.position(i))));
    return lowest + dot(direction, place_.offset) -
           1e-12 * std::max(largest(DVec<3>(box_.min)), largest(DVec<3>(box_.max)));
}

void PlacedSolid::each_triangle(const Aabb3& box, FunctionRef<bool(std::uint32_t triangle)> visit) const {
    if (flat_) {
        for (std::uint32_t i = 0; i < triangle_count(); ++i)
            if (!visit(i)) return;
        return;
    }
    // Only what overlaps the solid's box, so that a large box isn't rounded by much.
    const Aabb3 near{glm::max(box.min, box_.min), glm::min(box.max, box_.max)};
    for (int i = 0; i < 3; ++i)
        if (near.min[i] > near.max[i]) return;
    Aabb3 local = mapped_box(near, to_local_);
    const Aabb3 root = surface_.box();
    for (int i = 0; i < 3; ++i) {
        const float tolerance = 0x1p-22f * (root.max[i] - root.min[i] + std::abs(root.min[i]));
        local.min[i] -= tolerance;
        local.max[i] += tolerance;
    }
    surface_.each_triangle(local, visit);
}

void PlacedSolid::each_blade(std::uint32_t triangle, std::uint32_t own_side,
                             FunctionRef<bool(std::uint32_t triangle, const FanBlade& blade)> visit) const {
    const auto position = [&](std::uint32_t t, std::uint32_t corner) {
        return surface_.position(surface_.triangle(t)[corner % 3]);
    };
    const auto placed = [&](const Vec3& p) { return place_.point(DVec<3>(p)); };
    const Vec3 a = position(triangle, own_side), b = position(triangle, own_side + 1);
    const DVec<3> placed_a = placed(a), placed_b = placed(b);
    /// Visits the other corner of a triangle if it has the edge.
    const auto visit_if_there = [&](std::uint32_t t) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Vec3 from = position(t, i), to = position(t, i + 1);
            const bool along = from == a && to == b;
            if (!along && !(from == b && to == a)) continue;
            const DVec<3> corner = placed(position(t, i + 2));
            if (projection_axis({placed_a, placed_b, corner}) < 0) return true;
            // The front of a triangle that runs along the axis faces counter-clockwise.
            return visit(t, {corner, along, !along});
        }
        return true;
    };
    const std::uint32_t neighbour = surface_.neighbour(triangle, own_side);
    if (neighbour == many_neighbours) {
        surface_.each_triangle({glm::min(a, b), glm::max(a, b)}, visit_if_there);
    } else if (visit_if_there(triangle) && neighbour != no_neighbour) {
        visit_if_there(neighbour);
    }
}

std::optional<EdgeFan> PlacedSolid::fan(std::uint32_t triangle, std::size_t side) const {
    const std::uint32_t own = own_side(side);
    const std::array<std::uint32_t, 3> t = surface_.triangle(triangle);
    EdgeFan result(point(t[own]), point(t[(own + 1) % 3]));
    if (flipped_) std::swap(result.from, result.to);
    bool is_first = true;
    each_blade(triangle, own, [&](std::uint32_t other, const FanBlade& blade) {
        result.add(blade.point, blade.inside_before, blade.inside_after);
        return is_first = other >= triangle;
    });
    if (!is_first) return std::nullopt;
    result.refer_to(*this, triangle, own);
    return result;
}

template <class Visit>
void PlacedSolid::each_triangle_from(const DVec<3>& point, int axis, bool up, const Visit& visit) const {
    Aabb3 ahead;
    for (int i = 0; i < 3; ++i) {
        ahead.min[i] = next_down(static_cast<float>(point[i]));
        ahead.max[i] = next_up(static_cast<float>(point[i]));
    }
    (up ? ahead.max : ahead.min)[axis] = (up ? box_.max : box_.min)[axis];
    each_triangle(ahead, [&](std::uint32_t index) { return visit(corners(index)); });
}

PointSide PlacedSolid::side_of(const DVec<3>& point) const {
    if (!is_in_box(point)) return PointSide::outside;
    int axis = 0;
    bool up = true;
    for (int i = 0; i < 3; ++i)
        for (const bool other_up : {true, false})
            if (exit_length(box_, point, i, other_up) < exit_length(box_, point, axis, up)) {
                axis = i;
                up = other_up;
            }
    const SymbolicPoint symbolic{{&point, 1}, axis};
    int winding = 0;
    bool on_surface = false;
    each_triangle_from(point, axis, up, [&](const Corners& t) {
        on_surface = on_surface || is_in(t, point);
        const int crossing = symbolic.winding(t);
        if (crossing == 0) return !on_surface;
        const bool faces_up = exact_turn(t[0], t[1], t[2], axis) > 0, is_above = faces_up == (symbolic.side(t) < 0);
        if (is_above == up) winding += crossing;
        return !on_surface;
    });
    if (on_surface) return PointSide::on_surface;
    return winding != 0 ? PointSide::inside : PointSide::outside;
}

bool PlacedSolid::is_inside_behind(const Corners& triangle) const {
    const int axis = projection_axis(triangle);
    if (axis < 0 || !is_in_box(triangle[0])) return false;
    const bool up = exit_length(box_, triangle[0], axis, true) < exit_length(box_, triangle[0], axis, false);
    const int front = exact_turn(triangle[0], triangle[1], triangle[2], axis);
    const SymbolicPoint symbolic{triangle, axis};
    int winding = 0;
    each_triangle_from(triangle[0], axis, up, [&](const Corners& t) {
        const int crossing = symbolic.winding(t);
        if (crossing == 0) return true;
        const int faces = exact_turn(t[0], t[1], t[2], axis), side = symbolic.side(t);
        // The point is behind a triangle in the same plane that faces the same direction.
        const bool is_behind = side != 0 ? side < 0 : faces == front;
        if (((faces > 0) == is_behind) == up) winding += crossing;
        return true;
    });
    return winding != 0;
}

}  // namespace abut::detail
