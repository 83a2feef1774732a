#pragma once

// A polygon in 2D with its face normals, as a structure of arrays (SoA) of doubles, so that SIMD evaluates several
// edges at once.

#include <abut/convex/support.hpp>
#include <abut/math/detail/set_affine.hpp>

#include <span>

namespace abut::detail {

/// Polygons of more edges have no SoA, and take the general algorithms.
inline constexpr std::uint32_t max_soa_edges = 16;

/// Rows are padded to a multiple of this, with the first corner and edge.
inline constexpr std::uint32_t soa_lanes = 4;

constexpr std::uint32_t padded_edge_count(std::uint32_t count) {
    return (count + soa_lanes - 1) / soa_lanes * soa_lanes;
}

/// The order of a shape's own corner numbers, relative to the order of the edges.
enum class CornerOrder : std::uint8_t {
    listed,    ///< equal
    box,       ///< by the ends of the axes
    reversed,  ///< of a clockwise triangle
};

/// Counter-clockwise, in the shape's own frame. Corner i is (x[i], y[i]). Edge i runs from it to the next corner, on
/// the line dot(normal, p) == offset[i]; its outward normal (normal_x[i], normal_y[i]) has length 1. A segment has two
/// edges, back to back. There are no initialisers, because every query makes two of these.
struct PolygonSoa {
    const double *x, *y;
    const double *normal_x, *normal_y;
    const double* offset;
    std::uint32_t count;
    std::uint32_t capacity;  ///< of each row
    CornerOrder order;
    double size;  ///< about half the diagonal of the bounding box
    double area;

    DVec<2> corner(std::uint32_t i) const { return {x[i], y[i]}; }
    DVec<2> normal(std::uint32_t i) const { return {normal_x[i], normal_y[i]}; }
    /// The direction of edge i, of length 1.
    DVec<2> along(std::uint32_t i) const { return {-normal_y[i], normal_x[i]}; }
    std::uint32_t after(std::uint32_t i) const { return i + 1 == count ? 0 : i + 1; }
    std::uint32_t before(std::uint32_t i) const { return i == 0 ? count - 1 : i - 1; }
    double length(std::uint32_t i) const { return dot(along(i), corner(after(i)) - corner(i)); }

    /// Refers to rows that `write_polygon_soa` wrote.
    void view_rows(const double* numbers, std::uint32_t count);

    /// The shape's own number of corner i, and back: each order is its own inverse.
    std::uint32_t corner_number(std::uint32_t i) const;
};

inline std::uint32_t PolygonSoa::corner_number(std::uint32_t i) const {
    if (order == CornerOrder::listed) return i;
    if (order == CornerOrder::box) return i ^ i >> 1;
    return (3 - i) % 3;
}

/// The Voronoi region test of a vertex: the edge beside corner i to which a direction from the corner leans, and the
/// projection onto it. The direction is in the region of the vertex itself if it leans to neither edge.
struct VertexRegion {
    bool outside;
    std::uint32_t side;
    double along;  ///< from the start of the edge
    double length;
};
inline VertexRegion vertex_region_of(const PolygonSoa& sides, std::uint32_t i, const DVec<2>& from_corner) {
    const double after = dot(sides.along(i), from_corner);
    if (after > 0) return {true, i, after, sides.length(i)};
    const std::uint32_t last = sides.before(i);
    const double before = dot(sides.along(last), from_corner);
    if (!(before < 0)) return {false, i, 0, 0};
    const double length = sides.length(last);
    return {true, last, length + before, length};
}

/// The rows of a convex polygon of 3 to `max_soa_edges` corners, counter-clockwise, for `Convex::sides`: those of
/// `PolygonSoa` in their order, then its size and area.
constexpr std::size_t soa_size(std::uint32_t count) {
    return std::size_t{5} * padded_edge_count(count) + 2;
}
void write_polygon_soa(std::span<const Vec2> points, double* numbers);

/// Storage for the rows of a box, a triangle or a segment.
struct SoaStorage {
    double numbers[soa_size(4)];
};

/// A rotation by (cos, sin), then a translation: the pose of a shape in 2D, in the world or relative to another shape.
/// It has no initialisers, like `PolygonSoa`.
struct Rigid2 {
    double cos, sin, x, y;

