#pragma once

// Where a convex part is nearly a box, a capsule or a ball: those are cheaper to ask, and easier to author.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <optional>
#include <variant>

namespace abut {

struct FitOptions {
    /// How far off the shape may be, as a share of the part's breadth: half the middle one of the three edges of a
    /// tight box about it, so that a long rod is as good as its thickness asks for.
    double tolerance = 0.05;
    /// Grow the shape until it holds the whole part. Boxes always do.
    bool hold = false;
};

struct Fit {
    std::variant<Ball<3>, Capsule<3>, Box<3>> shape;
    /// A length: the farthest that a point of either surface is from the other surface (the Hausdorff distance, exact
    /// but for rounding: for convex bodies it is found at corners and faces).
    double error = 0;
    /// Whether no corner of the part is outside by more than 1e-6 of its size.
    bool contains = false;
};

/// The shape that a part nearly is, or nothing where none comes within the tolerance. The one that comes nearest; but
/// a ball rather than a capsule, and a capsule rather than a box, where it is as good to a tenth of the tolerance.
/// Boxes are tight: about the part's principal axes, turned until they can't get smaller.
/// Balls and capsules lie between the part's inside and its outside, as far from the one as from the other, by
/// subgradient descent. A flat part may be a box of zero thickness; what is a segment or a point is nothing.
/// O(corners + faces), with a factor of some thousands.
std::optional<Fit> fit(const Polyhedron& part, const FitOptions& options = {});

}  // namespace abut
