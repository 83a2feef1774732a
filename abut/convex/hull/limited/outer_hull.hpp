#pragma once

// A simplified outer hull: a convex triangle mesh that contains a body and loses vertices.

#include <abut/convex/hull/hill_climb.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/math/detail/no_index.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <utility>
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

/// A closed convex surface in half-edges, numbered like those of `TriangleSurface`. Removed corners and triangles leave
/// their numbers unused. The body has a size of about 1; the surface is convex to within 2e-6.
class OuterHull {
public:
    explicit OuterHull(const ConvexSurface& surface);

    /// Removes corners until `count` are left. Each edge collapse moves two neighbours to a point outside of all their
    /// faces, the smallest added volume first (Sander, Gu, Gortler, Hoppe, Snyder: "Silhouette clipping", 2000). It may
    /// end with more corners if no collapse leaves the surface convex.
    void simplify(std::size_t count);

    /// Moves each corner to the position of minimum volume that still contains `inside`, for a number of rounds.
    void tighten(SupportSearch& inside, int rounds);

    /// Scales about the mean of the corners until it contains `inside`.
    void grow(SupportSearch& inside);

    double volume() const;
    std::size_t count() const { return count_; }
    OuterBody<3> body() const;

private:
    /// The new point of a collapse, and the volume that it adds.
    struct Merge {
        DVec<3> point{0.0};
        double added = 0;
    };
    /// Calls visit(half-edge) for those that leave a corner.
    template <class Visit>
    void each_leaving(std::uint32_t point, Visit visit) const {
        const std::uint32_t first = leaving_[point];
        std::uint32_t h = first;
        do {
            visit(h);
            h = twin_[following(following(h))];
        } while (h != first);
    }
    bool has_triangle(std::uint32_t triangle) const { return origin_[3 * triangle] != no_index; }
    const DVec<3>& corner(std::uint32_t triangle, std::uint32_t i) const { return points_[origin_[3 * triangle + i]]; }
    void gather_ring(std::uint32_t point, std::uint32_t half_edge);
    double added_by(const DVec<3>& apex) const;
    double estimated_cost(std::uint32_t half_edge);
    std::optional<Merge> merge_at(std::uint32_t half_edge);
    void merge(std::uint32_t half_edge, const DVec<3>& point);
    void set_planes_of_ring();
    void cut_around(std::uint32_t point, SupportSearch& inside);
    bool fits(std::uint32_t point, const DVec<3>& at, SupportSearch& inside);
    void set_cost(std::uint32_t half_edge, double cost);

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> leaving_;        ///< one per point: a half-edge that leaves it
    std::vector<std::uint32_t> origin_, twin_;  ///< one per half-edge
    std::vector<Plane<3>> planes_;              ///< one per triangle
    std::vector<DVec<3>> areas_;                ///< one per triangle, twice its vector area
    std::size_t count_ = 0;

    using Collapse = std::pair<double, std::uint32_t>;  ///< its cost, and a half-edge of the edge
    std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> cheapest_;
    std::vector<double> cost_;  ///< one per half-edge: of its latest entry in the queue

    // Around an edge or a point, relative to `middle_`.
    DVec<3> middle_{0.0};
    std::vector<std::uint32_t> ring_;        ///< the half-edges of the surrounding triangles opposite to it
    std::vector<std::uint32_t> star_;        ///< the surrounding triangles
    std::vector<std::uint32_t> neighbours_;  ///< the points of the ring, sorted
    std::vector<Plane<3>> limits_;
    DVec<3> slope_{0.0};            ///< the gradient of the volume under the ring's cone by its apex
    double volume_ = 0, size_ = 0;  ///< six times the volume between the star and the middle; the radius of the ring
};

}  // namespace abut::detail
