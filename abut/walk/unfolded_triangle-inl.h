#pragma once

// The triangles along a geodesic, unfolded into one plane. For .cpp files.

#include <abut/math/simd/double2-inl.h>
#include <abut/walk/data.hpp>
#include <abut/walk/frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut::lanes {

/// a.x * b.y - a.y * b.x
inline double cross(Double2 a, Double2 b) {
    const Double2 products = a * swapped(b);
    return products[0] - products[1];
}

}  // namespace abut::lanes

namespace abut::detail {

/// A triangle that a geodesic crosses. The geodesic is the first axis of its coordinates, and left is the second. The
/// geodesic leaves by a side with one end to its right and one to its left. Geodesics are straight lines in unfolded
/// triangles (Mitchell, Mount, Papadimitriou, "The Discrete Geodesic Problem", 1987). In these coordinates the sign of
/// one number gives the side of a corner. All lengths are multiplied by that of the step, which avoids a square root at
/// the start.
struct UnfoldedTriangle {
    lanes::Double2 right{}, left{};  ///< ends of the exit side: right[1] <= 0 <= left[1]
    lanes::Double2 rest{};           ///< third corner
    std::uint32_t triangle = 0;
    std::uint32_t side = 0;  ///< from `right` to `left`; in a mirrored triangle from `left` to `right`
    bool mirrored = false;   ///< the corners are clockwise in these coordinates

    /// True if the point at distance x ahead is beyond the side. The geodesic may run along the side.
    bool is_beyond(double x) const {
        const double height = left[1] - right[1];
        return lanes::cross(right, left) < x * height || (height == 0 && std::max(right[0], left[0]) < x);
    }

    /// The fraction of the side to the right of the geodesic.
    double crossing() const {
        // Below this the quotient of heights is rounding, and the geodesic runs along the side.
        constexpr double min_height = 1e-8;
        const double height = left[1] - right[1];
        if (height > min_height * std::abs(left[0] - right[0])) return std::clamp(-right[1] / height, 0.0, 1.0);
        // The geodesic runs along the side and begins at 0.
        const double x = std::max(0.0, std::min(right[0], left[0]));
        return left[0] != right[0] ? std::clamp((x - right[0]) / (left[0] - right[0]), 0.0, 1.0) : 0.0;
    }
    lanes::Double2 at(double fraction) const { return right + (left - right) * fraction; }
    Vec3 weights_at(double fraction) const { return weights_on_side(side, mirrored ? 1 - fraction : fraction); }

    /// The neighbour's opposite corner, if there is a neighbour.
    lanes::Double2 apex(const WalkTriangle& walk) const { return corner_beyond(walk, side, mirrored, left, right); }

    /// Crosses the side into the neighbour with this third corner. Then the exit is the side of which the corner is the
    /// left end, or the right one.
    void enter(const WalkLink& link, lanes::Double2 corner, bool as_left) {
        triangle = link.triangle();
        mirrored ^= link.mirrored();
        if (as_left) {
            rest = left;
            left = corner;
        } else {
            rest = right;
            right = corner;
        }
        side = next_corner(as_left != mirrored ? link.side() : next_corner(link.side()));
    }
    /// Makes the side from `left` to `rest` of the same triangle the exit.
    void rotate_left() {
        const lanes::Double2 last = right;
        right = left;
        left = rest;
        rest = last;
        side = mirrored ? next_corner(next_corner(side)) : next_corner(side);
    }

    /// The weights of the point at distance x ahead.
    WalkWeights weights(double x) const {
        const lanes::Double2 across = left - right, to_rest = rest - right, to_point = lanes::Double2{x, 0} - right;
        const double scale = 1 / lanes::cross(across, to_rest);
        const double of_rest = lanes::cross(across, to_point) * scale;
        const double of_left = lanes::cross(to_point, to_rest) * scale;
        double of[3];
        assign_in_order(1 - of_left - of_rest, of_left, of_rest, of);
        return {of[0], of[1], of[2]};
    }

