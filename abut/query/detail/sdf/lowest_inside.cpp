#include <abut/query/detail/sdf/branch_and_bound.hpp>

namespace abut::detail {
namespace {

/// The limit on rounds of the pattern search.
constexpr int max_rounds = 48;

template <int D>
class LowestPointSearch {
public:
    LowestPointSearch(const PlacedFunction<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                      const MinimumOptions<D>& options)
        : function_(function),
          normal_(normal),
          options_(with_box_limit(options, function.function().bound != nullptr)) {
        const DVec<D> low(bounds.min), high(bounds.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        cell_size_ = estimated_cell_size(function, size_);
        step_ = function.step(all_.center, 0.1 * size_);
    }

    void run() {
        // From below, which most likely finds the lowest point first.
        slide_down(all_.center - normal_ * sum_along(normal_, all_.half));
        slide_down(all_.center);
        // Coarse first, so that the exact pass processes few boxes.
        const double finest = options_.tolerance;
        for (const double coarse : {1e-2, 1e-3, 0.0}) {
            options_.tolerance = std::max(coarse * size_, finest);
            descents_ = 0;
            const int before = best.boxes;
            best.boxes = 0;
            best.uncertainty = 0;
            branch_and_bound(*this, all_, options_);
            best.boxes += before;
            best.uncertainty += options_.tolerance;
        }
        if (function_.function().bound == nullptr) pattern_search();
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double lower_bound_in(const SearchBox<D>& box, bool& is_smallest) {
        constexpr double no_point = std::numeric_limits<double>::infinity();
        const double lowest = dot(normal_, box.center) - sum_along(normal_, box.half);
        const double here = function_.at(box.center);
        if (here - function_.slope() * length(box.half) > options_.surface_tolerance) return no_point;
        DistanceBound<D> bound;
        const DistanceBoundStatus known = function_.bound(box.center, box.half, bound);
        const bool has_bound = known == DistanceBoundStatus::valid;
        const bool is_small = known == DistanceBoundStatus::unknown && length(box.half) <= cell_size_;
        if (!has_bound && !is_small) {
            if (here <= options_.surface_tolerance) descend_if_lower(box.center);
            return lowest;
        }
        if (!has_bound) bound = function_.estimate(box.center, box.half, here);
        if (has_bound &&
            std::max(bound.lower_bound, bound.value - sum_along(bound.gradient, box.half)) > options_.surface_tolerance)
            return no_point;
        // The function's lower plane bounds the shape in the box from below, with any weight above zero.
        const double square = length_squared(bound.gradient);
        const double weight = square > 0 ? std::max(0.0, -dot(normal_, bound.gradient) / square) : 0;
        const double lower_bound =
            std::max(lowest, dot(normal_, box.center) + weight * (bound.value - options_.surface_tolerance) -
                                 sum_along(normal_ + bound.gradient * weight, box.half));
        is_smallest = is_small && length(box.half) <= min_estimated_cell_fraction * size_;
        if (lower_bound < best.distance - options_.tolerance && square > 0.01) {
            const DVec<D> near = box.center - bound.gradient * (here / square);
            if (here <= options_.surface_tolerance) descend_if_lower(box.center);
            if (function_.at(near) <= options_.surface_tolerance) descend_if_lower(near);
        }
        return lower_bound;
    }

    Minimum<D> best;

private:
    /// From the lowest point so far to lower ones all around, with shrinking steps: at an edge the gradient leads
    /// nowhere.
    void pattern_search() {
        if (!(best.distance < std::numeric_limits<double>::infinity())) return;
        double stride = 0.1 * size_;
        for (int round = 0; round < max_rounds && stride > 0.1 * options_.tolerance; ++round) {
            const DVec<D> middle = best.point;
            for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
                const DVec<D> next = middle + direction_of(i) * stride;
                if (dot(normal_, next) < best.distance && function_.at(next) <= options_.surface_tolerance)
                    record(next);
            }
            stride *= best.point == middle ? 0.5 : 1.5;
        }
    }
    /// Directions to the sides, edges and corners of a box.
    static DVec<D> direction_of(int i) {
        DVec<D> result;
        for (int a = 0; a < D; ++a, i /= 3) result[a] = i % 3 - 1;
        return result;
    }

    /// Descends from a point inside, if that is lower than all so far.
    void descend_if_lower(const DVec<D>& point) {
        if (dot(normal_, point) < best.distance - options_.tolerance) {
            record(point);
            slide_down(point);
        }
    }
    /// Goes to the surface, and down along it.
    void slide_down(DVec<D> point) {
        if (++descents_ > search_max_descents) return;
        double stride = 0.25 * size_;
        if (!to_surface(point)) return;
        for (int i = 0; i < search_max_descent_steps; ++i) {
            record(point);
            const DVec<D> gradient = function_.gradient(point, step_);
            const double square = length_squared(gradient);
            if (!(square > 0)) return;
            const DVec<D> along = gradient * (dot(normal_, gradient) / square) - normal_;
            if (length(along) * stride <= 0.1 * options_.tolerance) return;
            DVec<D> next = point + along * stride;
            if (to_surface(next) && dot(normal_, next) < dot(normal_, point) - 0.01 * options_.tolerance)
                point = next;
            else
                stride *= 0.25;
        }
    }
    bool to_surface(DVec<D>& point) const {
        double here = function_.at(point);
        for (int i = 0; i < search_max_halvings && std::abs(here) > 0.5 * options_.surface_tolerance; ++i) {
            const DVec<D> gradient = function_.gradient(point, step_);
            const double square = length_squared(gradient);
            if (!(square > 0.01) || !std::isfinite(here)) return false;
            point -= gradient * (here / square);
            here = function_.at(point);
        }
        return here <= options_.surface_tolerance;
    }
    void record(const DVec<D>& point) {
        const double height = dot(normal_, point);
        if (height >= best.distance) return;
        best.distance = height;
        best.point = point;
    }

    const PlacedFunction<D>& function_;
    const DVec<D> normal_;
    MinimumOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, cell_size_ = 0, step_ = 0;
    int descents_ = 0;
};

}  // namespace

template <int D>
Minimum<D> lowest_inside(const PlacedFunction<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                         const MinimumOptions<D>& options) {
    LowestPointSearch<D> search(function, bounds, normal, options);
    search.run();
    return search.best;
}

#define ABUT_INSTANTIATE(D)                                                                     \
    template Minimum<D> lowest_inside(const PlacedFunction<D>&, const Aabb<D>&, const DVec<D>&, \
                                      const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
