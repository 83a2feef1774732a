#include <abut/convex/gjk.hpp>
#include <abut/convex/penetration.hpp>
#include <abut/convex/signed_distance.hpp>

namespace abut {

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b) {
    const CoreDifference<D> difference(a, b);
    const GjkResult<D> apart = gjk(difference);
    SignedDistance<D> result;
    const double gap = length(apart.closest);
    // Below this the direction of the difference is rounding, sooner where rounding has stopped the walk already, and
    // the faces around the origin know better.
    const double blurred = (apart.exit == GjkExit::no_progress ? 1e-7 : 1e-10) *
                           std::max(largest(apart.simplex.points[0].on_a), largest(apart.simplex.points[0].on_b));
    if (apart.apart() && gap > blurred) {
        result.distance = gap;
        result.normal = -apart.closest / gap;
        result.face = apart.simplex;
    } else {
        const Penetration<D> deep = penetration(difference);
        result.distance = -deep.depth;
        result.normal = deep.normal;
        // Where they barely touch, a common point is on both surfaces.
        const bool deeper = deep.exit != PenetrationExit::flat && deep.depth > blurred;
        result.face = deeper ? deep.face : apart.simplex;
    }
    result.distance -= a.radius + b.radius;
    result.on_a = difference.origin() + result.face.combine(&DifferencePoint<D>::on_a) + result.normal * a.radius;
    return result;
}

template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b) {
    const CoreDifference<D> difference(a, b);
    const double enough = a.radius + b.radius;
    const GjkResult<D> result = gjk(difference, enough);
    switch (result.exit) {
        case GjkExit::beyond:
            return false;
        case GjkExit::within:
        case GjkExit::touching:
        case GjkExit::overlapping:
            return true;
        default:
            return length(result.closest) <= enough;
    }
}

#define ABUT_INSTANTIATE(D)                                                         \
    template SignedDistance<D> signed_distance(const Convex<D>&, const Convex<D>&); \
    template bool convex_overlap(const Convex<D>&, const Convex<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