    /// The step's vector in the frame of the triangle.
    DVec<2> step_in(const WalkTriangle& walk) const {
        lanes::Double2 corner[3];
        assign_in_order(right, left, rest, corner);
        const lanes::Double2 axis = (corner[1] - corner[0]) * walk.inverse_width;
        return {axis[0], mirrored ? axis[1] : -axis[1]};
    }

    /// Reflects the coordinates across the geodesic.
    void reflect() {
        std::swap(right, left);
        for (lanes::Double2* corner : {&right, &left, &rest}) *corner = *corner * lanes::Double2{1, -1};
        mirrored = !mirrored;
    }
    /// Moves the origin by a vector.
    void move_origin(lanes::Double2 by) {
        right -= by;
        left -= by;
        rest -= by;
    }

    template <class T>
    static void assign(const T& first, const T& second, const T& third, T (&in_order)[3]) {
        in_order[0] = first;
        in_order[1] = second;
        in_order[2] = third;
    }
    /// Reorders values of the corners `right`, `left` and `rest` to the triangle's corner order.
    template <class T>
    void assign_in_order(const T& of_right, const T& of_left, const T& of_rest, T (&in_order)[3]) const {
        const T &from = mirrored ? of_left : of_right, &to = mirrored ? of_right : of_left;
        // A switch replaces computed indices, which would wait for values that were just stored.
        switch (side) {
            case 0:
                assign(from, to, of_rest, in_order);
                break;
            case 1:
                assign(of_rest, from, to, in_order);
                break;
            default:
                assign(to, of_rest, from, in_order);
        }
    }
};

/// The side by which a geodesic leaves, from the signs of the corners' heights: it runs from a corner on the right to
/// one on the left. If all corners are on one side, because the geodesic only touches the triangle or runs along a
/// side, the exit is at the nearest corner.
inline std::uint32_t side_ahead(const lanes::Double2 (&corner)[3]) {
    // Indexed by the set of corners on the right, two bits per entry.
    constexpr std::uint32_t sides = 3u << 0 | 0u << 2 | 1u << 4 | 1u << 6 | 2u << 8 | 0u << 10 | 2u << 12 | 3u << 14;
    const std::uint32_t right =
        (corner[0][1] < 0 ? 1u : 0u) | (corner[1][1] < 0 ? 2u : 0u) | (corner[2][1] < 0 ? 4u : 0u);
    const std::uint32_t side = sides >> 2 * right & 3u;
    if (side < 3) return side;
    std::uint32_t nearest = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
        const double height = std::abs(corner[k][1]), min_height = std::abs(corner[nearest][1]);
        if (height < min_height || (height == min_height && corner[k][0] > corner[nearest][0])) nearest = k;
    }
    // The side to the right of the corner if all others are to its left.
    return corner[nearest][1] < 0 ? next_corner(next_corner(nearest)) : nearest;
}

/// The triangle in which a geodesic begins, for a place and a step in its frame. Corners whose height is at most
/// `tolerance` times their distance ahead count as lying on the geodesic.
inline UnfoldedTriangle unfolded_ahead(const WalkTriangle& walk, std::uint32_t triangle, const WalkWeights& at,
                                       const DVec<2>& step, double tolerance = 0) {
    const double width = 1 / walk.inverse_width, height = 1 / walk.inverse_height;
    const lanes::Double2 ahead{step.x, -step.y}, left{step.y, step.x};
    const lanes::Double2 along = ahead * width, other = ahead * walk.third + left * height;
    const lanes::Double2 origin = along * at.second + other * at.third;
    lanes::Double2 corner[3] = {-origin, along - origin, other - origin};
    if (tolerance > 0) {
        for (lanes::Double2& each : corner)
            if (std::abs(each[1]) <= tolerance * std::abs(each[0])) each = lanes::Double2{each[0], 0};
    }
    UnfoldedTriangle here;
    here.triangle = triangle;
    here.side = side_ahead(corner);
    const std::uint32_t end = next_corner(here.side);
    const lanes::Double2 right = corner[here.side], to_left = corner[end];
    here.right = lanes::Double2{right[0], std::min(right[1], 0.0)};
    here.left = lanes::Double2{to_left[0], std::max(to_left[1], 0.0)};
    here.rest = corner[next_corner(end)];
    return here;
}

}  // namespace abut::detail
