#include <abut/query/detail/sdf/box_search.hpp>

namespace abut::detail {
namespace {

/// The limits on boxes, on descents, and on rounds of the pattern
/// search.
constexpr int max_boxes_of_two = 2048, max_descents = 32, max_rounds = 48;

/// How often a step is corrected to where both functions are equal.
constexpr int max_corrections = 3;

/// dot(normal, p) + weight * (function(p) - level); without a function, only the first.
template <int D>
struct WeightedFunction {
    const PlacedFunction<D>* function = nullptr;
    DVec<D> normal{0.0};
    double weight = 1, level = 0;
};

template <int D>
class LargerMinimum : BoxSearch<D> {
public:
    LargerMinimum(const WeightedFunction<D>& a, const WeightedFunction<D>& b, const Aabb<D>& box, double size,
                  const MinimumOptions<D>& options)
        : BoxSearch<D>(options),
          a_(a),
          b_(b),
          all_(SearchBox<D>::between(DVec<D>(box.min), DVec<D>(box.max))),
          size_(size) {
        if (!has_bounds()) options_.tolerance = std::max(options_.tolerance, estimate_tolerance * size_);
    }

    Minimum<D> find(const DVec<D>& start) {
        descend(start);
        this->run(all_, max_boxes_of_two);
        if (!has_bounds()) pattern_search();
        return best_;
    }

private:
    using BoxSearch<D>::options_;
    using BoxSearch<D>::best_;
    using BoxSearch<D>::may_improve;

    /// The values at a point.
    struct Values {
        double a, b;
        double larger() const { return std::max(a, b); }
    };
    /// A lower bound in a box: a plane through its middle, and a constant.
    struct LowerBound {
        double value;
        DVec<D> gradient;
        double constant;
    };

    bool has_bounds() const {
        for (const WeightedFunction<D>* own : {&a_, &b_})
            if (own->function != nullptr && own->function->function().bound == nullptr) return false;
        return true;
    }

    static double at(const WeightedFunction<D>& own, const DVec<D>& point) {
        const double along = dot(own.normal, point);
        return own.function == nullptr ? along : along + own.weight * (own.function->at(point) - own.level);
    }
    static DVec<D> gradient_at(const WeightedFunction<D>& own, const DVec<D>& point) {
        if (own.function == nullptr) return own.normal;
        DVec<D> gradient;
        own.function->at(point, gradient);
        return own.normal + gradient * own.weight;
    }
    /// Evaluates both, and keeps the best point.
    Values sample(const DVec<D>& point) {
        const Values result{at(a_, point), at(b_, point)};
        if (result.larger() < best_.distance) {
            best_.distance = result.larger();
            best_.point = point;
        }
        return result;
    }

    LowerBound lower_bound(const WeightedFunction<D>& own, const SearchBox<D>& box, Cut& cut) const {
        const double along = dot(own.normal, box.center), lowest = along - sum_along(own.normal, box.half);
        if (own.function == nullptr) return {along, own.normal, lowest};
        DistanceBound<D> bound;
        bound.anchor = best_.point;
        bound.sufficient = (this->limit() - lowest) / own.weight + own.level;
        const bool is_plane = own.function->bound(box.center, box.half, bound) == DistanceBoundStatus::valid;
        const double constant = own.weight * (bound.lower_bound - own.level);
        if (bound.cut_axis >= 0 && cut.axis < 0) cut = {bound.cut_axis, bound.cut};
        if (!is_plane) return {along + constant, own.normal, lowest + constant};
        return {along + own.weight * (bound.value - own.level), own.normal + bound.gradient * own.weight,
                lowest + constant};
    }

    void process(SearchBox<D> box) override {
        ++best_.boxes;
        const double before = best_.distance;
        const Values here = sample(box.center);
        Cut cut{-1, 0};
        const LowerBound a = lower_bound(a_, box, cut), b = lower_bound(b_, box, cut);
        box.lower_bound = std::max({box.lower_bound, a.constant, b.constant});
        // The larger is above each combination of both planes. The one of the least gradient is the best.
        const DVec<D> apart = a.gradient - b.gradient;
        for (const double share : {0.0, 1.0, equal_share(apart, b.gradient)})
            box.lower_bound = std::max(box.lower_bound, b.value + (a.value - b.value) * share -
                                                            sum_along(b.gradient + apart * share, box.half));
        if (!may_improve(box.lower_bound)) return;
        if (here.larger() < before) descend(box.center);
        if (may_improve(box.lower_bound)) this->push(box, cut);
    }

