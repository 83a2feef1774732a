#pragma once

// The triangles under a straight way, unfolded into one plane. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut {

/// A triangle that a way leads through, in coordinates in which the way is the first axis: ahead, and to the left. It
/// is left by a side whose ends are on either side of the way. Geodesics are straight lines in the unfolded triangles
/// (Mitchell, Mount, Papadimitriou, "The Discrete Geodesic Problem", 1987); turned like this, their corners tell by the
/// sign of one number on which side of the way they are.
struct WalkStrip {
    DVec<2> right{0.0}, left{0.0};  ///< the ends of the side: right.y <= 0 <= left.y
    DVec<2> rest{0.0};              ///< the third corner
    std::uint32_t triangle = 0;
    std::uint32_t side = 0;  ///< from `right` to `left`, or in a mirrored triangle from `left` to `right`
    bool mirrored = false;   ///< the triangle's corners go round the other way in these coordinates

    /// Whether a point of the way is beyond the side.
    bool is_beyond(double x) const {
        const double height = left.y - right.y;
        if (right.x * left.y - left.x * right.y < x * height) return true;
        return height == 0 && std::max(right.x, left.x) < x;
    }

    /// Which share of the side lies to the right of the way.
    double crossing() const {
        const double height = left.y - right.y;
        if (height > 0) return std::clamp(-right.y / height, 0.0, 1.0);
        // The way leads along the side. What is behind is behind: the way begins at 0.
        const double x = std::max(0.0, std::min(right.x, left.x));
        return left.x != right.x ? std::clamp((x - right.x) / (left.x - right.x), 0.0, 1.0) : 0.0;
    }
    DVec<2> at(double share) const { return right + (left - right) * share; }
    Vec3 weights_at(double share) const { return on_side(side, mirrored ? 1 - share : share); }

    /// The corner beyond the side, of which there is one.
    DVec<2> apex(const WalkTriangle& walk) const {
        const DVec<2> across = left - right;
        const double back = mirrored ? -walk.back[side] : walk.back[side], away = walk.away[side];
        return {0.5 * (right.x + left.x) - back * across.x + away * across.y,
                0.5 * (right.y + left.y) - back * across.y - away * across.x};
    }

    /// Over the side, into the triangle with this third corner: next it is left by that side of its other two that the
    /// corner is the left end of, or the right one.
    void enter(const WalkLink& link, const DVec<2>& corner, bool as_left) {
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
        const DVec<2> last = right;
        right = left;
        left = rest;
        rest = last;
        side = mirrored ? next_corner(next_corner(side)) : next_corner(side);
    }

    /// The weights of a point, in the order of the triangle's corners.
    DVec<3> weights(const DVec<2>& point) const {
        const DVec<2> across = left - right, to_rest = rest - right, to_point = point - right;
        const double scale = 1 / cross(across, to_rest);
        const double of_rest = cross(across, to_point) * scale, of_left = cross(to_point, to_rest) * scale;
        return in_order(1 - of_left - of_rest, of_left, of_rest);
    }

    /// Its first axis, in these coordinates, times |corner 1 - corner 0|.
    DVec<2> first_axis() const {
        const DVec<2>&from = mirrored ? left : right, to = mirrored ? right : left;
        return side == 0 ? to - from : (side == 1 ? from - rest : rest - to);
    }

    /// Seen in a mirror that stands on the way.
    void reflect() {
        std::swap(right, left);
        right.y = -right.y;
        left.y = -left.y;
        rest.y = -rest.y;
        mirrored = !mirrored;
    }
    /// The way begins anew, `by` ahead and to the left of where it began.
    void move_origin(const DVec<2>& by) {
        right -= by;
        left -= by;
        rest -= by;
    }

    /// Numbers of the corners `right`, `left` and `rest`, as they are numbered in the triangle.
    DVec<3> in_order(double of_right, double of_left, double of_rest) const {
        const double from = mirrored ? of_left : of_right, to = mirrored ? of_right : of_left;
        return side == 0 ? DVec<3>(from, to, of_rest)
                         : (side == 1 ? DVec<3>(of_rest, from, to) : DVec<3>(to, of_rest, from));
    }
};

/// The triangle that a way begins in: `at` a place in it, and on from there along `ahead` of length 1, both in its
/// frame. `near`: ends of sides that are as near to the way as this, as a share of how far ahead they are, lie on it.
WalkStrip strip_ahead(const WalkTriangle& walk, std::uint32_t triangle, const DVec<2>& at, const DVec<2>& ahead,
                      double near = 0);

}  // namespace abut
