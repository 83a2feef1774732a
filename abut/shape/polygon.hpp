#pragma once

// The convex polygon: the hull of any points of the plane, as a value.

#include <abut/convex/hull_options.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/given.hpp>

#include <initializer_list>
#include <span>
#include <vector>

namespace abut {

/// Convex, filled, of any number of corners; without build() the single point 0. Points that lie on a line, or all in
/// one place, make a valid polygon of no area.
class Polygon {
public:
    Polygon() = default;

    /// The hull of the points, in any order, copies allowed. A Problem only where there are none (`empty_input`) or one
    /// is NaN or infinite (`not_finite`, with its index).
    static Result<Polygon> build(std::span<const Vec2> points);
    static Result<Polygon> build(std::initializer_list<Vec2> points);

    /// The same with no more corners than `options.max_vertices`. Where the hull has more, this is a larger polygon
    /// with corners of its own, by as little area as is found: it has every point of the input within it, exactly.
    /// Otherwise it is the hull, bit by bit. A Problem as well where the limit is below 3 (`bad_argument`), or such
    /// corners are beyond the range of floats (`too_large`). See docs/limited_hulls.md.
    static Result<Polygon> build(std::span<const Vec2> points, const HullOptions& options);

    /// The corners, counter-clockwise from the lexicographically least, none of them between two others on a straight
    /// line. They are points of the input, and don't depend on its order.
    std::span<const Vec2> points() const;

    /// 0: a point, 1: a segment, 2: an area. No wider than 1.2e-7 of the extent is a segment.
    int rank() const;

    /// In double: an area leaves the range of float long before its corners do.
    double area() const;

    /// The centre of gravity: of the area, or of the segment or point where there is none.
    Vec2 centroid() const;

    /// Of length 1, out of the longest edge (the first of several); of a segment, at right angles to it; of a point,
    /// the first axis. Of the thin overlap of two shapes it is that of the line they touch in, to either side.
    Vec2 normal() const;

    /// For `Convex::sides`: null where there are too few corners for an area, or too many.
    const double* sides() const { return sides_.empty() ? nullptr : sides_.data(); }
    /// Of those.
    std::uint32_t side_count() const { return static_cast<std::uint32_t>(points_.size()); }

    /// Becomes a loop that is surely what `points` promises of it, without the work of a hull, and allocates nothing
    /// where there is room. False, and as it was, where the loop may be anything else, or isn't wider than `thick`.
    bool set_outline(std::span<const Vec2> loop, double thick = 0);

private:
    void write_sides();

    std::vector<Vec2> points_;  ///< empty: the point 0, also after a move
    std::vector<double> sides_;
};

Convex<2> convex(const Polygon& polygon, const Affine<2>& place = {});
Convex<2> convex(const Polygon& polygon, const Pose2& pose);
inline Given<2> given(const Polygon& polygon) {
    return {ShapeKind::polytope, &polygon};
}

}  // namespace abut
