#include <abut/query/search_boxes.hpp>

namespace abut {
namespace {

/// The bound on looks all around.
constexpr int most_rounds = 48;

template <int D>
class Inside {
public:
    Inside(const FunctionThere<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
           const LeastOptions<D>& options)
        : function_(function), normal_(normal), options_(bounded(options, function.function().bound != nullptr)) {
        const DVec<D> low(bounds.min), high(bounds.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        piece_ = piece_of(function, size_);
        step_ = function.step(all_.center, 0.1 * size_);
    }

    void run() {
        // From below, where the surface is met that most probably is the lowest.
        candidate(all_.center - normal_ * sum_along(normal_, all_.half));
        candidate(all_.center);
        // First roughly, so that what is exact need look at little.
        const double finest = options_.tolerance;
        for (const double rough : {1e-2, 1e-3, 0.0}) {
            options_.tolerance = std::max(rough * size_, finest);
            ways_down_ = 0;
            const int before = best.boxes;
            best.boxes = 0;
            best.doubt = 0;
            look_at_boxes(*this, all_, options_);
            best.boxes += before;
            best.doubt += options_.tolerance;
        }
        if (function_.function().bound == nullptr) look_around();
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        constexpr double nothing = std::numeric_limits<double>::infinity();
        const double lowest = dot(normal_, box.center) - sum_along(normal_, box.half);
        const double here = function_.at(box.center);
        if (here - function_.slope() * length(box.half) > options_.off) return nothing;
        DistanceBound<D> bound;
        const DistanceBoundStatus known = function_.bound(box.center, box.half, bound);
        const bool is_told = known == DistanceBoundStatus::valid;
        const bool is_small = known == DistanceBoundStatus::unknown && length(box.half) <= piece_;
        if (!is_told && !is_small) {
            if (here <= options_.off) look_down(box.center);
            return lowest;
        }
        if (!is_told) bound = function_.guess(box.center, box.half, here);
        if (is_told && std::max(bound.lower_bound, bound.value - sum_along(bound.gradient, box.half)) > options_.off)
            return nothing;
        // Of the plane below which the shape is, in the box: for any weight above zero a bound.
        const double square = length_squared(bound.gradient);
        const double weight = square > 0 ? std::max(0.0, -dot(normal_, bound.gradient) / square) : 0;
        const double least = std::max(lowest, dot(normal_, box.center) + weight * (bound.value - options_.off) -
                                                  sum_along(normal_ + bound.gradient * weight, box.half));
        is_piece = is_small && length(box.half) <= least_guessed_piece * size_;
        if (least < best.distance - options_.tolerance && square > 0.01) {
            const DVec<D> near = box.center - bound.gradient * (here / square);
            if (here <= options_.off) look_down(box.center);
            if (function_.at(near) <= options_.off) look_down(near);
        }
        return least;
    }

    Least<D> best;

private:
    /// From the lowest place so far to lower ones all around, nearer and nearer: an edge leads nowhere by its gradient.
    void look_around() {
        if (!(best.distance < std::numeric_limits<double>::infinity())) return;
        double stride = 0.1 * size_;
        for (int round = 0; round < most_rounds && stride > 0.1 * options_.tolerance; ++round) {
            const DVec<D> middle = best.point;
            for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
                const DVec<D> next = middle + direction_of(i) * stride;
                if (dot(normal_, next) < best.distance && function_.at(next) <= options_.off) keep(next);
            }
            stride *= best.point == middle ? 0.5 : 1.5;
        }
    }
    /// To the sides, edges and corners of a box.
    static DVec<D> direction_of(int i) {
        DVec<D> result;
        for (int a = 0; a < D; ++a, i /= 3) result[a] = i % 3 - 1;
        return result;
    }

    /// From a place inside, if that is lower than all so far.
    void look_down(const DVec<D>& point) {
        if (dot(normal_, point) < best.distance - options_.tolerance) {
            keep(point);
            candidate(point);
        }
    }
    /// Goes from there to the surface, and down along it.
    void candidate(DVec<D> point) {
        if (++ways_down_ > search_most_ways_down) return;
        double stride = 0.25 * size_;
        if (!to_surface(point)) return;
        for (int i = 0; i < search_most_steps_down; ++i) {
            keep(point);
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
        for (int i = 0; i < search_most_halvings && std::abs(here) > 0.5 * options_.off; ++i) {
            const DVec<D> gradient = function_.gradient(point, step_);
            const double square = length_squared(gradient);
            if (!(square > 0.01) || !std::isfinite(here)) return false;
            point -= gradient * (here / square);
            here = function_.at(point);
        }
        return here <= options_.off;
    }
    void keep(const DVec<D>& point) {
        const double height = dot(normal_, point);
        if (height >= best.distance) return;
        best.distance = height;
        best.point = point;
    }

    const FunctionThere<D>& function_;
    const DVec<D> normal_;
    LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

}  // namespace

template <int D>
Least<D> lowest_inside(const FunctionThere<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                       const LeastOptions<D>& options) {
    Inside<D> search(function, bounds, normal, options);
    search.run();
    return search.best;
}

#define ABUT_INSTANTIATE(D) \
    template Least<D> lowest_inside(const FunctionThere<D>&, const Aabb<D>&, const DVec<D>&, const LeastOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
