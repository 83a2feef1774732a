#include <abut/convex/gjk.hpp>

#include <optional>

namespace abut {
namespace {

template <int D>
bool holds(const Simplex<D>& simplex, const DVec<D>& position) {
    for (std::size_t i = 0; i < simplex.count; ++i)
        if (simplex.points[i].position == position) return true;
    return false;
}

/// Where to begin: with the simplex of the cache, else along its axis, else from A towards B.
template <int D>
Simplex<D> first_simplex(const CoreDifference<D>& difference, const Cache* cache) {
    Simplex<D> simplex;
    DVec<D> direction = reference_point(difference.b()) - reference_point(difference.a());
    if (cache != nullptr) {
        for (std::uint32_t i = 0; i < std::min(cache->count, static_cast<std::uint32_t>(D) + 1); ++i) {
            DifferencePoint<D> point;
            point.index_a = cache->corner_a[i];
            point.index_b = cache->corner_b[i];
            const Convex<D>&a = difference.a(), &b = difference.b();
            if (!has_corner(a, point.index_a) || !has_corner(b, point.index_b)) break;
            point.on_a = a.place.point(own_corner(a, point.index_a));
            point.on_b = b.place.point(own_corner(b, point.index_b));
            point.position = point.on_a - point.on_b;
            if (!holds(simplex, point.position)) simplex.points[simplex.count++] = point;
        }
        DVec<D> axis;
        for (int i = 0; i < D; ++i) axis[i] = static_cast<double>(cache->axis[static_cast<std::size_t>(i)]);
        if (largest(axis) > 0) direction = axis;
    }
    if (simplex.count == 0) simplex.points[simplex.count++] = difference.support(normalized(direction));
    return simplex;
}

template <int D>
void remember(const GjkResult<D>& result, Cache* cache) {
    if (cache == nullptr) return;
    cache->count = static_cast<std::uint32_t>(result.simplex.count);
    for (std::size_t i = 0; i < result.simplex.count; ++i) {
        cache->corner_a[i] = result.simplex.points[i].index_a;
        cache->corner_b[i] = result.simplex.points[i].index_b;
    }
    for (int i = 0; i < D; ++i) cache->axis[static_cast<std::size_t>(i)] = static_cast<float>(result.axis[i]);
}

template <int D>
void record(const Simplex<D>& simplex, const DVec<D>& closest, Trace<D>* trace) {
    if (trace == nullptr) return;
    GjkStep<D> step;
    step.count = simplex.count;
    for (std::size_t i = 0; i < simplex.count; ++i) step.points[i] = to_float(simplex.points[i].position);
    step.closest = to_float(closest);
    trace->steps.push_back(step);
}

template <int D>
class Walk {
public:
    Walk(const CoreDifference<D>& difference, double enough, const SearchOptions<D>& options)
        : difference_(difference), enough_(enough), options_(options) {}

    GjkResult<D> run() {
        simplex_ = first_simplex(difference_, options_.cache);
        first_ = simplex_.points[0];
        for (std::size_t i = 0; i < simplex_.count; ++i) look_at(simplex_.points[i]);
        closest_ = reduce_to_closest(simplex_);
        for (int step = 0; step < gjk_most_steps; ++step) {
            record(simplex_, closest_, options_.trace);
            if (const auto exit = advance()) return finish(*exit);
        }
        return finish(GjkExit::bound_reached);
    }

private:
    static constexpr bool whole(const Simplex<D>& simplex) { return simplex.count == static_cast<std::size_t>(D) + 1; }

    void look_at(const DifferencePoint<D>& point) {
        scale_ = std::max({scale_, largest(point.on_a), largest(point.on_b)});
        if (difference_.a().core == Core::function) spread_a_ = std::max(spread_a_, largest(point.on_a - first_.on_a));
        if (difference_.b().core == Core::function) spread_b_ = std::max(spread_b_, largest(point.on_b - first_.on_b));
    }

