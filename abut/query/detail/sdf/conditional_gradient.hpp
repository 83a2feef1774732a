#pragma once

// Local minima of a function over a convex set or over the hull of its path. For .cpp files.
//
// Conditional gradients with pairwise steps improve points (Frank, Wolfe 1956; Lacoste-Julien, Jaggi, "On the global
// linear convergence of Frank-Wolfe optimization variants", 2015). They need the support function only.

#include <abut/query/detail/sdf/box_search.hpp>

namespace abut::detail {

/// A point of the hull of a path: its position, and then the share of the path at which the set contains it. Without
/// rotation the share is exact.
template <int D>
using PathPoint = glm::vec<D + 1, double>;

template <int D>
PathPoint<D> path_point(const DVec<D>& position, double share) {
    return PathPoint<D>(position, share);
}
template <int D>
double share_of(const PathPoint<D>& point) {
    return point[D];
}

/// The core of a convex set, or the hull of it at the start and at the end of its path.
template <int D>
class PathHull {
public:
    /// `last` is the end of the path; null: the set doesn't move.
    PathHull(const Convex<D>& first, const Convex<D>* last) : first_(first), last_(last) {
        first_.radius = 0;
        if (last_ != nullptr && last_->place.column == first_.place.column) {
            translation_ = path_point<D>(last_->place.offset - first_.place.offset, 1);
            is_translation_ = true;
        }
    }

    bool moves() const { return last_ != nullptr; }

    /// The point that minimises dot(gradient, p).
    PathPoint<D> lowest(const DVec<D>& gradient) const {
        const PathPoint<D> low = path_point<D>(core_support(first_, -gradient).position, 0);
        if (last_ == nullptr) return low;
        const PathPoint<D> low_last =
            is_translation_ ? low + translation_ : path_point<D>(core_support(*last_, -gradient).position, 1);
        return dot(gradient, DVec<D>(low_last - low)) < 0 ? low_last : low;
    }

private:
    Convex<D> first_;
    const Convex<D>* last_;
    PathPoint<D> translation_{0.0};
    bool is_translation_ = false;
};

/// A point of a set as a convex combination of other points of the set, for pairwise steps of Frank-Wolfe.
template <int D>
class ConvexCombination {
public:
    explicit ConvexCombination(const PathPoint<D>& point) : count_(1) {
        points_[0] = point;
        weights_[0] = 1;
    }

    /// The point that is farthest up a gradient.
    std::size_t highest(const DVec<D>& gradient) const {
        std::size_t result = 0;
        for (std::size_t i = 1; i < count_; ++i)
            if (dot(gradient, DVec<D>(points_[i])) > dot(gradient, DVec<D>(points_[result]))) result = i;
        return result;
    }
    const PathPoint<D>& point(std::size_t i) const { return points_[i]; }
    double weight(std::size_t i) const { return weights_[i]; }

    /// Moves a share of all weights to a point between two others.
    void shift_all(const PathPoint<D>& first, const PathPoint<D>& second, double part, double share) {
        for (std::size_t i = 0; i < count_; ++i) weights_[i] *= 1 - share;
        add(first, share * (1 - part));
        add(second, share * part);
    }
    void shift(std::size_t from, const PathPoint<D>& to, double weight) {
        weights_[from] -= weight;
        if (!(weights_[from] > 1e-12)) {
            weight += weights_[from];
            points_[from] = points_[--count_];
            weights_[from] = weights_[count_];
        }
        add(to, weight);
    }

private:
    void add(const PathPoint<D>& to, double weight) {
        for (std::size_t i = 0; i < count_; ++i)
            if (points_[i] == to) {
                weights_[i] += weight;
                return;
            }
        if (count_ == points_.size()) merge_lightest();
        points_[count_] = to;
        weights_[count_++] = weight;
    }
    void merge_lightest() {
        for (int k = 0; k < 2; ++k) {
            const std::size_t last = count_ - 1 - static_cast<std::size_t>(k);
            for (std::size_t i = 0; i < last; ++i)
                if (weights_[i] < weights_[last]) {
                    std::swap(weights_[i], weights_[last]);
                    std::swap(points_[i], points_[last]);
                }
        }
        const double sum = weights_[count_ - 1] + weights_[count_ - 2];
        const double share = weights_[count_ - 1] / sum;
        points_[count_ - 2] += (points_[count_ - 1] - points_[count_ - 2]) * share;
        weights_[count_ - 2] = sum;
        --count_;
    }

