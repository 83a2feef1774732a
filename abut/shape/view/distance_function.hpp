#pragma once

// A shape given by a signed distance function (SDF): the view of a field, or of a user's own distance function.

#include <abut/convex/support.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace abut {

/// A signed distance and its gradient direction.
template <int D>
struct FieldSample {
    float distance = std::numeric_limits<float>::infinity();  ///< below zero inside
    Vec<D> normal{};                                          ///< unit vector, out of the shape
};

}  // namespace abut

namespace abut::detail {

/// A lower bound of a signed distance in a box, by planes through the box's middle. The distance is at least `value +
/// dot(gradient, x - middle)`, at least `requested_value + dot(requested_gradient, x - middle)`, and at least
/// `lower_bound`.
template <int D>
struct DistanceBound {
    /// Takes a piece of a box, from its lower to its upper corner, and the bound there.
    using PieceVisitor = FunctionRef<void(const DVec<D>& low, const DVec<D>& high, DistanceBound& piece)>;
    /// A box of more pieces isn't divided.
    static constexpr int max_pieces = 64;

    double value = 0;
    DVec<D> gradient{0.0};  ///< a gradient that fits the box
    double lower_bound = -std::numeric_limits<double>::infinity();

    DVec<D> curvature{0.0};  ///< along each axis, about how much the plane bound loses by the width of the box

    DVec<D> requested_gradient{0.0};  ///< input: a gradient
    double requested_value = -std::numeric_limits<double>::infinity();
    /// Input: the search may stop once the distance is known to exceed this everywhere in the box.
    double sufficient = std::numeric_limits<double>::infinity();

    DVec<D> anchor{0.0};         ///< input: the point near which the bound should be tight
    bool needs_gradient = true;  ///< input; if false, a smooth box has only `lower_bound`, `curvature` and `corners`
    bool only_cut = false;       ///< input: a box that isn't smooth only needs a place to be cut at

    /// Input, or null: a box with few kinks may be divided into its smooth pieces, which are visited. A piece is left
    /// out if it has no point where the distance is at most `sufficient` and dot(requested_gradient, x) is at least
    /// `requested_support`.
    const PieceVisitor* visit_piece = nullptr;
    double requested_support = -std::numeric_limits<double>::infinity();

    /// Whether the distance has no kink in the box. Then it is nowhere below the function that is linear along each
    /// axis and has the values `corners` at the corners of the box; bit a of a corner's index chooses the upper side of
    /// axis a.
    bool is_smooth = false;
    std::array<double, std::size_t{1} << D> corners{};
    int cut_axis = -1;  ///< the axis across which a kink divides the box best; -1: none
    double cut = 0;     ///< where it does, along that axis
};

/// The result of a bound query for a box.
enum class DistanceBoundStatus : std::uint8_t {
    box_too_large,  ///< the box is too large for a plane bound; only `lower_bound` is valid
    divided,        ///< the pieces were visited
    valid,
};

/// The first point of a line at which a distance leaves a range.
struct DistanceCrossing {
    double along = 0;    ///< parameter on the line, in lengths of the direction
    bool found = false;  ///< false: the distance stays in the range over the whole line
    bool below = false;  ///< it leaves at the lower end
};

/// The range of distances, in the shape's local frame. The line starts inside it.
struct DistanceRange {
    double low = 0, high = std::numeric_limits<double>::infinity();
};

}  // namespace abut::detail

namespace abut {

/// The set of points whose signed distance is at most 0, with a placement. Refers to the shape and must not outlive it.
///
/// Under a non-uniform scale the set is exact, but the distance is only a lower bound: the local distance times the
/// smallest scale factor. If a factor is 0, `is_finite` is false.
template <int D>
struct DistanceFunction : detail::Placement<D> {
    Aabb<D> bounds;  ///< in the local frame: the box around all points whose distance is at most 0
    const void* object = nullptr;
    /// The signed distance of a point in the local frame. It is Lipschitz continuous with constant `slope`.
    float (*distance)(const void* object, const Vec<D>& point) = nullptr;
    /// The distance and the gradient direction. Null: the gradient is found by differences.
    FieldSample<D> (*sample)(const void* object, const Vec<D>& point) = nullptr;
    /// The distance in double, and its gradient. It is set if `bound` is set.
    double (*gradient)(const void* object, const detail::DVec<D>& point, detail::DVec<D>& gradient) = nullptr;
    /// The size of the smallest details that a search has to find, in the local frame, such as a field's cell. 0:
    /// unknown.
    float resolution = 0;
    /// The Lipschitz constant, at least 1. Interpolation between samples of a distance may be steeper than 1.
    float slope = 1;
    /// A lower bound of the distance in a box of the local frame. Null: only the Lipschitz bound is known.
    detail::DistanceBoundStatus (*bound)(const void* object, const detail::DVec<D>& low, const detail::DVec<D>& high,
                                         detail::DistanceBound<D>& bound) = nullptr;
    /// The first crossing of a line in the local frame out of a range. It never steps over a crossing. The direction
    /// may have any length. Null: the line is sphere traced.
    detail::DistanceCrossing (*crossing)(const void* object, const detail::DVec<D>& origin,
                                         const detail::DVec<D>& direction, double reach,
                                         const detail::DistanceRange& range) = nullptr;
};

}  // namespace abut

namespace abut::detail {

/// A lower bound of the placement's smallest scale factor (its smallest singular value); 0 if the shape is flattened.
template <int D>
double min_scale_factor(const Placement<D>& placement);

}  // namespace abut::detail
