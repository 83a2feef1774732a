#pragma once

// Convex polygon: the convex hull of any points in the plane.

#include <abut/convex/hull/hull_options.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/view/shape_ref.hpp>

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

namespace abut {

/// A filled convex polygon with any number of vertices. A default-constructed polygon is the single point 0. Collinear
/// or coincident points make a valid polygon of zero area.
class Polygon {
public:
    Polygon() = default;

    /// The convex hull of the points, in any order; duplicates are allowed. Returns a Problem only if there are no
    /// points (`empty_input`) or one is NaN or infinite (`not_finite`, index: the point).
    static Result<Polygon> build(const PointSpan<2>& points);
    static Result<Polygon> build(std::initializer_list<Vec2> points);

    /// A hull with at most `options.max_vertices` vertices. If the exact hull has more, the result is a larger polygon
    /// with new vertices that contains every input point exactly and adds as little area as the search finds. Otherwise
    /// it is the exact hull, bit for bit. Also returns a Problem if the limit is below 3 (`bad_argument`) or if a
    /// vertex would leave the range of floats (`too_large`). See docs/limited_hulls.md.
    static Result<Polygon> build(const PointSpan<2>& points, const HullOptions& options);

    /// The vertices, counter-clockwise from the lexicographically smallest; none is collinear with its neighbours. They
    /// are input points, unless a vertex limit made others, and don't depend on the input's order.
    std::span<const Vec2> points() const;

    /// 0: a point, 1: a segment, 2: an area. A hull no wider than 1.2e-7 of its extent is a segment.
    int rank() const;

    /// The area, in double since it overflows a float long before the coordinates do.
    double area() const;

    /// The centroid of the area, or of the segment or point if the area is zero.
    Vec2 centroid() const;

    /// The unit normal of the longest edge (the first of equals). For a segment it is perpendicular to it; for a point
    /// it is the first axis. For the thin overlap of two touching shapes it is the contact normal, up to the sign.
    Vec2 normal() const;

    /// The precomputed edge data for `Convex::sides`; null if there are fewer than three vertices or too many.
    const double* sides() const { return sides_.empty() ? nullptr : sides_.data(); }
    /// The number of edges in `sides()`.
    std::uint32_t side_count() const { return static_cast<std::uint32_t>(points_.size()); }

    /// Sets the vertices from a loop that already is a convex hull loop, in O(n), without allocation if the capacity
    /// suffices. Returns false and leaves the polygon unchanged if the loop isn't certain to satisfy the conditions of
    /// `points()` or isn't wider than `min_width`.
    bool set_outline(std::span<const Vec2> loop, double min_width = 0);

private:
    friend Result<Polygon> load_polygon(std::span<const std::byte> bytes);

    void write_sides();

    std::vector<Vec2> points_;  ///< empty: the point 0, also after a move
    std::vector<double> sides_;
};

detail::Convex<2> convex(const Polygon& polygon, const detail::Affine<2>& place = {});
detail::Convex<2> convex(const Polygon& polygon, const Pose2& pose);
inline detail::ShapeRef<2> shape_ref(const Polygon& polygon) {
    return {detail::ShapeKind::polytope, &polygon};
}

}  // namespace abut
