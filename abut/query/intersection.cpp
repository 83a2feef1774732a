#include <abut/convex/clip.hpp>
#include <abut/convex/signed_distance.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/overlaps.hpp>

namespace abut {
namespace {

template <int D>
bool has_float_corners(const Convex<D>& convex) {
    if (!detail::has_corners_only(convex) || !is_finite(convex)) return false;
    const Aabb<D> box = bounds(convex);
    return is_finite<D>(box.min) && is_finite<D>(box.max);
}

template <int D>
bool convex_intersection(const Convex<D>& a, const Convex<D>& b, PolytopeOf<D>& out, const QueryOptions<D>& options) {
    const bool possible = has_float_corners(a) && has_float_corners(b);
    ABUT_ASSERT(possible);
    if (!possible || !overlaps(View<D>(a), View<D>(b), {.cache = options.cache})) return false;

    std::vector<DVec<D>> points = clip(a, b, options.trace);
    if (points.empty()) {
        // They touch for one and miss by a rounding for the other.
        const SignedDistance<D> touch = signed_distance(a, b);
        points.push_back(0.5 * (touch.on_a + touch.on_b()));
    }
    std::vector<Vec<D>> rounded;
    for (const DVec<D>& point : points) rounded.push_back(to_float(point));
    out = *PolytopeOf<D>::build(rounded);
    return true;
}

}  // namespace

bool intersection(const Convex<2>& a, const Convex<2>& b, Polygon& out, const QueryOptions<2>& options) {
    return convex_intersection(a, b, out, options);
}

bool intersection(const Convex<3>& a, const Convex<3>& b, Polyhedron& out, const QueryOptions<3>& options) {
    return convex_intersection(a, b, out, options);
}

}  // namespace abut
