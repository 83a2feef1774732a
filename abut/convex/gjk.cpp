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

/// How far a support point may be short of the farthest, as a part of the coordinates: a user's function is asked and
/// answers in floats.
template <int D>
double rounding(const CoreDifference<D>& difference) {
    const bool floats = difference.a().core == Core::function || difference.b().core == Core::function;
    return floats ? 4e-7 : 1e-15;
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
    const double relative_noise = rounding(difference);
    double proven = 0;  // A - B lies behind a plane this far from the origin
    for (int step = 0; step < gjk_most_steps; ++step) {
        const double noise = relative_noise * largest(simplex), distance = std::sqrt(distance_squared);
        if (distance <= noise) {
            result.exit = GjkExit::touching;
            return result;
        }
        if (yes_no && distance <= enough) {
            result.exit = GjkExit::within;
            return result;
        }
        const DifferencePoint<D> next = difference.support(-result.closest);
        const double plane = dot(next.position, result.closest) / distance;
        proven = std::max(proven, plane - noise);
        if (yes_no && proven > enough) {
            result.exit = GjkExit::beyond;
            return result;
        }
        if (holds(simplex, next.position) || distance - plane <= std::max(noise, 1e-13 * distance)) {
            result.exit = GjkExit::separated;
            return result;
        }
        const Simplex<D> before = simplex;
        simplex.points[simplex.count++] = next;
        const DVec<D> closest = reduce_to_closest(simplex);
        const double now = length_squared(closest);
        const bool whole = simplex.count == static_cast<std::size_t>(D) + 1;
        // Near the end on curved shapes the simplex shrinks until its faces are rounding. What was proven stays.
        if (!(now < distance_squared) || now < proven * proven || (whole && proven > 0)) {
            simplex = before;
            result.exit = GjkExit::no_progress;
            return result;
        }
        if (whole) {
            result.closest = DVec<D>(0.0);
            result.exit = GjkExit::overlapping;
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
