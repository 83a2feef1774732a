#include <abut/convex/gjk/epa.hpp>
#include <abut/convex/gjk/gjk.hpp>
#include <abut/convex/gjk/gjk_fast.hpp>
#include <abut/convex/gjk/signed_distance.hpp>

namespace abut::detail {
namespace {

/// The signed distance of two cores, with the simplex of A - B at it.
template <int D>
struct CoreDistance {
    double distance;
    DVec<D> normal;
    Simplex<D> face;
};

/// The simplex at which A and B touch after B has moved by `depth` along the normal.
template <int D>
Simplex<D> simplex_at_contact(const CoreDifference<D>& difference, const DVec<D>& normal, double depth) {
    Convex<D> moved = difference.b();
    moved.place.offset += normal * depth;
    const CoreDifference<D> touching(difference.a(), moved);
    return gjk_common_point(touching).simplex;
}

/// The distance of the weighted point of a face of A - B from its target.
template <int D>
double distance_from(const DVec<D>& target, const Simplex<D>& face) {
    return length(face.combine(&DifferencePoint<D>::position) - target);
}

/// The distance if the bounds of GJK differ: the cores overlap, or are so thin or so near that GJK failed.
template <int D>
CoreDistance<D> penetration_depth(const CoreDifference<D>& difference, const GjkResult<D>& gjk_result,
                                  const SearchOptions<D>& options) {
    EpaResult<D> epa_result = epa(difference, options, &gjk_result.simplex);
    if (epa_result.exit == EpaExit::bound_reached || epa_result.exit == EpaExit::no_progress)
        minimise_depth(difference, epa_result);
    CoreDistance<D> result{-epa_result.depth, epa_result.normal, epa_result.face};
    // If the cores barely touch, a common point lies on both surfaces.
    if (gjk_result.upper_bound <= gjk_result.tolerance &&
        (epa_result.exit == EpaExit::flat || epa_result.depth <= 1e-3 * gjk_result.tolerance))
        result.face = gjk_result.simplex;
    else if (distance_from(epa_result.normal * epa_result.depth, epa_result.face) >
             gjk_result.tolerance + epa_tolerance * epa_result.depth)
        result.face = simplex_at_contact(difference, epa_result.normal, epa_result.depth);
    if (gjk_result.lower_bound > result.distance + 1e-3 * gjk_result.tolerance) {
        result.distance = gjk_result.lower_bound;
        result.normal = gjk_result.axis;
        if (gjk_result.lower_bound <= 0)
            result.face = simplex_at_contact(difference, gjk_result.axis, -gjk_result.lower_bound);
    }
    if (result.distance > 0) {
        if (gjk_result.upper_bound < distance_from(DVec<D>(0.0), result.face)) result.face = gjk_result.simplex;
        result.distance = std::max(result.distance, distance_from(DVec<D>(0.0), result.face));
    }
    return result;
}

template <int D>
CoreDistance<D> core_distance(const CoreDifference<D>& difference, const SearchOptions<D>& options) {
    const GjkResult<D> gjk_result = gjk(difference, std::numeric_limits<double>::infinity(), options);
    return gjk_result.converged() ? CoreDistance<D>{gjk_result.upper_bound, gjk_result.axis, gjk_result.simplex}
                                  : penetration_depth(difference, gjk_result, options);
}

template <int D>
SearchOptions<D> warm_started(SearchOptions<D> options, Cache& inside) {
    if (inside.count > 0) options.cache = &inside;
    return options;
}

}  // namespace

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    SignedDistance<D> result;
    Cache inside;
    if (fast_distance(a, b, options, result, inside)) return result;
    const CoreDifference<D> difference(a, b);
    const CoreDistance<D> cores = core_distance(difference, warm_started(options, inside));
    if (inside.count > 0 && options.cache != nullptr) *options.cache = inside;
    result.distance = cores.distance - a.radius - b.radius;
    result.normal = cores.normal;
    result.corners = closest_corners(cores.face);
    result.on_a = difference.origin() + cores.face.combine(&DifferencePoint<D>::on_a) + result.normal * a.radius;
    return result;
}

template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    const double max_distance = a.radius + b.radius;
    if (const auto fast = fast_overlap(a, b, options)) return *fast;
    const CoreDifference<D> difference(a, b);
    const GjkResult<D> gjk_result = gjk(difference, max_distance, options);
    if (gjk_result.lower_bound > max_distance) return false;
    if (gjk_result.upper_bound <= max_distance + gjk_result.tolerance) return true;
    return signed_distance(a, b).distance <= 0;
}

#define ABUT_INSTANTIATE(D)                                                                                  \
    template SignedDistance<D> signed_distance(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&); \
    template bool convex_overlap(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
