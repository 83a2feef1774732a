// The minimum of a function that bounds itself, over a convex set known by its support function.
//
// The search is branch and bound over boxes. It cuts boxes at kinks of the function and through the best point so far,
// and divides a box with few kinks at all of them.
// A plane below the function and a support plane of the set bound every box that may overlap the set. The support
// planes of the best points bound a box with kinks. The convex envelope of its corner values bounds a box without
// kinks; it is exact at the corners, so that boxes around a minimum shrink fast to it (convex_envelope.hpp).
// Descents improve points (conditional_gradient.hpp).

#include <abut/query/detail/sdf/conditional_gradient.hpp>
#include <abut/query/detail/sdf/convex_envelope.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

/// At the limit on fine boxes the minimum may be lower by this fraction of the size.
constexpr double coarse_tolerance = 1e-5;

/// The limit on steps that look for a plane between a box and the set.
constexpr int max_steps_apart = 4;

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
    bool has_space(std::size_t pieces) const { return count_ + pieces <= entries_.size(); }
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

template <int D>
class BoundedMinimum {
public:
    /// `last` is the end of its path; null: it doesn't move.
    BoundedMinimum(const PlacedFunction<D>& function, const Convex<D>& convex, const Convex<D>* last,
                   const MinimumOptions<D>& options)
        : function_(function),
          set_(convex, last),
          descent_(function, set_, options.tolerance, options.sufficient),
          options_(options) {
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
        if (options_.hint != nullptr) descend(path_point<D>(*options_.hint, 1));
        DVec<D> slope;
        function_.at(all_.center, slope);
        descend(set_.lowest(slope));
        SearchHeap<D> heap;
        process(heap, all_);
        const double coarse = coarse_tolerance * size_;
        while (!heap.empty() && best_.distance > options_.sufficient && may_improve(heap.lower_bound())) {
            const bool is_coarse = best_.boxes >= bounded_minimum_max_fine_boxes &&
                                   heap.lower_bound() >= std::min(best_.distance - coarse, options_.sufficient_bound);
            if (is_coarse || best_.boxes >= options_.max_boxes || !heap.has_space(2)) {
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
    using Support = SupportPlane<D>;

    DVec<D> lowest(const DVec<D>& gradient) const { return DVec<D>(set_.lowest(gradient)); }

    bool may_improve(double lower_bound) const {
        return lower_bound < best_.distance - options_.tolerance && lower_bound <= options_.reach;
    }
    /// Boxes of a higher bound can't improve the answer.
    double limit() const { return std::min(best_.distance - options_.tolerance, options_.reach); }

    /// The support plane of the set nearest to a box, null if none is known. Returns false if one excludes the box.
    bool find_support(const SearchBox<D>& box, const Support*& nearest) const {
        double behind = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < support_count_; ++i) {
            const Support& support = supports_[i];
            const double square = length_squared(support.gradient);
            if (!(square > 0)) continue;
            const double gap = support.lower_bound - dot(support.gradient, box.center);
            if (gap > sum_along(support.gradient, box.half)) return false;
            if (gap / std::sqrt(square) > behind) {
                behind = gap / std::sqrt(square);
                nearest = &support;
            }
        }
        return true;
    }

    /// Whether a few steps towards the box find a plane between it and the set.
    bool is_apart(const SearchBox<D>& box) const {
        DVec<D> point = best_.point;
        for (int step = 0; step < max_steps_apart; ++step) {
            DVec<D> from_box;
            for (int a = 0; a < D; ++a)
                from_box[a] = point[a] - std::clamp(point[a], box.center[a] - box.half[a], box.center[a] + box.half[a]);
            const DVec<D> near = lowest(from_box), way = near - point;
            if (dot(from_box, near - box.center) > sum_along(from_box, box.half)) return true;
            const double square = length_squared(way);
            if (!(square > 0)) return false;
            point += way * std::clamp(-dot(from_box, way) / square, 0.0, 1.0);
        }
        return false;
    }

    void process(SearchHeap<D>& heap, SearchBox<D> box) {
        ++best_.boxes;
        const Support* nearest = nullptr;
        if (!find_support(box, nearest)) return;
        // A long path is beside many boxes of many cells, which would cost the most.
        if (set_.moves() && largest(box.half) > function_.resolution() && is_apart(box)) return;
        DistanceBound<D> bound;
        if (nearest != nullptr) {
            bound.requested_gradient = nearest->gradient;
            bound.requested_support = nearest->lower_bound;
        }
        bound.sufficient = limit();
        bound.anchor = best_.point;
        bound.needs_gradient = false;
        bound.only_cut = best_.boxes > 1 && best_.distance <= options_.reach && contains_point(box, best_.point);
        const auto visit = [&](const DVec<D>& low, const DVec<D>& high, DistanceBound<D>& piece) {
            SearchBox<D> part{(low + high) * 0.5, (high - low) * 0.5, std::max(box.lower_bound, piece.lower_bound)};
            const Support* beside = nullptr;
            if (!may_improve(part.lower_bound) || best_.distance <= options_.sufficient) return;
            ++best_.boxes;
            if (find_support(part, beside)) process_piece(heap, part, piece, beside);
        };
        const typename DistanceBound<D>::PieceVisitor visitor(visit);
        if (heap.has_space(DistanceBound<D>::max_pieces)) bound.visit_piece = &visitor;
        const DistanceBoundStatus known = function_.bound(box.center, box.half, bound);
        if (known == DistanceBoundStatus::divided) return;
        box.lower_bound = std::max(box.lower_bound, bound.lower_bound);
        if (!may_improve(box.lower_bound)) return;
        if (known == DistanceBoundStatus::valid && nearest != nullptr && !bound.is_smooth) {
            const double in_set = nearest->lower_bound - dot(nearest->gradient, box.center);
            box.lower_bound = std::max(
                box.lower_bound, bound.requested_value + std::max(in_set, -sum_along(nearest->gradient, box.half)));
            if (!may_improve(box.lower_bound)) return;
        }
        process_piece(heap, box, bound, nearest);
    }

    /// Bounds the box if it has no kink, and keeps it with the plane to cut it at.
    void process_piece(SearchHeap<D>& heap, SearchBox<D> box, DistanceBound<D>& bound, const Support* nearest) {
        Cut cut{bound.cut_axis, bound.cut};
        if (bound.is_smooth) {
            const DVec<D> start = nearest != nullptr ? nearest->gradient : DVec<D>(0.0);
            const EnvelopeBound<D> envelope = bound_smooth(box, bound, start);
            box.lower_bound = std::max(box.lower_bound, envelope.bound);
            if (!may_improve(box.lower_bound)) return;
            const DVec<D> place(envelope.place);
            if (function_.at(place) < best_.distance - options_.tolerance) descend(envelope.place);
            if (!may_improve(box.lower_bound)) return;
            cut = best_cut(box, bound.curvature, place);
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
        return envelope_bound<D>(function_.axes_of(box.half), box.center, bound.corners, start, limit(),
                                 std::min(steepest, 8 * function_.slope()), size_,
                                 [&](const DVec<D>& u) { return set_.lowest(u); });
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

    void descend(const PathPoint<D>& from) {
        const LocalMinimum<D> found = descent_.descend(from);
        if (found.value < best_.distance) {
            best_.distance = found.value;
            best_.point = DVec<D>(found.point);
            best_.share = share_of<D>(found.point);
        }
        add_support(found.support);
    }
    void add_support(const Support& support) {
        if (support_count_ == supports_.size()) {
            for (std::size_t i = 1; i < support_count_; ++i) supports_[i - 1] = supports_[i];
            --support_count_;
        }
        supports_[support_count_++] = support;
    }

    const PlacedFunction<D>& function_;
    PathHull<D> set_;
    ConditionalGradient<D> descent_;
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