    std::array<PathPoint<D>, static_cast<std::size_t>(D) + 3> points_;
    std::array<double, static_cast<std::size_t>(D) + 3> weights_{};
    std::size_t count_;
};

/// A gradient of the function near its minimum, and the lower bound of dot(gradient, p) over the set.
template <int D>
struct SupportPlane {
    DVec<D> gradient;
    double lower_bound;
};

template <int D>
struct LocalMinimum {
    PathPoint<D> point;
    double value;
    SupportPlane<D> support;
};

template <int D>
class ConditionalGradient {
public:
    /// A descent stops at a value of at most `sufficient`.
    ConditionalGradient(const PlacedFunction<D>& function, const PathHull<D>& set, double tolerance, double sufficient)
        : function_(function), set_(set), tolerance_(tolerance), sufficient_(sufficient) {}

    /// Descends from a point of the set to a local minimum. If that lies at the side of a cell, the set has no support
    /// plane perpendicular to either gradient, but one perpendicular to a gradient between them.
    LocalMinimum<D> descend(const PathPoint<D>& from) const {
        ConvexCombination<D> mean(from);
        PathPoint<D> here = from;
        DVec<D> gradient;
        double value = value_at(here, gradient);
        DVec<D> slope = gradient;
        PathPoint<D> support_point = set_.lowest(slope);
        for (int step = 0; step < search_max_descent_steps && value > sufficient_; ++step) {
            const double predicted_decrease = along(slope, here - support_point);
            if (!(predicted_decrease > 0.25 * tolerance_)) break;
            const std::size_t highest = mean.highest(slope);
            const PathPoint<D> direction = support_point - mean.point(highest);
            const LineSearchEnd end = line_search(here, value, gradient, direction, mean.weight(highest));
            if (end.value < value) {
                here += direction * end.part;
                mean.shift(highest, support_point, end.part);
            }
            const bool is_large_step = value - end.value > 0.1 * predicted_decrease;
            value = std::min(value, end.value);
            const bool is_stuck = end.part == 0;
            gradient = end.gradient;
            if (!end.is_bracketed) {
                slope = gradient;
            } else {
                const CombinedGradient mixed = combined(here, is_large_step ? gradient : slope, end.beyond);
                slope = mixed.gradient;
                // At a kink, go along the side of the cells, between the support points of both gradients.
                const PathPoint<D> aside = mixed.target() - here;
                const LineSearchEnd further =
                    is_stuck ? line_search(here, value, mixed.gradient, aside, 1) : LineSearchEnd();
                if (is_stuck && further.value < value) {
                    here += aside * further.part;
                    mean.shift_all(mixed.first, mixed.second, mixed.part, further.part);
                    value = further.value;
                    gradient = further.gradient;
                    if (further.is_bracketed) slope = combined(here, slope, further.beyond).gradient;
                } else if (is_stuck) {
                    if (further.is_bracketed) slope = combined(here, slope, further.beyond).gradient;
                    if (!(along(slope, here - set_.lowest(slope)) < 0.99 * predicted_decrease)) break;
                }
            }
            support_point = set_.lowest(slope);
        }
        return {here, value, {slope, along(slope, support_point)}};
    }

private:
    /// The end of a line search, with the gradients there and on the far side.
    struct LineSearchEnd {
        double part = 0, value = 0;
        DVec<D> gradient, beyond;
        bool is_bracketed = false;  ///< the function rises beyond it
    };

    /// A gradient between two gradients, and a point between the two support points for it, both of which predict the
    /// same decrease.
    struct CombinedGradient {
        DVec<D> gradient;
        PathPoint<D> first, second;
        double part = 0;

