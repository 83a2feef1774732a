#pragma once

// A distance function in the frame of a search: in double, in lengths of the world. For .cpp files.

#include <abut/shape/view/distance_function.hpp>

#include <cmath>

namespace abut::detail {

/// The frame in which the shape's local axes are axis-aligned, if its placement preserves angles; else the world's.
template <int D>
Affine<D> own_frame(const Placement<D>& placement) {
    Affine<D> result;
    result.offset = placement.place.offset;
    if (!placement.similar || !(placement.scale > 0)) return result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i)
        result.column[i] = placement.place.column[i] / placement.scale;
    return result;
}

/// The inverse of a rigid frame.
template <int D>
Affine<D> back_from(const Affine<D>& rigid) {
    Affine<D> result;
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            result.column[static_cast<std::size_t>(i)][j] = rigid.column[static_cast<std::size_t>(j)][i];
    result.offset = -result.vector(rigid.offset);
    return result;
}

/// How much a plane rises from the middle of a box to its highest corner.
template <int D>
double sum_along(const DVec<D>& gradient, const DVec<D>& half) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += std::abs(gradient[i]) * half[i];
    return result;
}

/// A function that gives no bounds but its slope is estimated from samples in the centre and at the sides of cells of
/// this fraction of the size, down to the second fraction.
inline constexpr double estimated_cell_fraction = 1.0 / 8, min_cell_fraction = 1e-3;

/// A function placed in a frame. It refers to the function, which must be finite.
template <int D>
class PlacedFunction {
public:
    /// `function` is placed in the frame.
    explicit PlacedFunction(const DistanceFunction<D>& function)
        : function_(function),
          back_(inverse(function.place, determinant(function.place))),
          factor_(min_scale_factor<D>(function)),
          level_(function.inner_radius + function.radius / factor_),
          resolution_(static_cast<double>(function.resolution) * factor_) {
        for (int i = 0; i < D; ++i) {
            const DVec<D>& column = function.place.column[static_cast<std::size_t>(i)];
            for (int j = 0; j < D; ++j)
                if (i != j && !(std::abs(column[j]) <= 1e-12 * column[i])) has_own_axes_ = false;
        }
    }

    const DistanceFunction<D>& function() const { return function_; }
    /// The length in the world of a unit of the function's local frame.
    double factor() const { return factor_; }
    /// The local distance at the surface, where the distance in the world is 0.
    double level() const { return level_; }
    const Affine<D>& back() const { return back_; }
    /// In lengths of the world; 0: unknown.
    double resolution() const { return resolution_; }
    double slope() const { return static_cast<double>(function_.slope); }

    double at(const DVec<D>& point) const {
        const auto own = static_cast<double>(function_.distance(function_.object, to_float(back_.point(point))));
        // NaN counts as infinitely far.
        return own == own ? factor_ * (own - level_) : std::numeric_limits<double>::infinity();
    }

    /// The unit vector of steepest ascent.
    DVec<D> normal(const DVec<D>& point, double step) const {
        if (function_.sample != nullptr) {
            const Vec<D> own = function_.sample(function_.object, to_float(back_.point(point))).normal;
            const DVec<D> global = back_.transposed(DVec<D>(own));
            const double size = length(global);
            if (size > 0 && std::isfinite(size)) return global / size;
        }
        return normalized(differences(point, step));
    }

    /// The step of central differences: much larger than the rounding of coordinates, and smaller than `size`.
    double step(const DVec<D>& point, double size) const {
        const double rounding = 1e-4 * largest(back_.point(point)) * factor_;
        return std::max({1e-3 * size, rounding, 0.25 * resolution_});
    }

    /// The distance, in double if the function bounds itself, and its gradient.
    double at(const DVec<D>& point, DVec<D>& gradient) const {
        if (function_.gradient == nullptr) {
            gradient = differences(point, step_);
            return at(point);
        }
        const double own = function_.gradient(function_.object, back_.point(point), gradient);
        gradient = back_.transposed(gradient) * factor_;
        return factor_ * (own - level_);
    }

    /// The size of what a search looks for, about a point. A function that gives no bounds has no details smaller than
    /// a fraction of it.
    void set_size(const DVec<D>& middle, double size) {
        step_ = step(middle, size);
        cell_size_ = resolution_ > 0 ? resolution_ : estimated_cell_fraction * size;
        min_cell_size_ = min_cell_fraction * size;
    }

