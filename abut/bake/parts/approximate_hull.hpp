#pragma once

// An approximate hull by quickhull, for comparing many cuts: its volume, area and vertices.

#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Reuses its memory for the next hull.
class ApproximateHull {
public:
    /// Builds the hull. The points are rounded to a grid of 2^16 steps along the longest side of their box, so that
    /// double arithmetic is exact. Points that are at most `tolerance` times that side above a face may then be
    /// omitted. Needs at least one point; all are finite.
    void build(std::span<const DVec<3>> points, double tolerance);

    double volume() const { return volume_; }
    double area() const { return area_; }  ///< total area of the faces; both sides of a flat hull

    /// The numbers of the hull's vertices in ascending order.
    std::span<const std::uint32_t> corners() const { return corners_; }

    struct Plane {
        DVec<3> normal;  ///< unit length, outwards
        double offset;
    };
    /// One plane per triangle, accurate to the grid's rounding. Empty if the points are coplanar.
    std::vector<Plane> planes() const;

    /// The vertex numbers of each triangle, counter-clockwise seen from outside. A flat hull has one side only, and a
    /// collinear one has no triangles.
    std::vector<std::array<std::uint32_t, 3>> triangles() const;

private:
    struct Facet {
        std::array<std::uint32_t, 3> corner;
        std::array<std::uint32_t, 3> twin;  ///< 3 * facet + i, where half-edge i runs from corner i to corner i + 1
        DVec<3> normal;                     ///< integers, in grid steps
        double offset;
        std::uint32_t outside;  ///< first point of the outside set, linked by next_
        std::uint32_t farthest;
        double height;
        bool alive;
    };

    bool build_tetrahedron(double tolerance);
    void build_flat(const DVec<3>& normal, std::uint32_t a, std::uint32_t b);
    std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    double above(const Facet& facet, std::uint32_t point) const;
    void assign_outside(std::uint32_t point, std::uint32_t first);
    void insert_apex(std::uint32_t apex, std::uint32_t seen);
    void finish();

    std::vector<DVec<3>> points_;
    std::vector<Facet> facets_;
    std::vector<Plane> raised_planes_;  ///< one per facet: its plane moved outwards by the tolerance
    std::vector<std::uint32_t> next_, leaving_, visible_, horizon_, corners_;
    std::vector<std::uint32_t> flat_hull_;  ///< the hull of coplanar points
    DVec<3> min_{0.0};
    double step_ = 0;
    double volume_ = 0, area_ = 0;
    double tolerance_ = 0;  ///< in grid steps
};

}  // namespace abut::detail