    DVec<2> offset() const { return {x, y}; }
    DVec<2> vector(const DVec<2>& v) const { return {cos * v.x - sin * v.y, sin * v.x + cos * v.y}; }
    DVec<2> point(const DVec<2>& p) const { return {(cos * p.x - sin * p.y) + x, (sin * p.x + cos * p.y) + y}; }
    /// The inverse rotation.
    DVec<2> transposed(const DVec<2>& v) const { return {cos * v.x + sin * v.y, cos * v.y - sin * v.x}; }
    /// The inverse transform.
    DVec<2> inverse_point(const DVec<2>& p) const { return transposed({p.x - x, p.y - y}); }
};

inline Rigid2 rigid(const Pose2& pose) {
    const DVec<2> turn = unit(pose.rotation);
    return {turn.x, turn.y, static_cast<double>(pose.position.x), static_cast<double>(pose.position.y)};
}

/// A shape in 2D for a pair query: a polygon or a point, placed by a pose, and the ball around it. It refers to the
/// shape, or to its own storage.
struct PlacedPolygon {
    Rigid2 place;
    double radius;
    PolygonSoa sides;  ///< for a point, which is at place.offset(), only `count` is set, to 1
    SoaStorage storage;

    PlacedPolygon() = default;
    PlacedPolygon(const PlacedPolygon&) = delete;
    PlacedPolygon& operator=(const PlacedPolygon&) = delete;

    bool is_point() const { return sides.count == 1; }

    void set_box(const DVec<2>& half);
    /// Returns false if the segment has no length.
    bool set_segment(const Vec2& a, const Vec2& b);
    /// Returns false if the triangle is so thin that its area may be rounding.
    bool set_triangle(const Vec2& a, const Vec2& b, const Vec2& c);
    /// In the world.
    void set_point(const DVec<2>& point);
};

/// Converts a placed core: a point, a segment of nonzero length, a box, a triangle of some area, or a polygon with
/// `sides`. Returns false for other cores, and for placements that scale, shear or mirror, or that have an inner ball.
bool set_placed_polygon(const Convex<2>& convex, PlacedPolygon& polygon);

// Inline, because they run in every pair query.

/// Member by member: reading a structure as a whole right after its parts were written stalls.
inline void PolygonSoa::view_rows(const double* numbers, std::uint32_t number) {
    const std::uint32_t rows = padded_edge_count(number);
    x = numbers;
    y = numbers + rows;
    normal_x = numbers + std::size_t{2} * rows;
    normal_y = numbers + std::size_t{3} * rows;
    offset = numbers + std::size_t{4} * rows;
    count = number;
    capacity = rows;
    order = CornerOrder::listed;
    size = numbers[std::size_t{5} * rows];
    area = numbers[std::size_t{5} * rows + 1];
}

inline void PlacedPolygon::set_box(const DVec<2>& half) {
    static constexpr double normals_x[4] = {0, -1, 0, 1}, normals_y[4] = {1, 0, -1, 0};
    const double x = half.x, y = half.y;
    double* numbers = storage.numbers;
    numbers[0] = numbers[3] = numbers[9] = numbers[11] = x;
    numbers[1] = numbers[2] = -x;
    numbers[4] = numbers[5] = numbers[8] = numbers[10] = y;
    numbers[6] = numbers[7] = -y;
    sides.x = numbers;
    sides.y = numbers + 4;
    sides.normal_x = normals_x;
    sides.normal_y = normals_y;
    sides.offset = numbers + 8;
    sides.count = 4;
    sides.capacity = 4;
    sides.order = CornerOrder::box;
    sides.size = x + y;
    sides.area = 4 * x * y;
}

inline void PlacedPolygon::set_point(const DVec<2>& point) {
    place = {1, 0, point.x, point.y};
    sides.count = 1;
    sides.size = 0;
    sides.area = 0;
}

}  // namespace abut::detail
