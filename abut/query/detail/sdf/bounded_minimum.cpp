// The minimum of a function that bounds itself, over a convex set known by its support function.
//
// The search is branch and bound over boxes. It cuts boxes at kinks of the function and through the best point so far.
// A plane below the function and a support plane of the set bound every box that may overlap the set. The support
// planes of the best points bound a box with kinks. The convex envelope of its corner values bounds a box without
// kinks; it is exact at the corners, so that boxes around a minimum shrink fast to it (convex_envelope.hpp).
//
// Conditional gradients with pairwise steps improve points (Frank, Wolfe 1956; Lacoste-Julien, Jaggi, "On the global
// linear convergence of Frank-Wolfe optimization variants", 2015). They need the support function only.

#include <abut/query/detail/sdf/branch_and_bound.hpp>
#include <abut/query/detail/sdf/convex_envelope.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

/// At the limit on fine boxes the minimum may be lower by this fraction of the size.
constexpr double coarse_tolerance = 1e-5;

/// The plane that splits a box in two.
struct Cut {
    int axis = -1;
    double at = 0;
};

/// A priority queue of boxes, the lowest bound first; of equals, the earlier one.
template <int D>
class SearchHeap {
public:
    struct Entry {
        SearchBox<D> box;
        Cut cut;
        std::uint32_t number;
    };

    bool empty() const { return count_ == 0; }
    bool full() const { return count_ + 2 > entries_.size(); }
    double lower_bound() const {
        return count_ > 0 ? entries_[0].box.lower_bound : std::numeric_limits<double>::infinity();
    }
    void push(const SearchBox<D>& box, const Cut& cut) {
        entries_[count_++] = {box, cut, number_++};
        std::push_heap(entries_.data(), entries_.data() + count_, is_later);
    }
    Entry pop() {
        std::pop_heap(entries_.data(), entries_.data() + count_, is_later);
        return entries_[--count_];
    }

private:
    static bool is_later(const Entry& a, const Entry& b) {
        return a.box.lower_bound != b.box.lower_bound ? a.box.lower_bound > b.box.lower_bound : a.number > b.number;
    }

    std::array<Entry, bounded_minimum_max_boxes / 2> entries_;
    std::size_t count_ = 0;
    std::uint32_t number_ = 0;
};

/// A point of a set as a convex combination of other points of the set, for pairwise steps of Frank-Wolfe.
template <int D>
class ConvexCombination {
public:
    explicit ConvexCombination(const DVec<D>& point) : count_(1) {
        points_[0] = point;
        weights_[0] = 1;
    }

    /// The point that is farthest up a gradient.
    std::size_t highest(const DVec<D>& gradient) const {
        std::size_t result = 0;
        for (std::size_t i = 1; i < count_; ++i)
            if (dot(gradient, points_[i]) > dot(gradient, points_[result])) result = i;
        return result;
    }
    const DVec<D>& point(std::size_t i) const { return points_[i]; }
    double weight(std::size_t i) const { return weights_[i]; }

    /// Moves a share of all weights to a point between two others.
    void shift_all(const DVec<D>& first, const DVec<D>& second, double part, double share) {
        for (std::size_t i = 0; i < count_; ++i) weights_[i] *= 1 - share;
        add(first, share * (1 - part));
        add(second, share * part);
    }
    void shift(std::size_t from, const DVec<D>& to, double weight) {
        weights_[from] -= weight;
        if (!(weights_[from] > 1e-12)) {
            weight += weights_[from];
            points_[from] = points_[--count_];
            weights_[from] = weights_[count_];
        }
        add(to, weight);
    }

private:
    void add(const DVec<D>& to, double weight) {
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

    std::array<DVec<D>, static_cast<std::size_t>(D) + 3> points_;
    std::array<double, static_cast<std::size_t>(D) + 3> weights_{};
    std::size_t count_;
};

template <int D>
class BoundedMinimum {
public:
    BoundedMinimum(const PlacedFunction<D>& function, const Convex<D>& convex, const Convex<D>* last,
                   const MinimumOptions<D>& options)
        : function_(function), convex_(convex), last_(last), options_(options) {
        convex_.radius = 0;
        if (last_ != nullptr && last_->place.column == convex_.place.column) {
            translation_ = last_->place.offset - convex_.place.offset;
            is_translation_ = true;
        }
        if (options_.max_boxes == 0) options_.max_boxes = bounded_minimum_max_boxes;
        DVec<D> low(0.0), high(0.0);
        for (int i = 0; i < D; ++i) {
            low[i] = lowest(axis<D>(i, 1))[i];
            high[i] = lowest(axis<D>(i, -1))[i];
        }
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
    }

