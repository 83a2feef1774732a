#include <abut/query/search_boxes.hpp>

namespace abut {
namespace {

/// Where a point is nearest to in a core.
template <int D>
class NearestInCore {
public:
    explicit NearestInCore(const Convex<D>& convex) : convex_(convex) {
        convex_.radius = 0;
        if (convex.inner_radius > 0) return;
        if (convex.core == Core::points && convex.count <= 2) {
            first_ = convex.place.point(DVec<D>(convex.vertices()[0]));
            way_ = convex.count == 2 ? convex.place.point(DVec<D>(convex.vertices()[1])) - first_ : DVec<D>(0.0);
            kind_ = Kind::segment;
        } else if (is_plain_box(convex)) {
            kind_ = Kind::box;
        }
    }

    DVec<D> nearest(const DVec<D>& point) const {
        if (kind_ == Kind::segment) {
            const double square = length_squared(way_);
            return square > 0 ? first_ + way_ * std::clamp(dot(point - first_, way_) / square, 0.0, 1.0) : first_;
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
    DVec<D> first_, way_;
};

template <int D>
class InConvex {
public:
    InConvex(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options)
        : function_(function), convex_(convex), core_(convex), options_(bounded(options, false)) {
        DVec<D> low, high;
        for (int i = 0; i < D; ++i) {
            low[i] = core_support(convex, axis<D>(i, -1)).position[i];
            high[i] = core_support(convex, axis<D>(i, 1)).position[i];
        }
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        piece_ = piece_of(function, size_);
        step_ = function.step(all_.center, size_);
    }

    void run(const DVec<D>& middle_of_function) {
        const DVec<D> first = core_.nearest(all_.center);
        found(first);
        if (size_ == 0) return;
        go_down(first);
        const DVec<D> second = core_.nearest(middle_of_function);
        found(second);
        if (second != first && best.point == second) go_down(second);
        bool is_piece = false;
        all_.least = least_in(all_, is_piece);
        if (wanted(all_.least)) {
            ways_down_ = 0;
            if (has_simplices(convex_))
                each_simplex(convex_, [&](const CoreSimplex<D>& simplex) { look_at(simplex); });
            else
                look_at_boxes(*this, all_, options_);
        }
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        // Seen from its middle, whether or not that is in the core, most boxes are out of the question.
        const double around = function_.at(box.center) - function_.slope() * length(box.half);
        if (!(around < best.distance - options_.tolerance && around <= options_.reach)) return around;
        const DVec<D> near = core_.nearest(box.center), way = box.center - near;
        const double gap_squared = length_squared(way);
        constexpr double nothing = std::numeric_limits<double>::infinity();
        if (gap_squared > sum_along(way, box.half) * (1 + 1e-12) && gap_squared > 0) return nothing;
        const double here = found(near);
        const double least = std::max(around, here - function_.slope() * farthest(near, box));
        if (!(least < best.distance - options_.tolerance && least <= options_.reach)) return least;
        if (length(box.half) > piece_) return least;
        is_piece = length(box.half) <= least_guessed_piece * size_;
        const DistanceBound<D> bound = function_.guess(box.center, box.half, function_.at(box.center));
        const DVec<D> lowest = core_.lowest(bound.gradient);
        const double guessed =
            bound.value + std::max(dot(bound.gradient, lowest - box.center), -sum_along(bound.gradient, box.half));
        if (guessed < best.distance - options_.tolerance) go_down(near);
        return std::max(least, guessed);
    }

    Least<D> best;

private:
    /// What it is there.
    double found(const DVec<D>& point) {
        const double here = function_.at(point);
        if (here < best.distance) {
            best.distance = here;
            best.point = point;
        }
        return here;
    }

    void go_down(DVec<D> from) {
        if (++ways_down_ > search_most_ways_down) return;
        double here = function_.at(from);
        for (int i = 0; i < search_most_steps_down && here > options_.enough; ++i) {
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
        for (int i = 0; i < search_most_halvings; ++i, part *= 0.5) {
            const DVec<D> there = place(part);
            const double value = found(there);
            if (value < here - 0.1 * options_.tolerance) {
                from = there;
                here = value;
                return true;
            }
        }
        return false;
    }

    bool wanted(double least) const { return wanted(least, options_.tolerance); }
    bool wanted(double least, double tolerance) const {
        return least < best.distance - tolerance && least <= options_.reach;
    }

    /// Cuts it in two until nothing in it can be less.
    void look_at(CoreSimplex<D> first) {
        for (std::size_t i = 0; i < first.count; ++i) first.values[i] = found(first.points[i]);
        SimplexStack<D> stack;
        stack.push(first);
        while (!stack.empty() && best.distance > options_.enough) {
            CoreSimplex<D> simplex = stack.pop();
            if (!wanted(simplex.least)) continue;
            if (best.boxes == options_.most_boxes || stack.full()) {
                best.doubt = std::max({best.doubt, best.distance - std::min(simplex.least, stack.least())});
                return;
            }
            ++best.boxes;
            simplex.least = std::max(simplex.least, least_of(simplex));
            if (!wanted(simplex.least)) continue;
            const auto [i, j] = longest_edge(simplex);
            const DVec<D> middle = (simplex.points[i] + simplex.points[j]) * 0.5;
            if (middle == simplex.points[i] || middle == simplex.points[j]) continue;
            const double value = found(middle);
            CoreSimplex<D> beside = simplex;
            simplex.points[i] = beside.points[j] = middle;
            simplex.values[i] = beside.values[j] = value;
            const bool beside_first = beside.values[i] < simplex.values[j];
            stack.push(beside_first ? simplex : beside);
            stack.push(beside_first ? beside : simplex);
        }
    }

    /// What it holds at least, by all that is known of it.
    double least_of(const CoreSimplex<D>& simplex) {
        const DVec<D> middle = middle_of(simplex);
        const double here = found(middle), reach = reach_from(simplex, middle);
        double least = here - function_.slope() * reach;
        if (!wanted(least)) return least;
        if (reach > piece_) return least;
        // Between corners it is about as they are, and dips as it does in the middle.
        double lowest = simplex.values[0], mean = 0;
        for (std::size_t i = 0; i < simplex.count; ++i) {
            lowest = std::min(lowest, simplex.values[i]);
            mean += simplex.values[i] / static_cast<double>(simplex.count);
        }
        const double guessed = std::min(lowest, here) - 2 * std::max(mean - here, 0.0);
        if (!wanted(guessed, guess_tolerance * size_)) return std::numeric_limits<double>::infinity();
        least = std::max(least, guessed);
        if (here <= best.distance && wanted(least)) go_down(middle);
        return least;
    }

    const FunctionThere<D>& function_;
    const Convex<D>& convex_;
    NearestInCore<D> core_;
    LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

}  // namespace

template <int D>
Least<D> least_in(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options) {
    if (convex.core == Core::points && convex.count == 1 && convex.inner_radius == 0) {
        Least<D> result;
        result.point = convex.place.point(DVec<D>(convex.vertices()[0]));
        const double here = function.at(result.point);
        if (here <= options.reach) result.distance = here;
        return result;
    }
    InConvex<D> search(function, convex, options);
    const Aabb<D>& own = function.function().bounds;
    search.run(function.function().place.point(DVec<D>(center(own))));
    return search.best;
}

#define ABUT_INSTANTIATE(D) \
    template Least<D> least_in(const FunctionThere<D>&, const Convex<D>&, const LeastOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
