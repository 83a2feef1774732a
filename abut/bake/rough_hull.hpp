#pragma once

// Hulls by the thousand, to compare cuts by: how large, and which points are corners. Nothing is kept of the faces.

#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Keeps its memory from one hull to the next.
class RoughHull {
public:
    /// The points are first rounded to a grid of 2^16 steps along the longest side of their box, on which doubles are
    /// exact; then points no higher than `tolerance` times that side above a face may be left out. There is at least
    /// one point; all are finite.
    void build(std::span<const DVec<3>> points, double tolerance);

    double volume() const { return volume_; }
    double area() const { return area_; }  ///< of all sides; of what lies in a plane both

    /// Numbers of points, in ascending order.
    std::span<const std::uint32_t> corners() const { return corners_; }

    struct Plane {
        DVec<3> normal;  ///< outwards, of length 1
        double offset;
    };
    /// One for each triangle, to the grid's rounding; none where the points lie in a plane.
    std::vector<Plane> planes() const;

    /// Each triangle's corners, by number, counter-clockwise seen from outside; once each where the points lie in a
    /// plane, and none where they lie on a line.
    std::vector<std::array<std::uint32_t, 3>> triangles() const;

private:
    struct Facet {
        std::array<std::uint32_t, 3> corner;
        std::array<std::uint32_t, 3> twin;  ///< half-edge i runs from corner i to corner i + 1; as 3 x facet + i
        DVec<3> normal;                     ///< in steps of the grid, whole numbers
        double offset;
        std::uint32_t outside;  ///< the first of the points above it, linked by next_
        std::uint32_t farthest;
        double height;
        bool alive;
    };

    bool begin(double tolerance);
    void begin_flat(const DVec<3>& normal, std::uint32_t a, std::uint32_t b);
    std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    double above(const Facet& facet, std::uint32_t point) const;
    void assign(std::uint32_t point, std::uint32_t first);
    void insert(std::uint32_t eye, std::uint32_t seen);
    void finish();

    std::vector<DVec<3>> points_;
    std::vector<Facet> facets_;
    std::vector<Plane> tops_;  ///< one a facet: what is above it is above the facet by more than what may be left out
    std::vector<std::uint32_t> next_, leaving_, visible_, horizon_, corners_;
    std::vector<std::uint32_t> outline_;  ///< where the points lie in a plane
    DVec<3> least_{0.0};
    double step_ = 0;
    double volume_ = 0, area_ = 0;
    double left_out_ = 0;  ///< in steps
};

}  // namespace abut
