#include <abut/query/detail/sdf/branch_and_bound.hpp>

namespace abut::detail {
namespace {

template <int D>
class LargerMinimum {
public:
    LargerMinimum(const PlacedFunction<D>& a, const PlacedFunction<D>& b, const Aabb<D>& box, double size,
                  const MinimumOptions<D>& options)
        : a_(a),
          b_(b),
          options_(with_box_limit(options, a.function().bound != nullptr && b.function().bound != nullptr)) {
        const DVec<D> low(box.min), high(box.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = size;
        slope_ = std::max(a.slope(), b.slope());
        cell_size_ = std::min(estimated_cell_size(a, size), estimated_cell_size(b, size));
        step_ = std::min(a.step(all_.center, size), b.step(all_.center, size));
    }

    void run() {
        descend(all_.center);
        branch_and_bound(*this, all_, options_);
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double lower_bound_in(const SearchBox<D>& box, bool& is_smallest) {
        const double of_a = a_.at(box.center), of_b = b_.at(box.center), here = std::max(of_a, of_b);
        const bool is_best = here < best.distance;
        record(box.center, here);
        const double max_change = slope_ * length(box.half), lower_bound = here - max_change;
        if (!(lower_bound < best.distance - options_.tolerance && lower_bound <= options_.reach)) return lower_bound;
        DistanceBound<D> bound_a, bound_b;
        const DistanceBoundStatus status_a = a_.bound(box.center, box.half, bound_a),
                                  status_b = b_.bound(box.center, box.half, bound_b);
        const bool known_a = status_a == DistanceBoundStatus::valid, known_b = status_b == DistanceBoundStatus::valid;
        const bool both_usable = (known_a || status_a == DistanceBoundStatus::unknown) &&
                                 (known_b || status_b == DistanceBoundStatus::unknown);
        const bool is_small = both_usable && !(known_a && known_b) && length(box.half) <= cell_size_;
        if (!known_a) bound_a = is_small ? plane_of(a_, box, of_a) : constant_bound(of_a - max_change);
        if (!known_b) bound_b = is_small ? plane_of(b_, box, of_b) : constant_bound(of_b - max_change);
        const auto lowest = [&](const DistanceBound<D>& bound) {
            return std::max(bound.value - sum_along(bound.gradient, box.half), bound.lower_bound);
        };
        DistanceBound<D> between;
        between.value = 0.5 * (bound_a.value + bound_b.value);
        between.gradient = (bound_a.gradient + bound_b.gradient) * 0.5;
        const double joint_bound = std::max({lowest(bound_a), lowest(bound_b), lowest(between)});
        is_smallest = is_small && length(box.half) <= min_estimated_cell_fraction * size_;
        if (is_best && joint_bound < best.distance - options_.tolerance) descend(box.center);
        return std::max(lower_bound, joint_bound);
    }

    Minimum<D> best;

private:
    static DistanceBound<D> constant_bound(double value) {
        DistanceBound<D> result;
        result.value = value;
        return result;
    }
    DistanceBound<D> plane_of(const PlacedFunction<D>& function, const SearchBox<D>& box, double here) const {
        return function.estimate(box.center, box.half, here);
    }
    void record(const DVec<D>& point, double here) {
        if (here >= best.distance) return;
        best.distance = here;
        best.point = point;
    }

    /// Descends along a direction in which both functions fall, or the larger one alone.
    void descend(DVec<D> from) {
        if (++descents_ > search_max_descents) return;
        double of_a = a_.at(from), of_b = b_.at(from), here = std::max(of_a, of_b);
        record(from, here);
        double stride = std::max(std::abs(here), 0.25 * size_);
        for (int i = 0; i < 2 * search_max_descent_steps && here > options_.sufficient; ++i) {
            const DVec<D> down_a = a_.gradient(from, step_), down_b = b_.gradient(from, step_);
            // The shortest convex combination of the two gradients: both functions fall against it.
            const DVec<D> apart = down_a - down_b;
            const double square = length_squared(apart);
            const double share = square > 0 ? std::clamp(-dot(down_b, apart) / square, 0.0, 1.0) : 0.5;
            DVec<D> direction = down_b + apart * share;
            const double balance = (of_a - of_b) / std::max(square, 1e-12);
            // If one function is larger, go first to where they are equal.
            const DVec<D> to_same = apart * -std::clamp(balance, -size_, size_);
            bool moved = false;
            for (int k = 0; k < search_max_halvings && !moved; ++k, stride *= 0.5) {
                for (const DVec<D>& next :
                     {from + to_same - direction * stride, from - (of_a > of_b ? down_a : down_b) * stride}) {
                    const double next_a = a_.at(next), next_b = b_.at(next);
                    if (!(std::max(next_a, next_b) < here - 0.1 * options_.tolerance)) continue;
                    of_a = next_a;
                    of_b = next_b;
                    here = std::max(of_a, of_b);
                    from = next;
                    record(from, here);
                    moved = true;
                    stride *= 4;
                    break;
                }
            }
            if (!moved) return;
        }
    }

    const PlacedFunction<D>&a_, &b_;
    const MinimumOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, slope_ = 1, cell_size_ = 0, step_ = 0;
    int descents_ = 0;
};

}  // namespace

template <int D>
Minimum<D> minimum_of_larger(const PlacedFunction<D>& a, const PlacedFunction<D>& b, const Aabb<D>& box, double size,
                             const MinimumOptions<D>& options) {
    LargerMinimum<D> search(a, b, box, size, options);
    search.run();
    return search.best;
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template Minimum<D> minimum_of_larger(const PlacedFunction<D>&, const PlacedFunction<D>&, const Aabb<D>&, double, \
                                          const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
