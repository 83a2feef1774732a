#include <abut/math/detail/exact_orientation.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

using Signs = std::array<int, 3>;

/// The sides of a triangle's plane on which the corners of another lie.
Signs sides_of(const Corners& plane, const Corners& corners) {
    Signs result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = exact_side(plane[0], plane[1], plane[2], corners[i]);
    return result;
}

bool all_are(const Signs& signs, int sign) {
    return signs[0] == sign && signs[1] == sign && signs[2] == sign;
}
bool has(const Signs& signs, int sign) {
    return signs[0] == sign || signs[1] == sign || signs[2] == sign;
}

/// The corners in their cyclic order, beginning with one that is alone on its side of a plane; the others are on the
/// other side or on the plane.
std::array<std::size_t, 3> from_lone_corner(const Signs& signs) {
    const int positive = static_cast<int>(std::count(signs.begin(), signs.end(), 1));
    const int lone = positive == 1 ? 1 : -1;
    const auto first = static_cast<std::size_t>(std::find(signs.begin(), signs.end(), lone) - signs.begin());
    return {first, next_corner(first), next_corner(next_corner(first))};
}

/// Whether two triangles cross in a segment inside both. Each has corners on both sides of the other's plane. The line
/// of the two planes leaves a triangle through the two edges at its lone corner; the order of the four points on the
/// line is that of the edges (Guigue and Devillers, "Fast and robust triangle-triangle overlap test using orientation
/// predicates", 2003).
bool cross_inside(const Corners& a, const Signs& signs_a, const Corners& b, const Signs& signs_b) {
    const auto i = from_lone_corner(signs_a), j = from_lone_corner(signs_b);
    const DVec<3>&p = a[i[0]], &q = b[j[0]];
    DVec<3> a_next = a[i[1]], a_last = a[i[2]], b_next = b[j[1]], b_last = b[j[2]];
    if (signs_a[i[0]] < 0) std::swap(b_next, b_last);
    if (signs_b[j[0]] < 0) std::swap(a_next, a_last);
    return exact_side(p, a_next, q, b_next) < 0 && exact_side(p, a_last, b_last, q) < 0;
}

/// A triangle of a solid.
struct SolidTriangle {
    const PlacedSolid& solid;
    std::uint32_t index;
    const Corners& corners;
    const Signs& sides;  ///< of its corners, beside the plane of the other triangle
};

/// A triangle in its plane, projected along an axis.
class FlatTriangle {
public:
    explicit FlatTriangle(const Corners& corners)
        : corners_(corners),
          axis_(projection_axis(corners)),
          front_(exact_turn(corners[0], corners[1], corners[2], axis_)) {}

    /// 1 if the point is to the left of the directed line, seen from the front.
    int turn(const DVec<3>& from, const DVec<3>& to, const DVec<3>& point) const {
        return front_ * exact_turn(from, to, point, axis_);
    }
    int turn_of_edge(std::size_t edge, const DVec<3>& point) const {
        return turn(corners_[edge], corners_[next_corner(edge)], point);
    }

private:
    const Corners& corners_;
    int axis_, front_;
};

/// Tests the edges of a triangle that lie in the plane of another one.
class FlatEdges {
public:
    FlatEdges(const SolidTriangle& own, const SolidTriangle& other) : own_(own), other_(other), flat_(other.corners) {}

    bool overlap() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (own_.sides[i] == 0 && own_.sides[next_corner(i)] == 0 && overlap_at(i)) return true;
        return false;
    }

private:
    /// Whether a sector around edge i, which lies in the other's plane, is inside both solids.
    bool overlap_at(std::size_t i) const {
        const DVec<3>&from = own_.corners[i], &to = own_.corners[next_corner(i)];
        if (crosses_inside(from, to)) {
            const std::optional<EdgeFan> fan = own_.solid.fan(own_.index, i);
            return fan && fans_overlap(*fan, half_space_around(from, to));
        }
        for (std::size_t j = 0; j < 3; ++j) {
            if (!is_along_edge(from, to, j)) continue;
            const std::optional<EdgeFan> own = own_.solid.fan(own_.index, i);
            const std::optional<EdgeFan> other = own ? other_.solid.fan(other_.index, j) : std::nullopt;
            if (!other) return false;
            const bool goes_along = dot(to - from, other->to - other->from) > 0;
            return fans_overlap(*own, goes_along ? *other : other->reversed());
        }
        return false;
    }

    /// Whether the edge has a point inside the other triangle: no line through an edge of either separates them.
    bool crosses_inside(const DVec<3>& from, const DVec<3>& to) const {
        Signs turns;
        for (std::size_t j = 0; j < 3; ++j) {
            turns[j] = flat_.turn(from, to, other_.corners[j]);
            if (flat_.turn_of_edge(j, from) <= 0 && flat_.turn_of_edge(j, to) <= 0) return false;
        }
        return has(turns, 1) && has(turns, -1);
    }

    /// The other solid as the half-space behind its triangle.
    EdgeFan half_space_around(const DVec<3>& from, const DVec<3>& to) const {
        EdgeFan result(from, to);
        for (const int side : {1, -1})
            for (const DVec<3>& corner : other_.corners) {
                if (flat_.turn(from, to, corner) != side) continue;
                // To the left of the axis the front faces counter-clockwise.
                result.add(corner, side > 0, side < 0);
                break;
            }
        return result;
    }

    /// Whether the edge and edge j of the other triangle share more than a point.
    bool is_along_edge(const DVec<3>& from, const DVec<3>& to, std::size_t j) const {
        if (flat_.turn_of_edge(j, from) != 0 || flat_.turn_of_edge(j, to) != 0) return false;
        const DVec<3>&other_from = other_.corners[j], &other_to = other_.corners[next_corner(j)];
        int axis = 0;
        while (axis < 2 && from[axis] == to[axis]) ++axis;
        return std::max(std::min(from[axis], to[axis]), std::min(other_from[axis], other_to[axis])) <
               std::min(std::max(from[axis], to[axis]), std::max(other_from[axis], other_to[axis]));
    }

    const SolidTriangle &own_, &other_;
    FlatTriangle flat_;
};

