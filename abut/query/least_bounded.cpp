// The minimum of a function that bounds itself, over a convex set known by its support function.
//
// Branch and bound over boxes, cut where the function has kinks and through the best point found so far. Every box that
// the set can't leave out is bounded by a plane below the function and a support plane of the set. A box with kinks is
// bounded by the support planes of the best points; a box without one by the convex envelope of its corner values,
// which is exact at the corners, so that the boxes round a minimum shrink fast to it (envelope.hpp).
//
// Places are improved by conditional gradients with pairwise steps (Frank, Wolfe 1956; Lacoste-Julien, Jaggi, "On the
// global linear convergence of Frank-Wolfe optimization variants", 2015), which take the support function alone.

#include <abut/query/envelope.hpp>
#include <abut/query/search_boxes.hpp>

#include <algorithm>

namespace abut {
namespace {

/// In parts of the size: so much less it may be elsewhere where the bound on fine boxes is reached.
constexpr double rough_tolerance = 1e-5;

/// The plane that divides a box in two.
struct Cut {
    int axis = -1;
    double at = 0;
};

/// Boxes that are still to be looked at, the one that may hold least first; the earlier one of two alike.
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
    double least() const { return count_ > 0 ? entries_[0].box.least : std::numeric_limits<double>::infinity(); }
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
        return a.box.least != b.box.least ? a.box.least > b.box.least : a.number > b.number;
    }

    std::array<Entry, least_bounded_most_boxes / 2> entries_;
    std::size_t count_ = 0;
    std::uint32_t number_ = 0;
};

/// A point of a set as a mean of others of it, for steps that take weight from one and give it to another.
template <int D>
class MeanOfPoints {
public:
    explicit MeanOfPoints(const DVec<D>& point) : count_(1) {
        points_[0] = point;
        weights_[0] = 1;
    }

    /// The one that is farthest up a gradient.
    std::size_t highest(const DVec<D>& gradient) const {
        std::size_t result = 0;
        for (std::size_t i = 1; i < count_; ++i)
            if (dot(gradient, points_[i]) > dot(gradient, points_[result])) result = i;
        return result;
    }
    const DVec<D>& point(std::size_t i) const { return points_[i]; }
    double weight(std::size_t i) const { return weights_[i]; }

    /// A share of all, to a point between two.
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
class LeastBounded {
public:
    LeastBounded(const FunctionThere<D>& function, const Convex<D>& convex, const Convex<D>* last,
                 const LeastOptions<D>& options)
        : function_(function), convex_(convex), last_(last), options_(options) {
        convex_.radius = 0;
        if (last_ != nullptr && last_->place.column == convex_.place.column) {
            travel_ = last_->place.offset - convex_.place.offset;
            goes_straight_ = true;
        }
        if (options_.most_boxes == 0) options_.most_boxes = least_bounded_most_boxes;
        DVec<D> low(0.0), high(0.0);
        for (int i = 0; i < D; ++i) {
            low[i] = lowest(axis<D>(i, 1))[i];
            high[i] = lowest(axis<D>(i, -1))[i];
        }
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
    }

