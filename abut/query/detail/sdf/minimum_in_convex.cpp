// The minimum of a function over a convex set known by its support function.
//
// The search cuts boxes at kinks of the function and through the best point so far,
// and divides a box with few kinks at all of them.
// A plane below the function and a support plane of the set bound every box that may overlap the set. The support
// planes of the best points bound a box with kinks. The convex envelope of its corner values bounds a box without
// kinks; it is exact at the corners, so that boxes around a minimum shrink fast to it (envelope_bound).
// Descents improve points (conditional_gradient.hpp).

#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/sdf/conditional_gradient.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut::detail {
namespace {

template <int D>
struct EnvelopeBound {
    double bound = -std::numeric_limits<double>::infinity();  ///< at most the minimum
    PathPoint<D> place{0.0};                                  ///< a point of the set, near the minimum of the envelope
};

/// `axes` are the half axes of a box around `center`, and `values` those at its corners: bit a of a corner's index
/// chooses the upper side along axis a. lowest(u) returns the point of the set that minimises dot(u, p). The search
/// stops at a bound above `sufficient`, or when the bound no longer grows. `start` is the first u. `steepest` is about
/// the largest useful change of u, and grows as needed; `size` is about the size of the set.
template <int D, class Lowest>
EnvelopeBound<D> envelope_bound(const std::array<DVec<D>, static_cast<std::size_t>(D)>& axes, const DVec<D>& center,
                                const std::array<double, std::size_t{1} << D>& values, const DVec<D>& start,
                                double sufficient, double steepest, double size, const Lowest& lowest) {
    constexpr std::size_t rows = static_cast<std::size_t>(D) + 1;
    constexpr int max_pivots = 24;
    using Row = std::array<double, rows>;
    // The first pairs are artificial variables at the corners of a simplex, so high that none of them stays in a
    // solution.
    std::array<Row, rows> inverse{};
    std::array<PathPoint<D>, rows> points{};
    std::array<bool, rows> is_artificial;
    is_artificial.fill(true);
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t a = 0; a + 1 < rows; ++a) inverse[j][a] = -1 / (static_cast<double>(rows) * size);
        if (j + 1 < rows) inverse[j][j] += 1 / size;
        inverse[j][rows - 1] = 1 / static_cast<double>(rows);
    }
    EnvelopeBound<D> result;
    DVec<D> u = start;
    double value = std::numeric_limits<double>::infinity();
    for (int pivot = 0;; ++pivot) {
        const PathPoint<D> lowest_point = lowest(u);
        const DVec<D> point = DVec<D>(lowest_point) - center;
        std::array<double, static_cast<std::size_t>(D)> rise;
        for (std::size_t a = 0; a < axes.size(); ++a) rise[a] = dot(u, axes[a]);
        std::size_t lowest_corner = 0;
        double above = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < values.size(); ++i) {
            double along = 0;
            for (std::size_t a = 0; a < rise.size(); ++a) along += (i >> a & 1) != 0 ? rise[a] : -rise[a];
            const double height = values[i] - along;
            lowest_corner = height < above ? i : lowest_corner;
            above = std::min(above, height);
        }
        const double bound = above + dot(u, point);
        if (pivot == 0) {
            result.place = lowest_point;
            value = std::max(sufficient, bound) + steepest * size;
        }
        result.bound = std::max(result.bound, bound);
        if (result.bound > sufficient || pivot == max_pivots) break;
        if (value <= sufficient) {
            // Raise the remaining artificial variables: larger changes of u may still help.
            double artificial_weight = 0;
            for (std::size_t j = 0; j < rows; ++j)
                if (is_artificial[j]) artificial_weight += inverse[j][rows - 1];
            if (!(artificial_weight > 1e-9)) break;
            const double raised = std::max(steepest * size, (sufficient - value) / artificial_weight);
            steepest *= 2;
            for (std::size_t j = 0; j < rows; ++j) {
                if (!is_artificial[j]) continue;
                for (int a = 0; a < D; ++a) u[a] -= raised * inverse[j][static_cast<std::size_t>(a)];
                value += raised * inverse[j][rows - 1];
            }
            continue;
        }
        if (!(value - bound > 1e-3 * (value - sufficient))) break;
        // The pair enters in place of the first one whose weight would fall below zero.
        DVec<D> across = point;
        for (std::size_t a = 0; a < axes.size(); ++a) across -= (lowest_corner >> a & 1) != 0 ? axes[a] : -axes[a];
        Row share;
        std::size_t leaving = rows;
        double min_ratio = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < rows; ++j) {
            share[j] = inverse[j][rows - 1];
            for (int a = 0; a < D; ++a) share[j] += inverse[j][static_cast<std::size_t>(a)] * across[a];
            if (!(share[j] > 1e-12)) continue;
            const double ratio = std::max(inverse[j][rows - 1], 0.0) / share[j];
            if (ratio < min_ratio || (ratio == min_ratio && is_artificial[j])) {
                min_ratio = ratio;
                leaving = j;
            }
        }
        if (leaving == rows) break;
        is_artificial[leaving] = false;
        points[leaving] = lowest_point;
        for (double& entry : inverse[leaving]) entry /= share[leaving];
        for (std::size_t j = 0; j < rows; ++j)
            if (j != leaving)
                for (std::size_t a = 0; a < rows; ++a) inverse[j][a] -= share[j] * inverse[leaving][a];
        const double change = bound - value;
        for (int a = 0; a < D; ++a) u[a] -= change * inverse[leaving][static_cast<std::size_t>(a)];
        value += change * inverse[leaving][rows - 1];
    }
    PathPoint<D> sum(0.0);
    double weights = 0;
    for (std::size_t j = 0; j < rows; ++j) {
        if (is_artificial[j]) continue;
        const double weight = std::max(inverse[j][rows - 1], 0.0);
        sum += points[j] * weight;
        weights += weight;
    }
    if (weights > 1e-6) result.place = sum / weights;
    return result;
}

