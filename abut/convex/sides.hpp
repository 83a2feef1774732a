#pragma once

// A polygon of the plane by its corners and sides, as the questions about two of them read it: rows of doubles, so that
// several sides are looked at in one step.

#include <abut/convex/support.hpp>

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

/// Whether a placed core has sides, and then those: a box, a segment of some length, a triangle of some area, or a
/// polygon that brings them along; placed by a pose, neither stretched nor mirrored nor round in itself.
bool sides_of(const Convex<2>& convex, FewSides& room, Sides& sides);

}  // namespace abut
