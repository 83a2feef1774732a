#include <abut/query/detail/sdf/branch_and_bound.hpp>

namespace abut::detail {
namespace {

/// The point of a core nearest to a point.
template <int D>
class NearestInCore {
public:
    explicit NearestInCore(const Convex<D>& convex) : convex_(convex) {
        convex_.radius = 0;
        if (convex.inner_radius > 0) return;
        if (convex.core == Core::points && convex.count <= 2) {
            first_ = convex.place.point(DVec<D>(convex.vertices()[0]));
            direction_ = convex.count == 2 ? convex.place.point(DVec<D>(convex.vertices()[1])) - first_ : DVec<D>(0.0);
            kind_ = Kind::segment;
        } else if (is_plain_box(convex)) {
            kind_ = Kind::box;
        }
    }

    DVec<D> nearest(const DVec<D>& point) const {
        if (kind_ == Kind::segment) {
            const double square = length_squared(direction_);
            return square > 0 ? first_ + direction_ * std::clamp(dot(point - first_, direction_) / square, 0.0, 1.0)
                              : first_;
        }
        if (kind_ == Kind::box) {
            const DVec<D> own =
                convex_.place.transposed(point - convex_.place.offset) / (convex_.scale * convex_.scale);
            DVec<D> clamped;
            for (int i = 0; i < D; ++i) {
                const auto half = static_cast<double>(convex_.own[0][i]);
                clamped[i] = std::clamp(own[i], -half, half);
            }
            return clamped == own ? point : convex_.place.point(clamped);
        }
        return nearest_in_core(convex_, point);
    }

    DVec<D> lowest(const DVec<D>& gradient) const { return core_support(convex_, -gradient).position; }

private:
    enum class Kind : std::uint8_t { any, segment, box };

    Convex<D> convex_;
    Kind kind_ = Kind::any;
    DVec<D> first_, direction_;
};

template <int D>
class ConvexMinimum {
public:
    ConvexMinimum(const PlacedFunction<D>& function, const Convex<D>& convex, const MinimumOptions<D>& options)
        : function_(function), convex_(convex), core_(convex), options_(with_box_limit(options, false)) {
        DVec<D> low, high;
        for (int i = 0; i < D; ++i) {
            low[i] = core_support(convex, axis<D>(i, -1)).position[i];
            high[i] = core_support(convex, axis<D>(i, 1)).position[i];
        }
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        cell_size_ = estimated_cell_size(function, size_);
        step_ = function.step(all_.center, size_);
    }