/// At the limit on fine boxes the minimum may be lower by this fraction of the size.
constexpr double coarse_tolerance = 1e-5;

/// The limit on steps that look for a plane between a box and the set.
constexpr int max_steps_apart = 4;

/// The limits on boxes: in all, and for details of a function that bounds itself finer than a 10000th of the size.
constexpr int max_boxes_in_convex = 512, max_fine_boxes = 48;

template <int D>
class ConvexMinimum : BoxSearch<D> {
public:
    /// `last` is the end of its path; null: it doesn't move.
    ConvexMinimum(const PlacedFunction<D>& function, const Convex<D>& convex, const Convex<D>* last,
                  const MinimumOptions<D>& options)
        : BoxSearch<D>(options),
          function_(function),
          set_(convex, last),
          descent_(function_, set_, options.tolerance, options.sufficient) {
        DVec<D> low(0.0), high(0.0);
        for (int i = 0; i < D; ++i) {
            low[i] = lowest(axis<D>(i, 1))[i];
            high[i] = lowest(axis<D>(i, -1))[i];
        }
        all_ = SearchBox<D>::between(low, high);
        size_ = length(all_.half);
        function_.set_size(all_.center, size_);
        if (!has_bounds()) options_.tolerance = std::max(options_.tolerance, estimate_tolerance * size_);
    }

    Minimum<D> find() {
        if (options_.hint != nullptr) descend(path_point<D>(*options_.hint, 1));
        DVec<D> slope;
        function_.at(all_.center, slope);
        descend(set_.lowest(slope));
        this->run(all_, max_boxes_in_convex);
        return best_;
    }

private:
    using BoxSearch<D>::options_;
    using BoxSearch<D>::best_;
    using BoxSearch<D>::may_improve;
    using BoxSearch<D>::limit;
    using Support = SupportPlane<D>;

    DVec<D> lowest(const DVec<D>& gradient) const { return DVec<D>(set_.lowest(gradient)); }

    bool has_bounds() const { return function_.function().bound != nullptr; }

    bool is_enough() const override {
        return best_.boxes >= max_fine_boxes &&
               this->lowest_bound() >= std::min(best_.distance - coarse_tolerance * size_, options_.sufficient_bound);
    }

    /// The support plane of the set nearest to a box, null if none is known. Returns false if one excludes the box.
    bool find_support(const SearchBox<D>& box, const Support*& nearest) const {
        double behind = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < support_count_; ++i) {
            const Support& support = supports_[i];
            const double square = length_squared(support.gradient);
            if (!(square > 0)) continue;
            const double gap = support.lower_bound - dot(support.gradient, box.center);
            if (gap > sum_along(support.gradient, box.half)) return false;
            if (gap / square_root(square) > behind) {
                behind = gap / square_root(square);
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
            const DVec<D> near = lowest(from_box), step_to = near - point;
            if (dot(from_box, near - box.center) > sum_along(from_box, box.half)) return true;
            const double square = length_squared(step_to);
            if (!(square > 0)) return false;
            point += step_to * std::clamp(-dot(from_box, step_to) / square, 0.0, 1.0);
        }
        return false;
    }

    void process(SearchBox<D> box) override {
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
            SearchBox<D> part = SearchBox<D>::between(low, high);
            part.lower_bound = std::max(box.lower_bound, piece.lower_bound);
            const Support* beside = nullptr;
            if (!may_improve(part.lower_bound) || best_.distance <= options_.sufficient) return;
            ++best_.boxes;
            if (find_support(part, beside)) process_piece(part, piece, beside);
        };
        const typename DistanceBound<D>::PieceVisitor visitor(visit);
        bound.visit_piece = &visitor;
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
        process_piece(box, bound, nearest);
    }

    /// Bounds the box if it has no kink, and keeps it with the plane to cut it at.
    void process_piece(SearchBox<D> box, DistanceBound<D>& bound, const Support* nearest) {
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
        this->push(box, cut);
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

    PlacedFunction<D> function_;
    PathHull<D> set_;
    ConditionalGradient<D> descent_;
    SearchBox<D> all_;
    double size_ = 0;  ///< of the core
    std::array<Support, 8> supports_;
    std::size_t support_count_ = 0;
};

}  // namespace

template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& convex,
                             const MinimumOptions<D>& options) {
    return ConvexMinimum<D>(function, convex, nullptr, options).find();
}

template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& first, const Convex<D>& last,
                             const MinimumOptions<D>& options) {
    return ConvexMinimum<D>(function, first, &last, options).find();
}

#define ABUT_INSTANTIATE(D)                                                                                      \
    template Minimum<D> minimum_in_convex(const PlacedFunction<D>&, const Convex<D>&, const MinimumOptions<D>&); \
    template Minimum<D> minimum_in_convex(const PlacedFunction<D>&, const Convex<D>&, const Convex<D>&,          \
                                          const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