    /// The share of the first gradient in the shortest convex combination of two.
    static double equal_share(const DVec<D>& apart, const DVec<D>& second) {
        const double square = length_squared(apart);
        return square > 0 ? std::clamp(-dot(second, apart) / square, 0.0, 1.0) : 0.5;
    }

    /// Descends along a direction in which both functions fall, or the larger one alone.
    void descend(DVec<D> from) {
        if (++descents_ > max_descents) return;
        Values here = sample(from);
        double stride = 0.25 * size_;
        for (int i = 0; i < 2 * search_max_descent_steps && here.larger() > options_.sufficient; ++i) {
            const DVec<D> down_a = gradient_at(a_, from), down_b = gradient_at(b_, from), apart = down_a - down_b;
            const DVec<D> direction = down_b + apart * equal_share(apart, down_b);
            const DVec<D> larger = here.a > here.b ? down_a : down_b;
            const double square = std::max(length_squared(apart), 1e-12);
            const auto to_equal = [&](const Values& values) { return apart * ((values.b - values.a) / square); };
            const double enough = here.larger() - 0.1 * options_.tolerance;
            bool moved = false;
            for (int k = 0; k < search_max_halvings && !moved; ++k, stride *= 0.5) {
                DVec<D> next = from + to_equal(here) - direction * stride;
                Values values = sample(next);
                for (int c = 0; c < max_corrections && !(values.larger() < enough); ++c) {
                    next += to_equal(values);
                    values = sample(next);
                }
                if (!(values.larger() < enough)) {
                    next = from - larger * (stride / std::max(length(larger), 1e-12));
                    values = sample(next);
                }
                if (!(values.larger() < enough)) continue;
                here = values;
                from = next;
                moved = true;
                stride *= 4;
            }
            if (!moved) return;
        }
    }

    /// From the best point so far to lower ones all around, with shrinking steps: at an edge the gradients lead
    /// nowhere.
    void pattern_search() {
        if (!(best_.distance < std::numeric_limits<double>::infinity())) return;
        double stride = 0.1 * size_;
        for (int round = 0; round < max_rounds && stride > 0.1 * options_.tolerance; ++round) {
            const DVec<D> middle = best_.point;
            for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
                DVec<D> next = middle;
                for (int a = 0, rest = i; a < D; ++a, rest /= 3) next[a] += (rest % 3 - 1) * stride;
                sample(next);
            }
            stride *= best_.point == middle ? 0.5 : 1.5;
        }
    }

    const WeightedFunction<D>&a_, &b_;
    SearchBox<D> all_;
    double size_;
    int descents_ = 0;
};

}  // namespace

template <int D>
Minimum<D> minimum_of_larger(const PlacedFunction<D>& a, const PlacedFunction<D>& b, const Aabb<D>& box, double size,
                             const MinimumOptions<D>& options) {
    PlacedFunction<D> own_a = a, own_b = b;
    const DVec<D> middle = (DVec<D>(box.min) + DVec<D>(box.max)) * 0.5;
    own_a.set_size(middle, size);
    own_b.set_size(middle, size);
    const WeightedFunction<D> first{.function = &own_a}, second{.function = &own_b};
    return LargerMinimum<D>(first, second, box, size, options).find(middle);
}

template <int D>
Minimum<D> lowest_inside(const PlacedFunction<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                         double surface_tolerance, const MinimumOptions<D>& options) {
    // The height, and a steep wall around the shape.
    const DVec<D> low(bounds.min), high(bounds.max), middle = (low + high) * 0.5;
    const double size = 0.5 * length(high - low);
    PlacedFunction<D> own = function;
    own.set_size(middle, size);
    const WeightedFunction<D> height{.normal = normal};
    const WeightedFunction<D> wall{&own, normal, size / surface_tolerance, surface_tolerance};
    return LargerMinimum<D>(height, wall, bounds, size, options)
        .find(middle - normal * sum_along(normal, (high - low) * 0.5));
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template Minimum<D> minimum_of_larger(const PlacedFunction<D>&, const PlacedFunction<D>&, const Aabb<D>&, double, \
                                          const MinimumOptions<D>&);                                                  \
    template Minimum<D> lowest_inside(const PlacedFunction<D>&, const Aabb<D>&, const DVec<D>&, double,               \
                                      const MinimumOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
