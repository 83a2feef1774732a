#pragma once

// A polygon in 2D with its face normals, as a structure of arrays (SoA) of doubles, so that SIMD evaluates several
// edges at once.

#include <abut/convex/support.hpp>

#include <span>

namespace abut::detail {

/// Polygons of more edges have no SoA, and take the general algorithms.
inline constexpr std::uint32_t max_soa_edges = 16;

/// Corners and edges come in blocks of this many. The last is padded with the first corner and its edge, infinitely far
/// out.
inline constexpr std::uint32_t soa_lanes = 4, soa_rows = 5;

constexpr std::uint32_t padded_edge_count(std::uint32_t count) {
    return (count + soa_lanes - 1) / soa_lanes * soa_lanes;
}

/// Counter-clockwise, in the shape's own frame. Corner i is (x(i), y(i)). Edge i runs from it to the next corner, on
/// the line dot(normal, p) == offset(i); its outward normal (normal_x(i), normal_y(i)) has length 1. A segment has two
/// edges, back to back; those of a point don't count. There are no initialisers, because every query makes two of
/// these.
struct PolygonSoa {
    const double* numbers;  ///< the size and the area, then the blocks: five rows each
    std::uint32_t count;    ///< of corners

    /// The count with the padding.
    std::uint32_t capacity() const { return padded_edge_count(count); }
    /// The place of the x of corner i. The other numbers of the corner and its edge follow at distances of `soa_lanes`,
    /// and the next corners of the block beside each. One address serves them all: a query reads few corners, each on
    /// one or two cache lines.
    static std::size_t place(std::size_t i) { return 2 + i + (i & ~std::size_t{soa_lanes - 1}) * (soa_rows - 1); }
    const double* at(std::size_t i) const { return numbers + place(i); }
    double x(std::uint32_t i) const { return at(i)[0]; }
    double y(std::uint32_t i) const { return at(i)[soa_lanes]; }
    double normal_x(std::uint32_t i) const { return at(i)[2 * soa_lanes]; }
    double normal_y(std::uint32_t i) const { return at(i)[3 * soa_lanes]; }
    double offset(std::uint32_t i) const { return at(i)[4 * soa_lanes]; }
    /// About half the diagonal of the bounding box.
    double size() const { return numbers[0]; }
    double area() const { return numbers[1]; }

    DVec<2> corner(std::uint32_t i) const { return {x(i), y(i)}; }
    DVec<2> normal(std::uint32_t i) const { return {normal_x(i), normal_y(i)}; }
    /// The direction of edge i, of length 1.
    DVec<2> along(std::uint32_t i) const { return {-normal_y(i), normal_x(i)}; }
    std::uint32_t after(std::uint32_t i) const { return (i + 1) & (0u - (i + 1 != count ? 1u : 0u)); }
    std::uint32_t before(std::uint32_t i) const { return (i == 0 ? count : i) - 1; }
    double length(std::uint32_t i) const { return dot(along(i), corner(after(i)) - corner(i)); }

    /// Refers to rows that `write_polygon_soa` wrote.
    void view_rows(const double* rows, std::uint32_t number) {
        numbers = rows;
        count = number;
    }
};

/// The numbers of a convex polygon of 3 to `max_soa_edges` corners, counter-clockwise, for `Convex::sides`.
constexpr std::size_t soa_size(std::uint32_t count) {
    return std::size_t{soa_rows} * padded_edge_count(count) + 2;
}
void write_polygon_soa(std::span<const Vec2> points, double* numbers);

/// Storage for the rows of a box, a triangle or a segment.
struct SoaStorage {
    alignas(16) double numbers[soa_size(4)];
};

/// A rotation by (cos, sin), then a translation: the pose of a shape in 2D, relative to another shape. It has no
/// initialisers, like `PolygonSoa`.
struct Rigid2 {
    double cos, sin, x, y;

    DVec<2> vector(const DVec<2>& v) const { return {cos * v.x - sin * v.y, sin * v.x + cos * v.y}; }
    DVec<2> point(const DVec<2>& p) const { return {(cos * p.x - sin * p.y) + x, (sin * p.x + cos * p.y) + y}; }
};

}  // namespace abut::detail