    Minimum<D> run() {
        DVec<D> slope;
        function_.at(all_.center, slope);
        descend(lowest(slope));
        SearchHeap<D> heap;
        process(heap, all_);
        const double coarse = coarse_tolerance * size_;
        while (!heap.empty() && best_.distance > options_.sufficient && may_improve(heap.lower_bound())) {
            const bool is_coarse = best_.boxes >= bounded_minimum_max_fine_boxes &&
                                   heap.lower_bound() >= std::min(best_.distance - coarse, options_.sufficient_bound);
            if (is_coarse || best_.boxes >= options_.max_boxes || heap.full()) {
                best_.uncertainty = best_.distance - std::min(heap.lower_bound(), best_.distance);
                break;
            }
            const auto [box, cut, number] = heap.pop();
            const double from = box.center[cut.axis] - box.half[cut.axis],
                         until = box.center[cut.axis] + box.half[cut.axis];
            if (!(from < cut.at && cut.at < until)) continue;
            SearchBox<D> low = box, high = box;
            low.center[cut.axis] = 0.5 * (from + cut.at);
            low.half[cut.axis] = 0.5 * (cut.at - from);
            high.center[cut.axis] = 0.5 * (cut.at + until);
            high.half[cut.axis] = 0.5 * (until - cut.at);
            process(heap, low);
            process(heap, high);
        }
        best_.lower_bound = std::min(heap.lower_bound(), limit());
        if (best_.distance > options_.reach) best_.distance = std::numeric_limits<double>::infinity();
        return best_;
    }

private:
    /// A gradient of the function near its minimum, and the lower bound of dot(gradient, p) over the set.
    struct Support {
        DVec<D> gradient;
        double lower_bound;
    };

    /// The point of the set that minimises dot(gradient, p).
    DVec<D> lowest(const DVec<D>& gradient) const {
        const DVec<D> low = core_support(convex_, -gradient).position;
        if (last_ == nullptr) return low;
        const DVec<D> low_last = is_translation_ ? low + translation_ : core_support(*last_, -gradient).position;
        return dot(gradient, low_last - low) < 0 ? low_last : low;
    }

    bool may_improve(double lower_bound) const {
        return lower_bound < best_.distance - options_.tolerance && lower_bound <= options_.reach;
    }
    /// Boxes of a higher bound can't improve the answer.
    double limit() const { return std::min(best_.distance - options_.tolerance, options_.reach); }

    void process(SearchHeap<D>& heap, SearchBox<D> box) {
        ++best_.boxes;
        // Find the nearest support plane of the set: it excludes the box, or it bounds the box.
        const Support* nearest = nullptr;
        double behind = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < support_count_; ++i) {
            const Support& support = supports_[i];
            const double square = length_squared(support.gradient);
            if (!(square > 0)) continue;
            const double gap = support.lower_bound - dot(support.gradient, box.center);
            if (gap > sum_along(support.gradient, box.half)) return;
            if (gap / std::sqrt(square) > behind) {
                behind = gap / std::sqrt(square);
                nearest = &support;
            }
        }
        DistanceBound<D> bound;
        if (nearest != nullptr) bound.requested_gradient = nearest->gradient;
        bound.sufficient = limit();
        bound.anchor = best_.point;
        bound.needs_gradient = false;
        bound.only_cut = best_.boxes > 1 && contains_point(box, best_.point);
        const DistanceBoundStatus known = function_.bound(box.center, box.half, bound);
        box.lower_bound = std::max(box.lower_bound, bound.lower_bound);
        if (!may_improve(box.lower_bound)) return;
        Cut cut{bound.cut_axis, bound.cut};
        if (known == DistanceBoundStatus::valid) {
            if (nearest != nullptr && !bound.is_smooth) {
                const double in_set = nearest->lower_bound - dot(nearest->gradient, box.center);
                box.lower_bound = std::max(
                    box.lower_bound, bound.requested_value + std::max(in_set, -sum_along(nearest->gradient, box.half)));
                if (!may_improve(box.lower_bound)) return;
            }
            if (bound.is_smooth) {
                const DVec<D> start = nearest != nullptr ? nearest->gradient : DVec<D>(0.0);
                const EnvelopeBound<D> envelope = bound_smooth(box, bound, start);
                box.lower_bound = std::max(box.lower_bound, envelope.bound);
                if (!may_improve(box.lower_bound)) return;
                const DVec<D> place = box.center + envelope.place;
                if (function_.at(place) < best_.distance - options_.tolerance) descend(place);
                if (!may_improve(box.lower_bound)) return;
                cut = best_cut(box, bound.curvature, place);
            }
        }
        if (cut.axis < 0) cut = {longest_axis(box.half), 0};
        if (!(std::abs(cut.at - box.center[cut.axis]) < (1 - 1e-9) * box.half[cut.axis])) cut.at = box.center[cut.axis];
        heap.push(box, cut);
    }