        PathPoint<D> target() const { return first + (second - first) * part; }
    };

    static double along(const DVec<D>& gradient, const PathPoint<D>& way) { return dot(gradient, DVec<D>(way)); }
    double value_at(const PathPoint<D>& point, DVec<D>& gradient) const {
        return function_.at(DVec<D>(point), gradient);
    }

    /// Searches the minimum along a line. It may lie at the side of a cell, where tangents from both sides cross, or
    /// inside a cell, where secants of the slope find it.
    LineSearchEnd line_search(const PathPoint<D>& here, double value, const DVec<D>& gradient,
                              const PathPoint<D>& direction, double max_part) const {
        LineSearchEnd end{0, value, gradient, gradient};
        double before = 0, value_before = value, slope_before = std::min(along(gradient, direction), 0.0);
        double part = max_part, after = 0, value_after = 0, slope_after = 0;
        for (int i = 0; i < search_max_line_steps; ++i) {
            DVec<D> slope;
            const double sampled = value_at(here + direction * part, slope), rise = along(slope, direction);
            if (sampled < end.value) {
                end.value = sampled;
                end.part = part;
                end.gradient = slope;
            }
            if (sampled < value_before && rise <= 0) {
                before = part;
                value_before = sampled;
                slope_before = rise;
                end.gradient = slope;
                if (part == max_part) return end;
            } else {
                end.is_bracketed = true;
                end.beyond = slope;
                after = part;
                value_after = sampled;
                slope_after = rise;
            }
            if (!end.is_bracketed) return end;
            const double wide = after - before;
            double share = 0.5;
            if (slope_after > 0 && slope_before < 0) {
                const double crossing =
                    (value_after - slope_after * wide - value_before) / ((slope_before - slope_after) * wide);
                if (value_before + slope_before * wide * crossing > end.value - 0.1 * tolerance_) break;
                share = i % 2 == 0 ? crossing : slope_before / (slope_before - slope_after);
            }
            if (!(share > 0.01)) share = 0.1;
            part = before + wide * std::clamp(share, 0.02, 0.98);
        }
        return end;
    }

    /// The gradient between two that predicts the least decrease. The prediction is convex in the weight: tangents
    /// cross at the minimum, which is exact after a few steps if the set has corners.
    CombinedGradient combined(const PathPoint<D>& here, const DVec<D>& first, const DVec<D>& second) const {
        const DVec<D> change = second - first;
        double low = 0, high = 1;
        PathPoint<D> at = set_.lowest(first);
        CombinedGradient result{first, at, at};
        double at_low = along(first, here - at), slope_before = along(change, here - at);
        if (!(slope_before < 0)) return result;
        at = set_.lowest(second);
        double at_high = along(second, here - at), slope_after = along(change, here - at);
        if (!(slope_after > 0)) return {second, at, at};
        result.second = at;
        if (at_high < at_low) result.gradient = second;
        double predicted_decrease = std::min(at_low, at_high);
        for (int i = 0; i < search_max_line_steps; ++i) {
            const double wide = high - low;
            const double share =
                low + std::clamp((at_high - at_low - slope_after * wide) / (slope_before - slope_after), 0.0, wide);
            const DVec<D> between = first + change * share;
            at = set_.lowest(between);
            const double sampled = along(between, here - at), grows = along(change, here - at);
            if (sampled < predicted_decrease) {
                predicted_decrease = sampled;
                result.gradient = between;
            }
            if (sampled <= at_low + slope_before * (share - low) + 0.05 * tolerance_) break;
            if (grows < 0) {
                low = share;
                at_low = sampled;
                slope_before = grows;
                result.first = at;
            } else {
                high = share;
                at_high = sampled;
                slope_after = grows;
                result.second = at;
            }
        }
        result.part = slope_before / (slope_before - slope_after);
        return result;
    }

    const PlacedFunction<D>& function_;
    const PathHull<D>& set_;
    double tolerance_, sufficient_;
};

}  // namespace abut::detail
