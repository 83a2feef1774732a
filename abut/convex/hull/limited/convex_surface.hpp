#pragma once

// The hull of points in double as triangles, and support queries on it.

#include <abut/convex/hull/hill_climb.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

struct ConvexSurface {
    std::vector<DVec<3>> points;  ///< each is a corner of a triangle
    TriangleSurface triangles;
};

/// A point within `tolerance` times the extent may be left outside of the surface, and a point in a face or an edge may
/// be a corner. The surface is convex to 2^-28 of the extent, the grid's step. Nothing if the points are flat.
std::optional<ConvexSurface> convex_surface(std::span<const DVec<3>> points, double tolerance);

/// The points of a surface, for queries that each start at the result of the one before.
class SupportSearch {
public:
    explicit SupportSearch(const ConvexSurface& surface)
        : points_(surface.points), hill_climb_(surface.points.size(), surface.triangles) {}

    std::span<const DVec<3>> points() const { return points_; }

    /// The support point along a direction.
    const DVec<3>& highest(const DVec<3>& direction);

    /// Gift wrapping: a plane with nothing above it rotates about one of its lines, downwards on the side of `on`,
    /// until it touches a point off the line. Returns the first such point. `on` is a unit vector in the plane
    /// orthogonal to the line, `from` a point of the line; points nearer to it than `near` are on it.
    const DVec<3>& first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal, double near);

private:
    std::vector<DVec<3>> points_;
    HillClimb hill_climb_;
    std::uint32_t at_ = 0;
};

}  // namespace abut::detail
