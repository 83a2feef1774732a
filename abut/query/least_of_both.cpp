#include <abut/query/search_boxes.hpp>

namespace abut {
namespace {

template <int D>
class OfBoth {
public:
    OfBoth(const FunctionThere<D>& a, const FunctionThere<D>& b, const Aabb<D>& box, double size,
           const LeastOptions<D>& options)
        : a_(a), b_(b), options_(bounded(options, a.function().bound != nullptr && b.function().bound != nullptr)) {
        const DVec<D> low(box.min), high(box.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = size;
        slope_ = std::max(a.slope(), b.slope());
        piece_ = std::min(piece_of(a, size), piece_of(b, size));
        step_ = std::min(a.step(all_.center, size), b.step(all_.center, size));
    }

    void run() {
        go_down(all_.center);
        look_at_boxes(*this, all_, options_);
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        const double of_a = a_.at(box.center), of_b = b_.at(box.center), here = std::max(of_a, of_b);
        const bool is_best = here < best.distance;
        keep(box.center, here);
        const double falls = slope_ * length(box.half), least = here - falls;
        if (!(least < best.distance - options_.tolerance && least <= options_.reach)) return least;
        DistanceBound<D> bound_a, bound_b;
        const DistanceBoundStatus known_a = a_.bound(box.center, box.half, bound_a),
                                  known_b = b_.bound(box.center, box.half, bound_b);
        const bool told_a = known_a == DistanceBoundStatus::valid, told_b = known_b == DistanceBoundStatus::valid;
        const bool both =
            (told_a || known_a == DistanceBoundStatus::unknown) && (told_b || known_b == DistanceBoundStatus::unknown);
        const bool is_small = both && !(told_a && told_b) && length(box.half) <= piece_;
        if (!told_a) bound_a = is_small ? plane_of(a_, box, of_a) : level_at(of_a - falls);
        if (!told_b) bound_b = is_small ? plane_of(b_, box, of_b) : level_at(of_b - falls);
        const auto lowest = [&](const DistanceBound<D>& bound) {
            return std::max(bound.value - sum_along(bound.gradient, box.half), bound.lower_bound);
        };
        DistanceBound<D> between;
        between.value = 0.5 * (bound_a.value + bound_b.value);
        between.gradient = (bound_a.gradient + bound_b.gradient) * 0.5;
        const double bounded = std::max({lowest(bound_a), lowest(bound_b), lowest(between)});
        is_piece = is_small && length(box.half) <= least_guessed_piece * size_;
        if (is_best && bounded < best.distance - options_.tolerance) go_down(box.center);
        return std::max(least, bounded);
    }

    Least<D> best;

private:
    static DistanceBound<D> level_at(double value) {
        DistanceBound<D> result;
        result.value = value;
        return result;
    }
    DistanceBound<D> plane_of(const FunctionThere<D>& function, const SearchBox<D>& box, double here) const {
        return function.guess(box.center, box.half, here);
    }
    void keep(const DVec<D>& point, double here) {
        if (here >= best.distance) return;
        best.distance = here;
        best.point = point;
    }

    /// To where both fall, or the larger one and the other no more than needed.
    void go_down(DVec<D> from) {
        if (++ways_down_ > search_most_ways_down) return;
        double of_a = a_.at(from), of_b = b_.at(from), here = std::max(of_a, of_b);
        keep(from, here);
        double stride = std::max(std::abs(here), 0.25 * size_);
        for (int i = 0; i < 2 * search_most_steps_down && here > options_.enough; ++i) {
            const DVec<D> down_a = a_.gradient(from, step_), down_b = b_.gradient(from, step_);
            // The shortest sum of the two with weights that make one: what it falls along, both fall.
            const DVec<D> apart = down_a - down_b;
            const double square = length_squared(apart);
            const double share = square > 0 ? std::clamp(-dot(down_b, apart) / square, 0.0, 1.0) : 0.5;
            DVec<D> way = down_b + apart * share;
            const double balance = (of_a - of_b) / std::max(square, 1e-12);
            // Where one is larger, first to where they are the same.
            const DVec<D> to_same = apart * -std::clamp(balance, -size_, size_);
            bool moved = false;
            for (int k = 0; k < search_most_halvings && !moved; ++k, stride *= 0.5) {
                for (const DVec<D>& next :
                     {from + to_same - way * stride, from - (of_a > of_b ? down_a : down_b) * stride}) {
                    const double next_a = a_.at(next), next_b = b_.at(next);
                    if (!(std::max(next_a, next_b) < here - 0.1 * options_.tolerance)) continue;
                    of_a = next_a;
                    of_b = next_b;
                    here = std::max(of_a, of_b);
                    from = next;
                    keep(from, here);
                    moved = true;
                    stride *= 4;
                    break;
                }
            }
            if (!moved) return;
        }
    }

    const FunctionThere<D>&a_, &b_;
    const LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, slope_ = 1, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

}  // namespace

template <int D>
Least<D> least_of_both(const FunctionThere<D>& a, const FunctionThere<D>& b, const Aabb<D>& box, double size,
                       const LeastOptions<D>& options) {
    OfBoth<D> search(a, b, box, size, options);
    search.run();
    return search.best;
}

#define ABUT_INSTANTIATE(D)                                                                                   \
    template Least<D> least_of_both(const FunctionThere<D>&, const FunctionThere<D>&, const Aabb<D>&, double, \
                                    const LeastOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