    /// How far a support point may be short of the farthest. A user's function is asked in floats, so that of two
    /// points nearly as far it may take the wrong one.
    double noise() const { return 1e-15 * scale_ + 1.2e-7 * (spread_a_ + spread_b_); }

    std::optional<GjkExit> advance() {
        if (whole(simplex_)) return GjkExit::overlapping;
        const double distance = length(closest_);
        if (distance <= noise()) return GjkExit::touching;
        if (distance <= enough_ && enough_ < std::numeric_limits<double>::infinity()) return GjkExit::within;

        const DVec<D> axis = -closest_ / distance;
        const DifferencePoint<D> next = difference_.support(axis);
        look_at(next);
        const double plane = -dot(next.position, axis);
        if (plane - noise() > result_.proven) prove(axis, plane);
        if (result_.proven > enough_) return GjkExit::beyond;
        if (holds(simplex_, next.position) || distance - plane <= std::max(noise(), 1e-13 * distance)) {
            // Of axes that prove the same, the one from point to point is best: then on_b lies across from on_a.
            if (distance - plane <= 1e-9 * scale_ + noise()) prove(axis, plane);
            return GjkExit::separated;
        }

        const Simplex<D> before = simplex_;
        simplex_.points[simplex_.count++] = next;
        const DVec<D> closest = reduce_to_closest(simplex_);
        const double now = length(closest);
        // Near the end on curved shapes the simplex shrinks until its faces are rounding. What was proven stays.
        if (!(now < distance) || now < result_.proven) {
            simplex_ = before;
            return GjkExit::no_progress;
        }
        closest_ = closest;
        return std::nullopt;
    }

    void prove(const DVec<D>& axis, double plane) {
        result_.proven = plane - noise();
        result_.axis = axis;
    }

    GjkResult<D> finish(GjkExit exit) {
        result_.exit = exit;
        result_.simplex = simplex_;
        // The weighted sum is a point of A - B; `closest_` is sharper, and wrong where the simplex is thin.
        const DVec<D> sum = simplex_.combine(&DifferencePoint<D>::position);
        result_.reached = length(sum);
        // Distances stop falling at the last digit of their squares, where the planes still turn by the root of that.
        const bool apart = result_.reached > 1e-6 * scale_;
        result_.doubt = (apart ? 1e-7 : 1e-9) * scale_ + 2 * noise();
        if (apart && exit == GjkExit::no_progress) {
            const DVec<D> axis = -sum / result_.reached;
            const double plane = -dot(difference_.support(axis).position, axis);
            if (result_.reached - plane <= result_.doubt) prove(axis, plane);
        }
        remember(result_, options_.cache);
        return result_;
    }

    const CoreDifference<D>& difference_;
    double enough_;
    const SearchOptions<D>& options_;
    Simplex<D> simplex_;
    DVec<D> closest_{0.0};
    DifferencePoint<D> first_;
    double scale_ = 0;                    ///< the largest coordinate seen
    double spread_a_ = 0, spread_b_ = 0;  ///< of the points of a user's function
    GjkResult<D> result_;
};

}  // namespace

template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double enough, const SearchOptions<D>& options) {
    return Walk<D>(difference, enough, options).run();
}

template <int D>
GjkResult<D> gjk_common_point(const CoreDifference<D>& difference) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    GjkResult<D> best = gjk(difference);
    for (std::size_t i = 0; i < 2 * D && best.reached > 1e-3 * best.doubt; ++i) {
        Cache start;
        start.axis[i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
        const GjkResult<D> walk = gjk(difference, infinity, {.cache = &start});
        if (walk.reached < best.reached) best = walk;
    }
    return best;
}

#define ABUT_INSTANTIATE(D)                                                               \
    template GjkResult<D> gjk(const CoreDifference<D>&, double, const SearchOptions<D>&); \
    template GjkResult<D> gjk_common_point(const CoreDifference<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
