#include <abut/convex/features.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/core_pairs3.hpp>

namespace abut::detail {
namespace {

/// A box or up to three points. For a polyhedron a search is always faster.
bool has_few_features(const Convex<3>& convex) {
    return has_features(convex) && convex.facets == nullptr;
}

/// The corners of a feature, by index; three of a face suffice.
void set_corners(const Convex<3>& convex, const ClosestFeature<3>& feature, ClosestCorners<3>& corners) {
    const std::uint32_t i = feature.index;
    if (feature.kind == FeatureKind::vertex) {
        corners.a[0] = i;
    } else if (feature.kind == FeatureKind::edge) {
        corners.a = {i & 0xffffu, i >> 16};
        corners.count = 2;
    } else {
        const std::uint32_t axis = i / 2, low = (i & 1u) << axis;
        corners.a = {low, low | 1u << (axis + 1) % 3, low | 1u << (axis + 2) % 3};
        if (convex.core == Core::points) corners.a = {0, 1, 2};
        corners.count = 3;
    }
}

/// The remaining pairs of a point B and a polytope A of few features.
bool polytope_point(const Convex<3>& a, const Convex<3>& b, SignedDistance<3>& result) {
    if (!has_few_features(a)) return false;
    const ClosestFeature<3> nearest = closest_feature(a, core_corner(b, 0));
    result.distance = nearest.distance - a.radius - b.radius;
    result.normal = nearest.normal;
    result.on_a = nearest.point + nearest.normal * a.radius;
    set_corners(a, nearest, result.corners);
    return true;
}

PairAnswer answer_if(bool found) {
    return found ? PairAnswer::yes : PairAnswer::unknown;
}

/// B is the simpler one of the pair.
PairAnswer distance_from(const Convex<3>& a, const Convex<3>& b, double reach, SignedDistance<3>& result) {
    if (is_round_points(b, 2))
        return is_round_points(a, 3) ? triangle_segment(a, b, reach, result) : PairAnswer::unknown;
    if (!is_round_points(b, 1)) return PairAnswer::unknown;
    if (is_plain_hull(a)) return answer_if(hull_point(a, b, result));
    return answer_if((is_round_points(a, 3) && triangle_point(a, b, result)) || polytope_point(a, b, result));
}

std::uint32_t complexity(const Convex<3>& convex) {
    return convex.core == Core::points ? convex.count : std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

PairAnswer closed_form_distance(const Convex<3>& a, const Convex<3>& b, double reach, Cache* cache,
                                SignedDistance<3>& result) {
    CoresDistance found;
    if (distance_of_cores(a, b, cache, found)) {
        set_distance(found, result);
        return PairAnswer::yes;
    }
    if (complexity(b) <= complexity(a)) return distance_from(a, b, reach, result);
    const PairAnswer answer = distance_from(b, a, reach, result);
    if (answer == PairAnswer::yes) flip(result);
    return answer;
}

}  // namespace abut::detail