    /// A lower bound in a box, as exact as the function gives it.
    DistanceBoundStatus bound(const DVec<D>& center, const DVec<D>& half, DistanceBound<D>& bound) const {
        if (function_.bound == nullptr) return estimate(center, half, bound);
        const DVec<D> middle = back_.point(center);
        DVec<D> own_half(0.0);
        for (int i = 0; i < D; ++i)
            for (int j = 0; j < D; ++j) own_half[i] += std::abs(back_.column[static_cast<std::size_t>(j)][i]) * half[j];
        const DVec<D> requested = bound.requested_gradient, anchor = bound.anchor;
        bound.requested_gradient = function_.place.transposed(requested) / factor_;
        bound.sufficient = bound.sufficient / factor_ + level_;
        bound.anchor = back_.point(anchor);
        const typename DistanceBound<D>::PieceVisitor* const visit = has_own_axes_ ? bound.visit_piece : nullptr;
        const auto visit_own = [&](const DVec<D>& low, const DVec<D>& high, DistanceBound<D>& piece) {
            for (double& value : piece.corners) value = factor_ * (value - level_);
            piece.lower_bound = factor_ * (piece.lower_bound - level_);
            piece.curvature *= factor_;
            (*visit)(function_.place.point(low), function_.place.point(high), piece);
        };
        const typename DistanceBound<D>::PieceVisitor visitor(visit_own);
        bound.visit_piece = visit != nullptr ? &visitor : nullptr;
        bound.requested_support = (bound.requested_support - dot(requested, function_.place.offset)) / factor_ + level_;
        const DistanceBoundStatus known =
            function_.bound(function_.object, middle - own_half, middle + own_half, bound);
        if (known == DistanceBoundStatus::divided) return known;
        bound.requested_gradient = requested;
        bound.anchor = anchor;
        bound.lower_bound = factor_ * (bound.lower_bound - level_);
        if (bound.cut_axis >= 0) {
            if (has_own_axes_)
                bound.cut =
                    function_.place.offset[bound.cut_axis] +
                    function_.place.column[static_cast<std::size_t>(bound.cut_axis)][bound.cut_axis] * bound.cut;
            else
                bound.cut_axis = -1;
        }
        if (known != DistanceBoundStatus::valid) return known;
        bound.value = factor_ * (bound.value - level_);
        bound.requested_value = factor_ * (bound.requested_value - level_);
        bound.gradient = back_.transposed(bound.gradient) * factor_;
        bound.curvature *= factor_;
        if (bound.is_smooth)
            for (double& value : bound.corners) value = factor_ * (value - level_);
        return known;
    }

    /// The half axes of the box that `bound` examines in place of a box of the frame.
    std::array<DVec<D>, static_cast<std::size_t>(D)> axes_of(const DVec<D>& half) const {
        std::array<DVec<D>, static_cast<std::size_t>(D)> result = function_.place.column;
        for (int i = 0; i < D; ++i) {
            if (function_.bound == nullptr) {
                result[static_cast<std::size_t>(i)] = axis<D>(i, half[i]);
                continue;
            }
            double own_half = 0;
            for (int j = 0; j < D; ++j) own_half += std::abs(back_.column[static_cast<std::size_t>(j)][i]) * half[j];
            result[static_cast<std::size_t>(i)] *= own_half;
        }
        return result;
    }

private:
    /// The gradient by central differences of this step.
    DVec<D> differences(const DVec<D>& point, double step) const {
        DVec<D> result(0.0);
        for (int i = 0; i < D; ++i) {
            const DVec<D> aside = axis<D>(i, step);
            const double change = at(point + aside) - at(point - aside);
            result[i] = std::isfinite(change) ? change / (2 * step) : 0;
        }
        return result;
    }

    /// A lower bound in a box by the slope. In a small one an estimate from samples in the centre and at the sides: a
    /// plane, lowered by twice its possible error if the function has one bend along each axis.
    DistanceBoundStatus estimate(const DVec<D>& center, const DVec<D>& half, DistanceBound<D>& bound) const {
        const double here = at(center), radius = length(half);
        bound.lower_bound = radius > min_cell_size_ ? here - slope() * radius : std::numeric_limits<double>::infinity();
        if (bound.lower_bound > bound.sufficient || radius > cell_size_) return DistanceBoundStatus::box_too_large;
        bound.value = here;
        for (int i = 0; i < D; ++i) {
            const double reach = std::max(half[i], 1e-3 * largest(half));
            const DVec<D> aside = axis<D>(i, reach);
            const double after = at(center + aside), before = at(center - aside),
                         second_difference = after + before - 2 * here;
            if (!std::isfinite(second_difference)) continue;
            bound.gradient[i] = (after - before) / (2 * reach);
            // Its slope limits how far it falls between the samples.
            bound.curvature[i] =
                std::max({-second_difference, 0.0,
                          std::min(0.5 * second_difference, slope() * reach - 0.5 * second_difference)});
            bound.value -= bound.curvature[i];
        }
        bound.requested_value = bound.value - sum_along(bound.gradient - bound.requested_gradient, half);
        bound.is_smooth = true;
        for (std::size_t i = 0; i < bound.corners.size(); ++i) {
            bound.corners[i] = bound.value;
            for (int a = 0; a < D; ++a)
                bound.corners[i] += bound.gradient[a] * ((i >> a & 1) != 0 ? half[a] : -half[a]);
        }
        return DistanceBoundStatus::valid;
    }

    const DistanceFunction<D>& function_;
    Affine<D> back_;
    double factor_, level_, resolution_;
    double step_ = 0, cell_size_ = 0, min_cell_size_ = 0;
    bool has_own_axes_ = true;  ///< the frame's axes are those of the function
};

}  // namespace abut::detail