/// Whether an inner point of both solids shows at these two triangles.
bool overlap_at(const PlacedSolid& a, std::uint32_t index_a, const Corners& corners_a, const PlacedSolid& b,
                std::uint32_t index_b, const Corners& corners_b) {
    const Signs sides_a = sides_of(corners_b, corners_a);
    if (all_are(sides_a, 1) || all_are(sides_a, -1)) return false;
    const Signs sides_b = sides_of(corners_a, corners_b);
    if (all_are(sides_b, 1) || all_are(sides_b, -1)) return false;
    if (has(sides_a, 1) && has(sides_a, -1) && has(sides_b, 1) && has(sides_b, -1) &&
        cross_inside(corners_a, sides_a, corners_b, sides_b))
        return true;
    if (std::count(sides_a.begin(), sides_a.end(), 0) < 2 && std::count(sides_b.begin(), sides_b.end(), 0) < 2)
        return false;
    if (projection_axis(corners_a) < 0 || projection_axis(corners_b) < 0) return false;
    const SolidTriangle own{a, index_a, corners_a, sides_a}, other{b, index_b, corners_b, sides_b};
    return FlatEdges(own, other).overlap() || FlatEdges(other, own).overlap();
}

}  // namespace

bool each_triangle_pair(const PlacedSolid& a, const PlacedSolid& b, float reach, TrianglePairVisitor visit,
                        const DVec<3>& direction) {
    if (a.has_tree() && !b.has_tree())
        return each_triangle_pair(
            b, a, reach,
            [&](std::uint32_t index_b, const Corners& corners_b, std::uint32_t index_a, const Corners& corners_a) {
                return visit(index_a, corners_a, index_b, corners_b);
            },
            -direction);
    // Above this number of points it costs more than it saves.
    constexpr std::uint32_t max_points = 4096;
    const bool has_direction = direction != DVec<3>(0.0) && b.point_count() <= max_points;
    const double lowest = has_direction ? b.lowest_along(direction) - static_cast<double>(reach) : 0;
    bool go_on = true;
    a.each_triangle(grown(b.box(), reach), [&](std::uint32_t index_a) {
        const Corners corners_a = a.corners(index_a);
        if (has_direction && dot(direction, corners_a[0]) < lowest && dot(direction, corners_a[1]) < lowest &&
            dot(direction, corners_a[2]) < lowest)
            return true;
        const Aabb3 box_a = grown(box_of(corners_a), reach);
        if (!overlaps(box_a, b.box())) return true;
        b.each_triangle(box_a, [&](std::uint32_t index_b) {
            const Corners corners_b = b.corners(index_b);
            return go_on = !overlaps(box_a, box_of(corners_b)) || visit(index_a, corners_a, index_b, corners_b);
        });
        return go_on;
    });
    return go_on;
}

bool has_component_inside(const PlacedSolid& inner, const PlacedSolid& outer) {
    for (const std::uint32_t triangle : inner.components())
        if (outer.is_inside_behind(inner.corners(triangle))) return true;
    return false;
}

bool interiors_overlap(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& direction) {
    if (!overlaps(a.box(), b.box())) return false;
    const bool finds_none = each_triangle_pair(
        a, b, 0,
        [&](std::uint32_t index_a, const Corners& corners_a, std::uint32_t index_b, const Corners& corners_b) {
            return !overlap_at(a, index_a, corners_a, b, index_b, corners_b);
        },
        direction);
    return !finds_none || has_component_inside(a, b) || has_component_inside(b, a);
}

}  // namespace abut::detail
