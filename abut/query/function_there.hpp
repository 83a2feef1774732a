#pragma once

// A distance function as a search sees it: in double, in lengths of the world, in a frame that suits it. For .cpp
// files.

#include <abut/shape/view/distance_function.hpp>

#include <cmath>

namespace abut {

/// The frame in which a shape's own axes are straight, where that changes no angle; else the world's.
template <int D>
Affine<D> own_frame(const Placement<D>& placement) {
    Affine<D> result;
    result.offset = placement.place.offset;
    if (!placement.similar || !(placement.scale > 0)) return result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i)
        result.column[i] = placement.place.column[i] / placement.scale;
    return result;
}

/// The way back from a frame that keeps all lengths.
template <int D>
Affine<D> back_from(const Affine<D>& rigid) {
    Affine<D> result;
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            result.column[static_cast<std::size_t>(i)][j] = rigid.column[static_cast<std::size_t>(j)][i];
    result.offset = -result.vector(rigid.offset);
    return result;
}

/// Refers to a function, which is finite.
template <int D>
class FunctionThere {
public:
    /// `function` as it is seen in the frame.
    explicit FunctionThere(const DistanceFunction<D>& function)
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
    /// Of the world in one of the function's own.
    double factor() const { return factor_; }
    /// The distance in its own frame where in the world it is 0.
    double level() const { return level_; }
    const Affine<D>& back() const { return back_; }
    /// In lengths of the world; 0: unknown.
    double resolution() const { return resolution_; }
    double slope() const { return static_cast<double>(function_.slope); }

    double at(const DVec<D>& point) const {
        const auto own = static_cast<double>(function_.distance(function_.object, to_float(back_.point(point))));
        // What is no number is nowhere near.
        return own == own ? factor_ * (own - level_) : std::numeric_limits<double>::infinity();
    }

    /// How it changes, by what it is `step` to both sides.
    DVec<D> gradient(const DVec<D>& point, double step) const {
        DVec<D> result(0.0);
        for (int i = 0; i < D; ++i) {
            const DVec<D> aside = axis<D>(i, step);
            const double change = at(point + aside) - at(point - aside);
            result[i] = std::isfinite(change) ? change / (2 * step) : 0;
        }
        return result;
    }

    /// About what it is at least in a box, by what it is in the middle and at the sides: a plane, lowered by twice as
    /// much as it may be below that if it bends once along each axis.
    DistanceBound<D> guess(const DVec<D>& center, const DVec<D>& half, double here) const {
        DistanceBound<D> result;
        result.value = here;
        const double least = 1e-3 * largest(half);
        for (int i = 0; i < D; ++i) {
            const double reach = std::max(half[i], least);
            const DVec<D> aside = axis<D>(i, reach);
            const double after = at(center + aside), before = at(center - aside), bend = after + before - 2 * here;
            if (!std::isfinite(bend)) continue;
            result.gradient[i] = (after - before) / (2 * reach);
            result.value -= std::max(-bend, 0.5 * bend);
        }
        return result;
    }

    /// The direction in which it grows most, of length 1.
    DVec<D> normal(const DVec<D>& point, double step) const {
        if (function_.sample != nullptr) {
            const Vec<D> own = function_.sample(function_.object, to_float(back_.point(point))).normal;
            const DVec<D> there = back_.transposed(DVec<D>(own));
            const double size = length(there);
            if (size > 0 && std::isfinite(size)) return there / size;
        }
        return normalized(gradient(point, step));
    }

    /// So far apart differences are taken: by much more than coordinates are rounded, and less than what is asked
    /// about.
    double step(const DVec<D>& point, double size) const {
        const double rounding = 1e-4 * largest(back_.point(point)) * factor_;
        return std::max({1e-3 * size, rounding, 0.25 * resolution_});
    }

    /// Where the function bounds itself: the distance in double, and how it grows along each axis.
    double at(const DVec<D>& point, DVec<D>& gradient) const {
        const double own = function_.gradient(function_.object, back_.point(point), gradient);
        gradient = back_.transposed(gradient) * factor_;
        return factor_ * (own - level_);
    }

    /// A lower bound in a box, as exactly as the function knows it.
    DistanceBoundStatus bound(const DVec<D>& center, const DVec<D>& half, DistanceBound<D>& bound) const {
        if (function_.bound == nullptr) return DistanceBoundStatus::unknown;
        const DVec<D> middle = back_.point(center);
        DVec<D> own_half(0.0);
        for (int i = 0; i < D; ++i)
            for (int j = 0; j < D; ++j) own_half[i] += std::abs(back_.column[static_cast<std::size_t>(j)][i]) * half[j];
        const DVec<D> wanted = bound.requested_gradient, anchor = bound.anchor;
        bound.requested_gradient = function_.place.transposed(wanted) / factor_;
        bound.sufficient = bound.sufficient / factor_ + level_;
        bound.anchor = back_.point(anchor);
        const DistanceBoundStatus known =
            function_.bound(function_.object, middle - own_half, middle + own_half, bound);
        bound.requested_gradient = wanted;
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
            double own_half = 0;
            for (int j = 0; j < D; ++j) own_half += std::abs(back_.column[static_cast<std::size_t>(j)][i]) * half[j];
            result[static_cast<std::size_t>(i)] *= own_half;
        }
        return result;
    }

private:
    const DistanceFunction<D>& function_;
    Affine<D> back_;
    double factor_, level_, resolution_;
    bool has_own_axes_ = true;  ///< the axes of the frame are those of the function
};

}  // namespace abut
