#pragma once

// A polygon of the plane by its corners and sides, as the questions about two of them read it: rows of doubles, so that
// several sides are looked at in one step.

#include <abut/convex/support.hpp>
#include <abut/math/set_affine.hpp>

#include <span>

namespace abut {

/// Polygons of more sides have no rows, and take the searches that suit any shape.
inline constexpr std::uint32_t most_sides = 16;

/// Rows are filled up to a multiple of this, with the first corner and side.
inline constexpr std::uint32_t side_lanes = 4;

constexpr std::uint32_t room_for_sides(std::uint32_t count) {
    return (count + side_lanes - 1) / side_lanes * side_lanes;
}

/// How a shape counts its corners, beside how its sides do.
enum class Numbering : std::uint8_t {
    listed,     ///< in the same way
    box,        ///< by the ends of the axes
    backwards,  ///< a clockwise triangle
};

/// Counter-clockwise, in the shape's own frame: corner i is (x[i], y[i]), and from it to the next runs side i, on the
/// line dot(normal, p) == offset[i]; its normal (normal_x[i], normal_y[i]) has length 1 and looks outwards. A segment
/// has two sides, back to back. Without initialisers: pairs of them are made for each question.
struct Sides {
    const double *x, *y;
    const double *normal_x, *normal_y;
    const double* offset;
    std::uint32_t count;
    std::uint32_t room;  ///< of each row
    Numbering numbering;
    double size;  ///< about half the diagonal of the box around it
    double area;

    DVec<2> corner(std::uint32_t i) const { return {x[i], y[i]}; }
    DVec<2> normal(std::uint32_t i) const { return {normal_x[i], normal_y[i]}; }
    /// The way that side i runs, of length 1.
    DVec<2> along(std::uint32_t i) const { return {-normal_y[i], normal_x[i]}; }
    std::uint32_t after(std::uint32_t i) const { return i + 1 == count ? 0 : i + 1; }
    std::uint32_t before(std::uint32_t i) const { return i == 0 ? count - 1 : i - 1; }
    double length(std::uint32_t i) const { return dot(along(i), corner(after(i)) - corner(i)); }

    /// Takes the rows that a polygon keeps.
    void refer_to(const double* numbers, std::uint32_t count);

    /// The number that the shape itself gives corner i; and back, as each way of counting undoes itself.
    std::uint32_t corner_number(std::uint32_t i) const;
};

inline std::uint32_t Sides::corner_number(std::uint32_t i) const {
    if (numbering == Numbering::listed) return i;
    if (numbering == Numbering::box) return i ^ i >> 1;
    return (3 - i) % 3;
}

/// The side beside corner i that a direction from there leans to, and how far along it goes; at the corner itself where
/// it leans to neither.
struct Lean {
    bool leans;
    std::uint32_t side;
    double along;  ///< from the start of the side
    double length;
};
inline Lean lean(const Sides& sides, std::uint32_t i, const DVec<2>& from_corner) {
    const double after = dot(sides.along(i), from_corner);
    if (after > 0) return {true, i, after, sides.length(i)};
    const std::uint32_t last = sides.before(i);
    const double before = dot(sides.along(last), from_corner);
    if (!(before < 0)) return {false, i, 0, 0};
    const double length = sides.length(last);
    return {true, last, length + before, length};
}

/// The rows of a polygon of 3 to `most_sides` corners, counter-clockwise, for `Convex::sides`: those of `Sides` in
/// their order, and its size and area at the end.
constexpr std::size_t numbers_for_sides(std::uint32_t count) {
    return std::size_t{5} * room_for_sides(count) + 2;
}
void write_sides(std::span<const Vec2> points, double* numbers);

/// Room for the rows of a box, a triangle or a segment.
struct FewSides {
    double numbers[numbers_for_sides(4)];
};

/// Turned by (cos, sin), then moved: how a shape of the plane is placed, or how another one sees it. Without
/// initialisers, as `Sides`.
struct Rigid2 {
    double cos, sin, x, y;

    DVec<2> offset() const { return {x, y}; }
    DVec<2> vector(const DVec<2>& v) const { return {cos * v.x - sin * v.y, sin * v.x + cos * v.y}; }
    DVec<2> point(const DVec<2>& p) const { return {(cos * p.x - sin * p.y) + x, (sin * p.x + cos * p.y) + y}; }
    /// A direction as the shape itself sees it.
    DVec<2> transposed(const DVec<2>& v) const { return {cos * v.x + sin * v.y, cos * v.y - sin * v.x}; }
    /// A place as the shape itself sees it.
    DVec<2> unplaced(const DVec<2>& p) const { return transposed({p.x - x, p.y - y}); }
};

inline Rigid2 rigid(const Pose2& pose) {
    const DVec<2> turn = unit(pose.rotation);
    return {turn.x, turn.y, static_cast<double>(pose.position.x), static_cast<double>(pose.position.y)};
}

/// A shape of the plane as the questions about two of them see it: its sides, or the one point that it is, placed by a
/// pose, and the ball around. Refers to the shape, or to its own room.
struct Outline {
    Rigid2 place;
    double radius;
    Sides sides;  ///< of a point, which is at place.offset(): `count` 1, and nothing else
    FewSides room;

    Outline() = default;
    Outline(const Outline&) = delete;
    Outline& operator=(const Outline&) = delete;

    bool is_point() const { return sides.count == 1; }

    void set_box(const DVec<2>& half);
    /// False where it has no length.
    bool set_segment(const Vec2& a, const Vec2& b);
    /// False where it is so thin that its area may be rounding.
    bool set_triangle(const Vec2& a, const Vec2& b, const Vec2& c);
    /// Where it is in the world.
    void set_point(const DVec<2>& point);
};

/// Whether a placed core has an outline, and then that: a point, a segment of some length, a box, a triangle of some
/// area, or a polygon that brings its sides along; neither stretched nor mirrored nor round before it is placed.
bool set_outline(const Convex<2>& convex, Outline& outline);

// From here on: what is done so often that it is to be done in place.

/// Field by field, as what is written in parts and read as a whole has to be waited for.
inline void Sides::refer_to(const double* numbers, std::uint32_t number) {
    const std::uint32_t rows = room_for_sides(number);
    x = numbers;
    y = numbers + rows;
    normal_x = numbers + std::size_t{2} * rows;
    normal_y = numbers + std::size_t{3} * rows;
    offset = numbers + std::size_t{4} * rows;
    count = number;
    room = rows;
    numbering = Numbering::listed;
    size = numbers[std::size_t{5} * rows];
    area = numbers[std::size_t{5} * rows + 1];
}

inline void Outline::set_box(const DVec<2>& half) {
    static constexpr double normals_x[4] = {0, -1, 0, 1}, normals_y[4] = {1, 0, -1, 0};
    const double x = half.x, y = half.y;
    double* numbers = room.numbers;
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
    sides.room = 4;
    sides.numbering = Numbering::box;
    sides.size = x + y;
    sides.area = 4 * x * y;
}

inline void Outline::set_point(const DVec<2>& point) {
    place = {1, 0, point.x, point.y};
    sides.count = 1;
    sides.size = 0;
    sides.area = 0;
}

}  // namespace abut
