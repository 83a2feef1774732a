#pragma once

// A shape known by how far it is from every point: what the questions see of a field, or of a distance function of a
// user's own.

#include <abut/convex/support.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace abut {

/// A signed distance, and the direction in which it grows most.
template <int D>
struct FieldSample {
    float distance = std::numeric_limits<float>::infinity();  ///< below zero inside
    Vec<D> normal{};                                          ///< of length 1, out of the shape
};

/// A lower bound of a distance in a box, by planes through its middle: the distance is at least
/// value + dot(gradient, x - middle), and wanted_value + dot(wanted, x - middle), and `least`.
template <int D>
struct DistanceBound {
    double value = 0;
    DVec<D> gradient{0.0};  ///< one that suits the box
    double least = -std::numeric_limits<double>::infinity();

    DVec<D> bend{0.0};  ///< along each axis about how much of the distance the planes miss because the box is so wide

    DVec<D> wanted{0.0};  ///< set by the caller: a gradient
    double wanted_value = -std::numeric_limits<double>::infinity();
    /// Set by the caller: if the distance surely is more everywhere in the box, the bound need not be better than that.
    double enough = std::numeric_limits<double>::infinity();

    DVec<D> anchor{0.0};         ///< set by the caller: the point near which the bound should be tight
    bool needs_gradient = true;  ///< set by the caller; if false, a smooth box has only `least`, `bend` and `corners`
    bool only_cut = false;       ///< set by the caller: a box that isn't smooth only needs a place to be cut at

    /// Whether the distance has no kink in the box. Then it is nowhere below the function that is linear along each
    /// axis and has the values `corners` at the corners of the box; bit a of a corner's index chooses the upper side of
    /// axis a.
    bool is_smooth = false;
    std::array<double, std::size_t{1} << D> corners{};
    int cut_axis = -1;  ///< the axis across which a kink divides the box best; -1: none
    double cut = 0;     ///< where it does, along that axis
};

/// What a function tells of a box.
enum class DistanceKnown : std::uint8_t {
    nothing,           ///< that isn't told by its distances and its slope
    in_smaller_boxes,  ///< it is too large to be looked at as a whole; `least` alone is valid
    bound,
};

/// The first place of a line at which a distance leaves a range.
struct DistanceCrossing {
    double along = 0;    ///< in lengths of the direction
    bool found = false;  ///< not: it stays in the range as far as the line goes
    bool below = false;  ///< it gets to the lower end
};

/// From where to where a distance may go, both in the shape's own lengths; it begins between them.
struct DistanceRange {
    double low = 0, high = std::numeric_limits<double>::infinity();
};

/// All places where a signed distance is at most 0, placed. Refers to the shape and must not outlive it.
///
/// Stretched by different factors it is the same set, but the distance is no more than a lower bound of the true one:
/// that of the shape's own frame times the least factor. Flattened it is no shape: `is_finite` is false.
template <int D>
struct DistanceFunction : Placement<D> {
    Aabb<D> bounds;  ///< in the shape's own frame: around all places where the distance is at most 0
    const void* object = nullptr;
    /// Of a point of the shape's own frame; of two points it differs by no more than `slope` times what they are apart.
    float (*distance)(const void* object, const Vec<D>& point) = nullptr;
    /// The same with the direction; null: told by differences.
    FieldSample<D> (*sample)(const void* object, const Vec<D>& point) = nullptr;
    /// The distance in double, and how it grows along each axis; set wherever `bound` is.
    double (*gradient)(const void* object, const DVec<D>& point, DVec<D>& gradient) = nullptr;
    /// How small details are that a search need not look for, in the shape's own frame: a field's cell. 0: unknown.
    float resolution = 0;
    /// At least 1: what is interpolated between samples of a distance may be steeper than that.
    float slope = 1;
    /// What it surely is at least in a box of the shape's own frame, and about as much. Null: no more is known than the
    /// slope.
    DistanceKnown (*bound)(const void* object, const DVec<D>& low, const DVec<D>& high,
                           DistanceBound<D>& bound) = nullptr;
    /// Where a line of the shape's own frame leaves a range, with no step so wide that something is passed. The
    /// direction is of any length. Null: found by steps as long as the distance.
    DistanceCrossing (*crossing)(const void* object, const DVec<D>& origin, const DVec<D>& direction, double reach,
                                 const DistanceRange& range) = nullptr;
};

/// By how much lengths in the shape's own frame grow at least where it is placed; zero where it is flattened.
template <int D>
double least_factor(const Placement<D>& placement);

}  // namespace abut