    /// Bounds a box without kinks by the convex envelope of its corner values. Adds the mixed differences of these
    /// values to bound.curvature.
    EnvelopeBound<D> bound_smooth(const SearchBox<D>& box, DistanceBound<D>& bound, const DVec<D>& start) const {
        add_twist(bound.corners, bound.curvature);
        double steepest = 0;
        for (int a = 0; a < D; ++a) {
            if (!(box.half[a] > 0)) continue;
            double rise = 0;
            for (std::size_t i = 0; i < bound.corners.size(); ++i)
                rise += (i >> a & 1) != 0 ? bound.corners[i] : -bound.corners[i];
            rise /= static_cast<double>(bound.corners.size());
            steepest =
                std::max({steepest, bound.curvature[a] / box.half[a], 0.5 * std::abs(rise / box.half[a] - start[a])});
        }
        const auto lowest_from_middle = [&](const DVec<D>& u) { return lowest(u) - box.center; };
        return envelope_bound<D>(function_.axes_of(box.half), bound.corners, start, limit(),
                                 std::min(steepest, 8 * function_.slope()), size_, lowest_from_middle);
    }

    static bool contains_point(const SearchBox<D>& box, const DVec<D>& point) {
        for (int a = 0; a < D; ++a)
            if (!(std::abs(point[a] - box.center[a]) <= box.half[a])) return false;
        return true;
    }

    /// A function that is linear along each axis curves by its mixed differences only.
    static void add_twist(const std::array<double, std::size_t{1} << D>& corners, DVec<D>& curvature) {
        for (int a = 0; a < D; ++a)
            for (int b = 0; b < a; ++b) {
                const std::size_t bits = (std::size_t{1} << a) | (std::size_t{1} << b);
                double twist = 0;
                for (std::size_t i = 0; i < corners.size(); ++i)
                    twist += (i & bits) == 0 || (i & bits) == bits ? corners[i] : -corners[i];
                twist = std::abs(twist) / static_cast<double>(corners.size());
                curvature[a] += twist;
                curvature[b] += twist;
            }
    }

    /// Cuts the axis along which the bound loses most, through the best point, where the bound is then exact.
    Cut best_cut(const SearchBox<D>& box, const DVec<D>& curvature, const DVec<D>& place) const {
        const int a = longest_axis(largest(curvature) > 0 ? curvature * box.half : box.half);
        for (const double at : {best_.point[a], place[a]})
            if (std::abs(at - box.center[a]) < 0.9 * box.half[a]) return {a, at};
        return {a, box.center[a]};
    }

    /// The end of a line search, with the gradients there and on the far side.
    struct LineSearchEnd {
        double part = 0, value = 0;
        DVec<D> gradient, beyond;
        bool is_bracketed = false;  ///< the function rises beyond it
    };

    /// Searches the minimum along a line. It may lie at the side of a cell, where tangents from both sides cross, or
    /// inside a cell, where secants of the slope find it.
    LineSearchEnd line_search(const DVec<D>& here, double value, const DVec<D>& gradient, const DVec<D>& direction,
                              double max_part) const {
        LineSearchEnd end{0, value, gradient, gradient};
        double before = 0, value_before = value, slope_before = std::min(dot(gradient, direction), 0.0);
        double part = max_part, after = 0, value_after = 0, slope_after = 0;
        for (int i = 0; i < search_max_line_steps; ++i) {
            DVec<D> slope;
            const double sampled = function_.at(here + direction * part, slope), along = dot(slope, direction);
            if (sampled < end.value) {
                end.value = sampled;
                end.part = part;
                end.gradient = slope;
            }
            if (sampled < value_before && along <= 0) {
                before = part;
                value_before = sampled;
                slope_before = along;
                end.gradient = slope;
                if (part == max_part) return end;
            } else {
                end.is_bracketed = true;
                end.beyond = slope;
                after = part;
                value_after = sampled;
                slope_after = along;
            }
            if (!end.is_bracketed) return end;
            const double wide = after - before;
            double share = 0.5;
            if (slope_after > 0 && slope_before < 0) {
                const double crossing =
                    (value_after - slope_after * wide - value_before) / ((slope_before - slope_after) * wide);
                if (value_before + slope_before * wide * crossing > end.value - 0.1 * options_.tolerance) break;
                share = i % 2 == 0 ? crossing : slope_before / (slope_before - slope_after);
            }
            if (!(share > 0.01)) share = 0.1;
            part = before + wide * std::clamp(share, 0.02, 0.98);
        }
        return end;
    }

    /// A gradient between two gradients, and a point between the two support points for it, both of which predict the
    /// same decrease.
    struct CombinedGradient {
        DVec<D> gradient, first, second;
        double part = 0;

