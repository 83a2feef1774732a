#pragma once

// The triangles under a straight way, unfolded into one plane. For .cpp files.

#include <abut/math/lanes-inl.h>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut::lanes {

/// a.x * b.y - a.y * b.x
inline double cross(Both a, Both b) {
    const Both products = a * swapped(b);
    return products[0] - products[1];
}

}  // namespace abut::lanes

namespace abut {

/// A triangle that a way leads through, in coordinates in which the way is the first axis: ahead, and to the left. It
/// is left by a side whose ends are on either side of the way. Geodesics are straight lines in the unfolded triangles
/// (Mitchell, Mount, Papadimitriou, "The Discrete Geodesic Problem", 1987); turned like this, their corners tell by the
/// sign of one number on which side of the way they are. So that no root is needed to begin, all lengths are multiplied
/// by that of the step.
struct UnfoldedTriangle {
    lanes::Both right{}, left{};  ///< the ends of the side: right[1] <= 0 <= left[1]
    lanes::Both rest{};           ///< the third corner
    std::uint32_t triangle = 0;
    std::uint32_t side = 0;  ///< from `right` to `left`, or in a mirrored triangle from `left` to `right`
    bool mirrored = false;   ///< the triangle's corners go round the other way in these coordinates

    /// Whether the point that is so far ahead is beyond the side, which the way may lead along.
    bool is_beyond(double x) const {
        const double height = left[1] - right[1];
        return lanes::cross(right, left) < x * height || (height == 0 && std::max(right[0], left[0]) < x);
    }

    /// Which share of the side lies to the right of the way.
    double crossing() const {
        // Below this a quotient of heights is rounding, and it is as near to lie on the side all along.
        constexpr double least = 1e-8;
        const double height = left[1] - right[1];
        if (height > least * std::abs(left[0] - right[0])) return std::clamp(-right[1] / height, 0.0, 1.0);
        // The way leads along the side. What is behind is behind: the way begins at 0.
        const double x = std::max(0.0, std::min(right[0], left[0]));
        return left[0] != right[0] ? std::clamp((x - right[0]) / (left[0] - right[0]), 0.0, 1.0) : 0.0;
    }
    lanes::Both at(double share) const { return right + (left - right) * share; }
    Vec3 weights_at(double share) const { return on_side(side, mirrored ? 1 - share : share); }

    /// The corner beyond the side, of which there is one.
    lanes::Both apex(const WalkTriangle& walk) const { return corner_beyond(walk, side, mirrored, left, right); }

    /// Over the side, into the triangle with this third corner: next it is left by that side of its other two that the
    /// corner is the left end of, or the right one.
    void enter(const WalkLink& link, lanes::Both corner, bool as_left) {
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
    /// In the same triangle, to the side that goes from `left` to `rest`.
    void go_round_left() {
        const lanes::Both last = right;
        right = left;
        left = rest;
        rest = last;
        side = mirrored ? next_corner(next_corner(side)) : next_corner(side);
    }

    /// Of the point that is so far ahead.
    WalkWeights weights(double x) const {
        const lanes::Both across = left - right, to_rest = rest - right, to_point = lanes::Both{x, 0} - right;
        const double scale = 1 / lanes::cross(across, to_rest);
        const double of_rest = lanes::cross(across, to_point) * scale;
        const double of_left = lanes::cross(to_point, to_rest) * scale;
        double of[3];
        put_in_order(1 - of_left - of_rest, of_left, of_rest, of);
        return {of[0], of[1], of[2]};
    }

    /// The step of the way, in the frame of the triangle.
    DVec<2> step_in(const WalkTriangle& walk) const {
        lanes::Both corner[3];
        put_in_order(right, left, rest, corner);
        const lanes::Both axis = (corner[1] - corner[0]) * walk.inverse_width;
        return {axis[0], mirrored ? axis[1] : -axis[1]};
    }

    /// Seen in a mirror that stands on the way.
    void reflect() {
        std::swap(right, left);
        for (lanes::Both* corner : {&right, &left, &rest}) (*corner)[1] = -(*corner)[1];
        mirrored = !mirrored;
    }
    /// The way begins anew, `by` ahead and to the left of where it began.
    void move_origin(lanes::Both by) {
        right -= by;
        left -= by;
        rest -= by;
    }

    template <class T>
    static void put(const T& first, const T& second, const T& third, T (&in_order)[3]) {
        in_order[0] = first;
        in_order[1] = second;
        in_order[2] = third;
    }
    /// What belongs to the corners `right`, `left` and `rest`, in the order of the triangle's.
    template <class T>
    void put_in_order(const T& of_right, const T& of_left, const T& of_rest, T (&in_order)[3]) const {
        const T &from = mirrored ? of_left : of_right, &to = mirrored ? of_right : of_left;
        // Three ways in place of indices that are calculated: what was stored a moment ago would be waited for.
        switch (side) {
            case 0:
                put(from, to, of_rest, in_order);
                break;
            case 1:
                put(of_rest, from, to, in_order);
                break;
            default:
                put(to, of_rest, from, in_order);
        }
    }
};

/// The side by which a way leaves, by its corners' heights to the left of it: from a corner on its right to one on its
/// left. Where the way only touches the triangle, or leads along a side, all corners are on one side of it or on it,
/// and it leaves at the nearest one.
inline std::uint32_t side_ahead(const lanes::Both (&corner)[3]) {
    // By which of the corners are on its right: two bits each, the lowest of none.
    constexpr std::uint32_t sides = 3u << 0 | 0u << 2 | 1u << 4 | 1u << 6 | 2u << 8 | 0u << 10 | 2u << 12 | 3u << 14;
    const std::uint32_t right =
        (corner[0][1] < 0 ? 1u : 0u) | (corner[1][1] < 0 ? 2u : 0u) | (corner[2][1] < 0 ? 4u : 0u);
    const std::uint32_t side = sides >> 2 * right & 3u;
    if (side < 3) return side;
    std::uint32_t nearest = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
        const double height = std::abs(corner[k][1]), least = std::abs(corner[nearest][1]);
        if (height < least || (height == least && corner[k][0] > corner[nearest][0])) nearest = k;
    }
    // Round it: to its right where all others are to its left.
    return corner[nearest][1] < 0 ? next_corner(next_corner(nearest)) : nearest;
}

/// The triangle that a way begins in, from a place in it along a step in its frame. `near`: corners that are as near to
/// the way as this, as a share of how far ahead they are, lie on it.
inline UnfoldedTriangle unfolded_ahead(const WalkTriangle& walk, std::uint32_t triangle, const WalkWeights& at,
                                       const DVec<2>& step, double near = 0) {
    const double width = 1 / walk.inverse_width, height = 1 / walk.inverse_height;
    const lanes::Both ahead{step.x, -step.y}, left{step.y, step.x};
    const lanes::Both along = ahead * width, other = ahead * walk.third + left * height;
    const lanes::Both origin = along * at.second + other * at.third;
    lanes::Both corner[3] = {-origin, along - origin, other - origin};
    if (near > 0) {
        for (lanes::Both& each : corner)
            if (std::abs(each[1]) <= near * std::abs(each[0])) each[1] = 0;
    }
    UnfoldedTriangle here;
    here.triangle = triangle;
    here.side = side_ahead(corner);
    const std::uint32_t end = next_corner(here.side);
    const lanes::Both right = corner[here.side], to_left = corner[end];
    here.right = lanes::Both{right[0], std::min(right[1], 0.0)};
    here.left = lanes::Both{to_left[0], std::max(to_left[1], 0.0)};
    here.rest = corner[next_corner(end)];
    return here;
}

}  // namespace abut
