#include <abut/convex/gjk.hpp>

namespace abut {
namespace {

template <int D>
bool holds(const Simplex<D>& simplex, const DVec<D>& position) {
    for (std::size_t i = 0; i < simplex.count; ++i)
        if (simplex.points[i].position == position) return true;
    return false;
}

template <int D>
double largest(const Simplex<D>& simplex) {
    double most = 0;
    for (std::size_t i = 0; i < simplex.count; ++i)
        most = std::max({most, abut::largest(simplex.points[i].on_a), abut::largest(simplex.points[i].on_b)});
    return most;
}

}  // namespace

template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double enough) {
    const bool yes_no = enough < std::numeric_limits<double>::infinity();
    GjkResult<D> result;
    Simplex<D>& simplex = result.simplex;
    const DVec<D> first = reference_point(difference.b()) - reference_point(difference.a());
    simplex.points[0] = difference.support(normalized(first));
    simplex.count = 1;
    result.closest = reduce_to_closest(simplex);

    double distance_squared = length_squared(result.closest);
    for (int step = 0; step < gjk_most_steps; ++step) {
        const double noise = 1e-15 * largest(simplex);
        if (distance_squared <= noise * noise) {
            result.exit = GjkExit::touching;
            return result;
        }
        if (yes_no && distance_squared <= enough * enough) {
            result.exit = GjkExit::within;
            return result;
        }
        const DifferencePoint<D> next = difference.support(-result.closest);
        // next.closest / |closest| is the distance of a plane that A - B lies behind: it bounds the true distance from
        // below.
        const double bound = dot(next.position, result.closest);
        if (yes_no && bound > 0 && bound * bound > enough * enough * distance_squared) {
            result.exit = GjkExit::beyond;
            return result;
        }
        if (holds(simplex, next.position) || distance_squared - bound <= 1e-15 * distance_squared) {
            result.exit = GjkExit::separated;
            return result;
        }
        const Simplex<D> before = simplex;
        simplex.points[simplex.count++] = next;
        const DVec<D> closest = reduce_to_closest(simplex);
        if (simplex.count == static_cast<std::size_t>(D) + 1) {
            result.closest = DVec<D>(0.0);
            result.exit = GjkExit::overlapping;
            return result;
        }
        const double now = length_squared(closest);
        if (!(now < distance_squared)) {
            simplex = before;
            result.exit = GjkExit::no_progress;
            return result;
        }
        result.closest = closest;
        distance_squared = now;
    }
    result.exit = GjkExit::bound_reached;
    return result;
}

template GjkResult<2> gjk(const CoreDifference<2>&, double);
template GjkResult<3> gjk(const CoreDifference<3>&, double);

}  // namespace abut