        DVec<D> target() const { return first + (second - first) * part; }
    };

    /// The gradient between two that predicts the least decrease. The prediction is convex in the weight: tangents
    /// cross at the minimum, which is exact after a few steps if the set has corners.
    CombinedGradient combined(const DVec<D>& here, const DVec<D>& first, const DVec<D>& second) const {
        const DVec<D> change = second - first;
        double low = 0, high = 1;
        DVec<D> at = lowest(first);
        CombinedGradient result{first, at, at};
        double at_low = dot(first, here - at), slope_before = dot(change, here - at);
        if (!(slope_before < 0)) return result;
        at = lowest(second);
        double at_high = dot(second, here - at), slope_after = dot(change, here - at);
        if (!(slope_after > 0)) return {second, at, at};
        result.second = at;
        if (at_high < at_low) result.gradient = second;
        double predicted_decrease = std::min(at_low, at_high);
        for (int i = 0; i < search_max_line_steps; ++i) {
            const double wide = high - low;
            const double share =
                low + std::clamp((at_high - at_low - slope_after * wide) / (slope_before - slope_after), 0.0, wide);
            const DVec<D> between = first + change * share;
            at = lowest(between);
            const double sampled = dot(between, here - at), grows = dot(change, here - at);
            if (sampled < predicted_decrease) {
                predicted_decrease = sampled;
                result.gradient = between;
            }
            if (sampled <= at_low + slope_before * (share - low) + 0.05 * options_.tolerance) break;
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

    /// Descends from a point of the set to a local minimum. If that lies at the side of a cell, the set has no support
    /// plane perpendicular to either gradient, but one perpendicular to a gradient between them.
    void descend(const DVec<D>& from) {
        ConvexCombination<D> mean(from);
        DVec<D> here = from, gradient;
        double value = function_.at(here, gradient);
        DVec<D> slope = gradient;
        DVec<D> support_point = lowest(slope);
        for (int step = 0; step < search_max_descent_steps && value > options_.sufficient; ++step) {
            const double predicted_decrease = dot(slope, here - support_point);
            if (!(predicted_decrease > 0.25 * options_.tolerance)) break;
            const std::size_t highest = mean.highest(slope);
            const DVec<D> direction = support_point - mean.point(highest);
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
                const DVec<D> along = mixed.target() - here;
                const LineSearchEnd further =
                    is_stuck ? line_search(here, value, mixed.gradient, along, 1) : LineSearchEnd();
                if (is_stuck && further.value < value) {
                    here += along * further.part;
                    mean.shift_all(mixed.first, mixed.second, mixed.part, further.part);
                    value = further.value;
                    gradient = further.gradient;
                    if (further.is_bracketed) slope = combined(here, slope, further.beyond).gradient;
                } else if (is_stuck) {
                    if (further.is_bracketed) slope = combined(here, slope, further.beyond).gradient;
                    if (!(dot(slope, here - lowest(slope)) < 0.99 * predicted_decrease)) break;
                }
            }
            support_point = lowest(slope);
        }
        if (value < best_.distance) {
            best_.distance = value;
            best_.point = here;
        }
        add_support({slope, dot(slope, support_point)});
    }
    void add_support(const Support& support) {
        if (support_count_ == supports_.size()) {
            for (std::size_t i = 1; i < support_count_; ++i) supports_[i - 1] = supports_[i];
            --support_count_;
        }
        supports_[support_count_++] = support;
    }

    const PlacedFunction<D>& function_;
    Convex<D> convex_;
    const Convex<D>* last_;  ///< the end of its path; null: it doesn't move
    DVec<D> translation_{0.0};
    bool is_translation_ = false;
    MinimumOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0;  ///< of the core
    std::array<Support, 8> supports_;
    std::size_t support_count_ = 0;
    Minimum<D> best_;
};

}  // namespace

template <int D>
Minimum<D> bounded_minimum(const PlacedFunction<D>& function, const Convex<D>& convex,
                           const MinimumOptions<D>& options) {
    return BoundedMinimum<D>(function, convex, nullptr, options).run();
}

template <int D>
Minimum<D> bounded_minimum(const PlacedFunction<D>& function, const Convex<D>& first, const Convex<D>& last,
                           const MinimumOptions<D>& options) {
    return BoundedMinimum<D>(function, first, &last, options).run();
}

#define ABUT_INSTANTIATE(D)                                                                                    \
    template Minimum<D> bounded_minimum(const PlacedFunction<D>&, const Convex<D>&, const MinimumOptions<D>&); \
    template Minimum<D> bounded_minimum(const PlacedFunction<D>&, const Convex<D>&, const Convex<D>&,          \
                                        const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
