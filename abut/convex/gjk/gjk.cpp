#include <abut/convex/gjk/gjk.hpp>

#include <optional>

namespace abut::detail {
namespace {

template <int D>
bool contains(const Simplex<D>& simplex, const DVec<D>& position) {
    for (std::size_t i = 0; i < simplex.count; ++i)
        if (simplex.points[i].position == position) return true;
    return false;
}

/// The first simplex: from the cache, else along the axis of the cache, else along the direction from A to B.
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
            point.on_a = a.place.point(local_corner(a, point.index_a));
            point.on_b = b.place.point(local_corner(b, point.index_b));
            point.position = point.on_a - point.on_b;
            if (!contains(simplex, point.position)) simplex.points[simplex.count++] = point;
        }
        const DVec<D> axis = axis_of<D>(*cache);
        if (largest(axis) > 0) direction = axis;
    }
    if (simplex.count == 0) simplex.points[simplex.count++] = difference.support(normalized(direction));
    return simplex;
}

template <int D>
void store(const GjkResult<D>& result, Cache* cache) {
    if (cache == nullptr) return;
    cache->count = static_cast<std::uint32_t>(result.simplex.count);
    for (std::size_t i = 0; i < result.simplex.count; ++i) {
        cache->corner_a[i] = result.simplex.points[i].index_a;
        cache->corner_b[i] = result.simplex.points[i].index_b;
    }
    set_axis(result.axis, *cache);
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
class Gjk {
public:
    Gjk(const CoreDifference<D>& difference, double max_distance, const SearchOptions<D>& options)
        : difference_(difference), max_distance_(max_distance), options_(options) {}

    GjkResult<D> run() {
        simplex_ = first_simplex(difference_, options_.cache);
        first_ = simplex_.points[0];
        for (std::size_t i = 0; i < simplex_.count; ++i) track_extents(simplex_.points[i]);
        closest_ = reduce_to_closest(simplex_);
        for (int step = 0; step < gjk_max_iterations; ++step) {
            record(simplex_, closest_, options_.trace);
            if (const auto exit = advance()) return finish(*exit);
        }
        return finish(GjkExit::bound_reached);
    }

private:
    static constexpr bool is_full(const Simplex<D>& simplex) {
        return simplex.count == static_cast<std::size_t>(D) + 1;
    }

    void track_extents(const DifferencePoint<D>& point) {
        scale_ = std::max({scale_, largest(point.on_a), largest(point.on_b)});
        if (difference_.a().core == Core::function) spread_a_ = std::max(spread_a_, largest(point.on_a - first_.on_a));
        if (difference_.b().core == Core::function) spread_b_ = std::max(spread_b_, largest(point.on_b - first_.on_b));
    }

    /// The error of a support value. A user's support function works in floats, so it may return the wrong one of two
    /// nearly equal points.
    double support_error() const { return 1e-15 * scale_ + 1.2e-7 * (spread_a_ + spread_b_); }

    std::optional<GjkExit> advance() {
        if (is_full(simplex_)) return GjkExit::overlapping;
        const double distance = length(closest_);
        if (distance <= support_error()) return GjkExit::touching;
        if (distance <= max_distance_ && max_distance_ < std::numeric_limits<double>::infinity())
            return GjkExit::within;

        const DVec<D> axis = -closest_ / distance;
        const DifferencePoint<D> next = difference_.support(axis);
        track_extents(next);
        const double plane = -dot(next.position, axis);
        if (plane - support_error() > result_.lower_bound) set_lower_bound(axis, plane);
        if (result_.lower_bound > max_distance_) return GjkExit::beyond;
        if (contains(simplex_, next.position) || distance - plane <= std::max(support_error(), 1e-13 * distance)) {
            // Of axes with the same bound, the one along the closest points is best: on_b is then opposite to on_a.
            if (distance - plane <= 1e-9 * scale_ + support_error()) set_lower_bound(axis, plane);
            return GjkExit::separated;
        }

        const Simplex<D> before = simplex_;
        simplex_.points[simplex_.count++] = next;
        const DVec<D> closest = reduce_to_closest(simplex_);
        const double now = length(closest);
        // On curved shapes the simplex shrinks near the end until its faces are rounding. The lower bound stays valid.
        if (!(now < distance) || now < result_.lower_bound) {
            simplex_ = before;
            return GjkExit::no_progress;
        }
        closest_ = closest;
        return std::nullopt;
    }

    void set_lower_bound(const DVec<D>& axis, double plane) {
        result_.lower_bound = plane - support_error();
        result_.axis = axis;
    }

    GjkResult<D> finish(GjkExit exit) {
        result_.exit = exit;
        result_.simplex = simplex_;
        // The weighted sum is a point of A - B. `closest_` is more precise, but wrong if the simplex is a sliver.
        const DVec<D> sum = simplex_.combine(&DifferencePoint<D>::position);
        result_.upper_bound = length(sum);
        // Distances stop decreasing at the last digit of their squares, where the error of the axis is the root of
        // that.
        const bool apart = result_.upper_bound > 1e-6 * scale_;
        result_.tolerance = (apart ? 1e-7 : 1e-9) * scale_ + 2 * support_error();
        if (apart && exit == GjkExit::no_progress) {
            const DVec<D> axis = -sum / result_.upper_bound;
            const double plane = -dot(difference_.support(axis).position, axis);
            if (result_.upper_bound - plane <= result_.tolerance) set_lower_bound(axis, plane);
        }
        store(result_, options_.cache);
        return result_;
    }

    const CoreDifference<D>& difference_;
    double max_distance_;
    const SearchOptions<D>& options_;
    Simplex<D> simplex_;
    DVec<D> closest_{0.0};
    DifferencePoint<D> first_;
    double scale_ = 0;                    ///< the largest coordinate so far
    double spread_a_ = 0, spread_b_ = 0;  ///< of the points of a user's support function
    GjkResult<D> result_;
};

}  // namespace

template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double max_distance, const SearchOptions<D>& options) {
    return Gjk<D>(difference, max_distance, options).run();
}

template <int D>
GjkResult<D> gjk_common_point(const CoreDifference<D>& difference) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    GjkResult<D> best = gjk(difference);
    for (std::size_t i = 0; i < 2 * D && best.upper_bound > 1e-3 * best.tolerance; ++i) {
        Cache start;
        start.axis[i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
        const GjkResult<D> attempt = gjk(difference, infinity, {.cache = &start});
        if (attempt.upper_bound < best.upper_bound) best = attempt;
    }
    return best;
}

#define ABUT_INSTANTIATE(D)                                                               \
    template GjkResult<D> gjk(const CoreDifference<D>&, double, const SearchOptions<D>&); \
    template GjkResult<D> gjk_common_point(const CoreDifference<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
