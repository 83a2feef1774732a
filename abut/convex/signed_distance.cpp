#include <abut/convex/features.hpp>
#include <abut/convex/gjk.hpp>
#include <abut/convex/penetration.hpp>
#include <abut/convex/quick_distance.hpp>
#include <abut/convex/sat.hpp>
#include <abut/convex/signed_distance.hpp>

namespace abut {
namespace {

/// The signed distance of two cores, with the simplex of A - B at it.
template <int D>
struct CoreDistance {
    double distance;
    DVec<D> normal;
    Simplex<D> face;
};

/// A box keeps its axes however thin it is; a polygon has a volume as long as its placement doesn't flatten it.
template <int D>
bool keeps_its_axes(const Convex<D>& core) {
    if (!keeps_its_form(core)) return false;
    return core.core == Core::box || (D == 2 && core.core == Core::points && core.points != nullptr && core.count > 2);
}

/// Whether the separating axes are few, and all there: with one body of some volume the difference has no other sides.
bool few_axes(const CoreDifference<2>& difference) {
    const Convex<2>&a = difference.a(), &b = difference.b();
    return has_features(a) && has_features(b) && a.count + b.count <= 16 && (keeps_its_axes(a) || keeps_its_axes(b));
}
bool few_axes(const CoreDifference<3>& difference) {
    return keeps_its_axes(difference.a()) && keeps_its_axes(difference.b());
}

/// The simplex at which A and B touch, once B has moved by `depth` along the normal.
template <int D>
Simplex<D> touching_face(const CoreDifference<D>& difference, const DVec<D>& normal, double depth) {
    Convex<D> moved = difference.b();
    moved.place.offset += normal * depth;
    const CoreDifference<D> touching(difference.a(), moved);
    return gjk_common_point(touching).simplex;
}

/// How far the weighted point of a face of A - B is from where it should be.
template <int D>
double distance_from(const DVec<D>& target, const Simplex<D>& face) {
    return length(face.combine(&DifferencePoint<D>::position) - target);
}

/// Where the walk proved nothing: they overlap, or are so thin or so near that it lost its way.
template <int D>
CoreDistance<D> deep_distance(const CoreDifference<D>& difference, const GjkResult<D>& walk,
                              const SearchOptions<D>& options) {
    Penetration<D> deep = penetration(difference, options, &walk.simplex);
    if (deep.exit == PenetrationExit::bound_reached || deep.exit == PenetrationExit::no_progress)
        descend(difference, deep);
    CoreDistance<D> result{-deep.depth, deep.normal, deep.face};
    // Where they barely touch, a common point is on both surfaces.
    if (walk.reached <= walk.doubt && (deep.exit == PenetrationExit::flat || deep.depth <= 1e-3 * walk.doubt))
        result.face = walk.simplex;
    else if (distance_from(deep.normal * deep.depth, deep.face) > walk.doubt + penetration_doubt * deep.depth)
        result.face = touching_face(difference, deep.normal, deep.depth);
    if (walk.proven > result.distance + 1e-3 * walk.doubt) {
        result.distance = walk.proven;
        result.normal = walk.axis;
        if (walk.proven <= 0) result.face = touching_face(difference, walk.axis, -walk.proven);
    }
    if (result.distance > 0) {
        if (walk.reached < distance_from(DVec<D>(0.0), result.face)) result.face = walk.simplex;
        result.distance = std::max(result.distance, distance_from(DVec<D>(0.0), result.face));
    }
    return result;
}

template <int D>
CoreDistance<D> core_distance(const CoreDifference<D>& difference, SearchOptions<D> options) {
    Cache found;
    if (few_axes(difference)) {
        const SeparatingAxis<D> axis = separating_axis(difference, 0, options.trace);
        // None was tried where all edges are lost in the rounding of corners that are far away.
        const bool tried = axis.normal != DVec<D>(0.0);
        if (tried && axis.extent >= 0)
            return {-axis.extent, axis.normal, touching_face(difference, axis.normal, axis.extent)};
        // Along an axis that parts them is where the nearest points are.
        for (int i = 0; i < D; ++i) found.axis[static_cast<std::size_t>(i)] = static_cast<float>(axis.normal[i]);
        if (options.cache == nullptr) options.cache = &found;
    }
    const GjkResult<D> walk = gjk(difference, std::numeric_limits<double>::infinity(), options);
    return walk.agreed() ? CoreDistance<D>{walk.reached, walk.axis, walk.simplex}
                         : deep_distance(difference, walk, options);
}

template <int D>
SearchOptions<D> from_there(SearchOptions<D> options, Cache& inside) {
    if (inside.count > 0) options.cache = &inside;
    return options;
}

}  // namespace

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    SignedDistance<D> result;
    Cache inside;
    if (quick_distance(a, b, options, result, inside)) return result;
    const CoreDifference<D> difference(a, b);
    const CoreDistance<D> cores = core_distance(difference, from_there(options, inside));
    if (inside.count > 0 && options.cache != nullptr) *options.cache = inside;
    result.distance = cores.distance - a.radius - b.radius;
    result.normal = cores.normal;
    result.corners = corners_of(cores.face);
    result.on_a = difference.origin() + cores.face.combine(&DifferencePoint<D>::on_a) + result.normal * a.radius;
    return result;
}

template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    const double enough = a.radius + b.radius;
    if (const auto quick = quick_overlap(a, b, options)) return *quick;
    const CoreDifference<D> difference(a, b);
    if (few_axes(difference)) {
        const SeparatingAxis<D> axis = separating_axis(difference, enough, options.trace);
        if (-axis.extent > enough) return false;
        if (enough == 0 && axis.normal != DVec<D>(0.0)) return true;
    }
    const GjkResult<D> walk = gjk(difference, enough, options);
    if (walk.proven > enough) return false;
    if (walk.reached <= enough + walk.doubt) return true;
    return signed_distance(a, b).distance <= 0;
}

#define ABUT_INSTANTIATE(D)                                                                                  \
    template SignedDistance<D> signed_distance(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&); \
    template bool convex_overlap(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