    void run(const DVec<D>& middle_of_function) {
        const DVec<D> first = core_.nearest(all_.center);
        sample(first);
        if (size_ == 0) return;
        descend(first);
        const DVec<D> second = core_.nearest(middle_of_function);
        sample(second);
        if (second != first && best.point == second) descend(second);
        bool is_smallest = false;
        all_.lower_bound = lower_bound_in(all_, is_smallest);
        if (may_improve(all_.lower_bound)) {
            descents_ = 0;
            if (has_simplices(convex_))
                each_simplex(convex_, [&](const CoreSimplex<D>& simplex) { split_simplex(simplex); });
            else
                branch_and_bound(*this, all_, options_);
        }
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double lower_bound_in(const SearchBox<D>& box, bool& is_smallest) {
        // The value in the centre, whether or not that is in the core, rejects most boxes.
        const double around = function_.at(box.center) - function_.slope() * length(box.half);
        if (!(around < best.distance - options_.tolerance && around <= options_.reach)) return around;
        const DVec<D> near = core_.nearest(box.center), direction = box.center - near;
        const double gap_squared = length_squared(direction);
        constexpr double no_point = std::numeric_limits<double>::infinity();
        if (gap_squared > sum_along(direction, box.half) * (1 + 1e-12) && gap_squared > 0) return no_point;
        const double here = sample(near);
        const double lower_bound = std::max(around, here - function_.slope() * farthest(near, box));
        if (!(lower_bound < best.distance - options_.tolerance && lower_bound <= options_.reach)) return lower_bound;
        if (length(box.half) > cell_size_) return lower_bound;
        is_smallest = length(box.half) <= min_estimated_cell_fraction * size_;
        const DistanceBound<D> bound = function_.estimate(box.center, box.half, function_.at(box.center));
        const DVec<D> lowest = core_.lowest(bound.gradient);
        const double estimated =
            bound.value + std::max(dot(bound.gradient, lowest - box.center), -sum_along(bound.gradient, box.half));
        if (estimated < best.distance - options_.tolerance) descend(near);
        return std::max(lower_bound, estimated);
    }

    Minimum<D> best;

private:
    /// Evaluates the function, and keeps the best point.
    double sample(const DVec<D>& point) {
        const double here = function_.at(point);
        if (here < best.distance) {
            best.distance = here;
            best.point = point;
        }
        return here;
    }

    void descend(DVec<D> from) {
        if (++descents_ > search_max_descents) return;
        double here = function_.at(from);
        for (int i = 0; i < search_max_descent_steps && here > options_.sufficient; ++i) {
            const DVec<D> gradient = function_.gradient(from, step_);
            if (!(length_squared(gradient) > 0)) return;
            const DVec<D> to_corner = core_.lowest(gradient) - from;
            if (-dot(gradient, to_corner) <= 0.25 * options_.tolerance) return;
            if (!step_down(from, here, [&](double part) { return from + to_corner * part; }) &&
                !step_down(from, here, [&](double part) { return core_.nearest(from - gradient * (part * size_)); }))
                return;
        }
    }
    template <class Place>
    bool step_down(DVec<D>& from, double& here, const Place& place) {
        double part = 1;
        for (int i = 0; i < search_max_halvings; ++i, part *= 0.5) {
            const DVec<D> candidate = place(part);
            const double value = sample(candidate);
            if (value < here - 0.1 * options_.tolerance) {
                from = candidate;
                here = value;
                return true;
            }
        }
        return false;
    }

    bool may_improve(double lower_bound) const { return may_improve(lower_bound, options_.tolerance); }
    bool may_improve(double lower_bound, double tolerance) const {
        return lower_bound < best.distance - tolerance && lower_bound <= options_.reach;
    }

    /// Bisects the simplex until no part of it can hold less.
    void split_simplex(CoreSimplex<D> first) {
        for (std::size_t i = 0; i < first.count; ++i) first.values[i] = sample(first.points[i]);
        SimplexStack<D> stack;
        stack.push(first);
        while (!stack.empty() && best.distance > options_.sufficient) {
            CoreSimplex<D> simplex = stack.pop();
            if (!may_improve(simplex.lower_bound)) continue;
            if (best.boxes == options_.max_boxes || stack.full()) {
                best.uncertainty =
                    std::max({best.uncertainty, best.distance - std::min(simplex.lower_bound, stack.lower_bound())});
                return;
            }
            ++best.boxes;
            simplex.lower_bound = std::max(simplex.lower_bound, lower_bound_of(simplex));
            if (!may_improve(simplex.lower_bound)) continue;
            const auto [i, j] = longest_edge(simplex);
            const DVec<D> middle = (simplex.points[i] + simplex.points[j]) * 0.5;
            if (middle == simplex.points[i] || middle == simplex.points[j]) continue;
            const double value = sample(middle);
            CoreSimplex<D> beside = simplex;
            simplex.points[i] = beside.points[j] = middle;
            simplex.values[i] = beside.values[j] = value;
            const bool beside_first = beside.values[i] < simplex.values[j];
            stack.push(beside_first ? simplex : beside);
            stack.push(beside_first ? beside : simplex);
        }
    }

    /// The lower bound of the function in the simplex, by all that is known of it.
    double lower_bound_of(const CoreSimplex<D>& simplex) {
        const DVec<D> middle = middle_of(simplex);
        const double here = sample(middle), reach = reach_from(simplex, middle);
        double lower_bound = here - function_.slope() * reach;
        if (!may_improve(lower_bound)) return lower_bound;
        if (reach > cell_size_) return lower_bound;
        // Between corners the function is estimated from the corners, with a dip like that in the centre.
        double lowest = simplex.values[0], mean = 0;
        for (std::size_t i = 0; i < simplex.count; ++i) {
            lowest = std::min(lowest, simplex.values[i]);
            mean += simplex.values[i] / static_cast<double>(simplex.count);
        }
        const double estimated = std::min(lowest, here) - 2 * std::max(mean - here, 0.0);
        if (!may_improve(estimated, estimate_tolerance * size_)) return std::numeric_limits<double>::infinity();
        lower_bound = std::max(lower_bound, estimated);
        if (here <= best.distance && may_improve(lower_bound)) descend(middle);
        return lower_bound;
    }

    const PlacedFunction<D>& function_;
    const Convex<D>& convex_;
    NearestInCore<D> core_;
    MinimumOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, cell_size_ = 0, step_ = 0;
    int descents_ = 0;
};

}  // namespace

template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& convex,
                             const MinimumOptions<D>& options) {
    if (convex.core == Core::points && convex.count == 1 && convex.inner_radius == 0) {
        Minimum<D> result;
        result.point = convex.place.point(DVec<D>(convex.vertices()[0]));
        const double here = function.at(result.point);
        if (here <= options.reach) result.distance = here;
        return result;
    }
    ConvexMinimum<D> search(function, convex, options);
    const Aabb<D>& own = function.function().bounds;
    search.run(function.function().place.point(DVec<D>(center(own))));
    return search.best;
}

#define ABUT_INSTANTIATE(D) \
    template Minimum<D> minimum_in_convex(const PlacedFunction<D>&, const Convex<D>&, const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