    Least<D> run() {
        DVec<D> slope;
        function_.at(all_.center, slope);
        go_down(lowest(slope));
        SearchHeap<D> heap;
        look_at(heap, all_);
        const double rough = rough_tolerance * size_;
        while (!heap.empty() && best_.distance > options_.enough && wanted(heap.least())) {
            const bool is_rough = best_.boxes >= least_bounded_most_fine_boxes &&
                                  heap.least() >= std::min(best_.distance - rough, options_.no_less);
            if (is_rough || best_.boxes >= options_.most_boxes || heap.full()) {
                best_.doubt = best_.distance - std::min(heap.least(), best_.distance);
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
            look_at(heap, low);
            look_at(heap, high);
        }
        best_.at_least = std::min(heap.least(), limit());
        if (best_.distance > options_.reach) best_.distance = std::numeric_limits<double>::infinity();
        return best_;
    }

private:
    /// The gradient of the function where it is least near by, and what that is at least in the set, about the origin.
    struct Support {
        DVec<D> gradient;
        double least;
    };

    /// The point of the set that is farthest down.
    DVec<D> lowest(const DVec<D>& gradient) const {
        const DVec<D> low = core_support(convex_, -gradient).position;
        if (last_ == nullptr) return low;
        const DVec<D> low_last = goes_straight_ ? low + travel_ : core_support(*last_, -gradient).position;
        return dot(gradient, low_last - low) < 0 ? low_last : low;
    }

    bool wanted(double least) const { return least < best_.distance - options_.tolerance && least <= options_.reach; }
    /// More than that isn't wanted.
    double limit() const { return std::min(best_.distance - options_.tolerance, options_.reach); }

    void look_at(SearchHeap<D>& heap, SearchBox<D> box) {
        ++best_.boxes;
        // Which support plane of the set is nearest: the box is behind it, or it is the one that bounds.
        const Support* nearest = nullptr;
        double behind = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < support_count_; ++i) {
            const Support& support = supports_[i];
            const double square = length_squared(support.gradient);
            if (!(square > 0)) continue;
            const double gap = support.least - dot(support.gradient, box.center);
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
        bound.only_cut = best_.boxes > 1 && is_in(box, best_.point);
        const DistanceBoundStatus known = function_.bound(box.center, box.half, bound);
        box.least = std::max(box.least, bound.lower_bound);
        if (!wanted(box.least)) return;
        Cut cut{bound.cut_axis, bound.cut};
        if (known == DistanceBoundStatus::valid) {
            if (nearest != nullptr && !bound.is_smooth) {
                const double in_set = nearest->least - dot(nearest->gradient, box.center);
                box.least = std::max(box.least,
                                     bound.requested_value + std::max(in_set, -sum_along(nearest->gradient, box.half)));
                if (!wanted(box.least)) return;
            }
            if (bound.is_smooth) {
                const DVec<D> start = nearest != nullptr ? nearest->gradient : DVec<D>(0.0);
                const EnvelopeBound<D> envelope = bound_smooth(box, bound, start);
                box.least = std::max(box.least, envelope.bound);
                if (!wanted(box.least)) return;
                const DVec<D> place = box.center + envelope.place;
                if (function_.at(place) < best_.distance - options_.tolerance) go_down(place);
                if (!wanted(box.least)) return;
                cut = best_cut(box, bound.curvature, place);
            }
        }
        if (cut.axis < 0) cut = {longest_axis(box.half), 0};
        if (!(std::abs(cut.at - box.center[cut.axis]) < (1 - 1e-9) * box.half[cut.axis])) cut.at = box.center[cut.axis];
        heap.push(box, cut);
    }

    /// The bound of a box without kinks, by the envelope of its corner values. Adds to `bend` what the twist of these
    /// values makes of it.
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

    static bool is_in(const SearchBox<D>& box, const DVec<D>& point) {
        for (int a = 0; a < D; ++a)
            if (!(std::abs(point[a] - box.center[a]) <= box.half[a])) return false;
        return true;
    }

    /// A function that is linear along each axis bends by its mixed differences alone.
    static void add_twist(const std::array<double, std::size_t{1} << D>& corners, DVec<D>& bend) {
        for (int a = 0; a < D; ++a)
            for (int b = 0; b < a; ++b) {
                const std::size_t bits = (std::size_t{1} << a) | (std::size_t{1} << b);
                double twist = 0;
                for (std::size_t i = 0; i < corners.size(); ++i)
                    twist += (i & bits) == 0 || (i & bits) == bits ? corners[i] : -corners[i];
                twist = std::abs(twist) / static_cast<double>(corners.size());
                bend[a] += twist;
                bend[b] += twist;
            }
    }

    /// Across the axis along which the bound loses most, through the best point, where the bound is exact then.
    Cut best_cut(const SearchBox<D>& box, const DVec<D>& bend, const DVec<D>& place) const {
        const int a = longest_axis(largest(bend) > 0 ? bend * box.half : box.half);
        for (const double at : {best_.point[a], place[a]})
            if (std::abs(at - box.center[a]) < 0.9 * box.half[a]) return {a, at};
        return {a, box.center[a]};
    }

    /// Where a step along a line ended, and how the function grows there and on the far side of it.
    struct LineEnd {
        double part = 0, value = 0;
        DVec<D> gradient, beyond;
        bool is_turn = false;  ///< beyond it the function rises
    };

    /// Towards where the function falls no more along a line. It may turn at the side of a cell, where lines from both
    /// sides cross, or gently, by secants of its slope.
    LineEnd go_along(const DVec<D>& here, double value, const DVec<D>& gradient, const DVec<D>& way,
                     double most) const {
        LineEnd end{0, value, gradient, gradient};
        double before = 0, value_before = value, falls = std::min(dot(gradient, way), 0.0);
        double part = most, after = 0, value_after = 0, rises = 0;
        for (int i = 0; i < search_most_turns; ++i) {
            DVec<D> slope;
            const double there = function_.at(here + way * part, slope), along = dot(slope, way);
            if (there < end.value) {
                end.value = there;
                end.part = part;
                end.gradient = slope;
            }
            if (there < value_before && along <= 0) {
                before = part;
                value_before = there;
                falls = along;
                end.gradient = slope;
                if (part == most) return end;
            } else {
                end.is_turn = true;
                end.beyond = slope;
                after = part;
                value_after = there;
                rises = along;
            }
            if (!end.is_turn) return end;
            const double wide = after - before;
            double share = 0.5;
            if (rises > 0 && falls < 0) {
                const double crossing = (value_after - rises * wide - value_before) / ((falls - rises) * wide);
                if (value_before + falls * wide * crossing > end.value - 0.1 * options_.tolerance) break;
                share = i % 2 == 0 ? crossing : falls / (falls - rises);
            }
            if (!(share > 0.01)) share = 0.1;
            part = before + wide * std::clamp(share, 0.02, 0.98);
        }
        return end;
    }

    /// A gradient between two, and a point between the two that are lowest for it: there both promise as much.
    struct Combined {
        DVec<D> gradient, first, second;
        double part = 0;

        DVec<D> target() const { return first + (second - first) * part; }
    };

    /// Of the gradients between two the one that promises least. What they promise is convex: by where tangents cross,
    /// which is exact after a few steps where the set has corners.
    Combined combined(const DVec<D>& here, const DVec<D>& first, const DVec<D>& second) const {
        const DVec<D> change = second - first;
        double low = 0, high = 1;
        DVec<D> at = lowest(first);
        Combined result{first, at, at};
        double at_low = dot(first, here - at), falls = dot(change, here - at);
        if (!(falls < 0)) return result;
        at = lowest(second);
        double at_high = dot(second, here - at), rises = dot(change, here - at);
        if (!(rises > 0)) return {second, at, at};
        result.second = at;
        if (at_high < at_low) result.gradient = second;
        double promised = std::min(at_low, at_high);
        for (int i = 0; i < search_most_turns; ++i) {
            const double wide = high - low;
            const double share = low + std::clamp((at_high - at_low - rises * wide) / (falls - rises), 0.0, wide);
            const DVec<D> between = first + change * share;
            at = lowest(between);
            const double there = dot(between, here - at), grows = dot(change, here - at);
            if (there < promised) {
                promised = there;
                result.gradient = between;
            }
            if (there <= at_low + falls * (share - low) + 0.05 * options_.tolerance) break;
            if (grows < 0) {
                low = share;
                at_low = there;
                falls = grows;
                result.first = at;
            } else {
                high = share;
                at_high = there;
                rises = grows;
                result.second = at;
            }
        }
        result.part = falls / (falls - rises);
        return result;
    }

    /// From a point of the set to where the function is least near by. Where that is on the side of a cell, the set has
    /// no support plane at right angles to either gradient, but to one between.
    void go_down(const DVec<D>& from) {
        MeanOfPoints<D> mean(from);
        DVec<D> here = from, gradient;
        double value = function_.at(here, gradient);
        DVec<D> slope = gradient;
        DVec<D> low = lowest(slope);
        for (int step = 0; step < search_most_steps_down && value > options_.enough; ++step) {
            const double promised = dot(slope, here - low);
            if (!(promised > 0.25 * options_.tolerance)) break;
            const std::size_t highest = mean.highest(slope);
            const DVec<D> way = low - mean.point(highest);
            const LineEnd end = go_along(here, value, gradient, way, mean.weight(highest));
            if (end.value < value) {
                here += way * end.part;
                mean.shift(highest, low, end.part);
            }
            const bool is_far = value - end.value > 0.1 * promised;
            value = std::min(value, end.value);
            const bool rests = end.part == 0;
            gradient = end.gradient;
            if (!end.is_turn) {
                slope = gradient;
            } else {
                const Combined both = combined(here, is_far ? gradient : slope, end.beyond);
                slope = both.gradient;
                // Where it turns: along the side of the cells, between the points that are lowest for either of them.
                const DVec<D> along = both.target() - here;
                const LineEnd further = rests ? go_along(here, value, both.gradient, along, 1) : LineEnd();
                if (rests && further.value < value) {
                    here += along * further.part;
                    mean.shift_all(both.first, both.second, both.part, further.part);
                    value = further.value;
                    gradient = further.gradient;
                    if (further.is_turn) slope = combined(here, slope, further.beyond).gradient;
                } else if (rests) {
                    if (further.is_turn) slope = combined(here, slope, further.beyond).gradient;
                    if (!(dot(slope, here - lowest(slope)) < 0.99 * promised)) break;
                }
            }
            low = lowest(slope);
        }
        if (value < best_.distance) {
            best_.distance = value;
            best_.point = here;
        }
        add_support({slope, dot(slope, low)});
    }
    void add_support(const Support& support) {
        if (support_count_ == supports_.size()) {
            for (std::size_t i = 1; i < support_count_; ++i) supports_[i - 1] = supports_[i];
            --support_count_;
        }
        supports_[support_count_++] = support;
    }

    const FunctionThere<D>& function_;
    Convex<D> convex_;
    const Convex<D>* last_;  ///< where it ends; null: it rests
    DVec<D> travel_{0.0};
    bool goes_straight_ = false;
    LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0;  ///< of the core
    std::array<Support, 8> supports_;
    std::size_t support_count_ = 0;
    Least<D> best_;
};

}  // namespace

template <int D>
Least<D> least_bounded(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options) {
    return LeastBounded<D>(function, convex, nullptr, options).run();
}

template <int D>
Least<D> least_bounded(const FunctionThere<D>& function, const Convex<D>& first, const Convex<D>& last,
                       const LeastOptions<D>& options) {
    return LeastBounded<D>(function, first, &last, options).run();
}

#define ABUT_INSTANTIATE(D)                                                                             \
    template Least<D> least_bounded(const FunctionThere<D>&, const Convex<D>&, const LeastOptions<D>&); \
    template Least<D> least_bounded(const FunctionThere<D>&, const Convex<D>&, const Convex<D>&,        \
                                    const LeastOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
