#pragma once

// Fits a box, a capsule or a ball to a convex part. Such shapes are cheaper to query and easier to author.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <optional>
#include <variant>

namespace abut {

struct FitOptions {
    /// Largest error as a share of the part's breadth: half the middle one of the edges of its oriented bounding box.
    /// The error of a long rod is thus measured against its thickness.
    double tolerance = 0.05;
    /// Grows the shape until it contains the part. Boxes always contain it.
    bool hold = false;
};

struct Fit {
    std::variant<Ball<3>, Capsule<3>, Box<3>> shape;
    /// The Hausdorff distance of the two surfaces, as a length, exact but for rounding: for convex bodies it is
    /// attained at corners and faces.
    double error = 0;
    /// No corner of the part is outside by more than 1e-6 of its size.
    bool contains = false;
};

/// Fits the shape with the smallest error, or nothing if no error is within the tolerance. A ball is preferred to a
/// capsule, and a capsule to a box, if its error is larger by at most a tenth of the tolerance.
///
/// A box is the oriented bounding box, starting from the principal axes and rotated to a local minimum of the volume.
/// Balls and capsules are halfway between the part's inscribed and circumscribed ones, found by subgradient descent. A
/// flat part can be a box of zero thickness; a segment or a point is not fitted. O(corners + faces), with a factor of
/// some thousands.
std::optional<Fit> fit(const Polyhedron& part, const FitOptions& options = {});

}  // namespace abut
