#include <abut/convex/features.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/core_pairs3.hpp>

namespace abut::detail {
namespace {

/// Up to this many edges of a polygon, testing all is as fast as a search. For a polyhedron a search is always faster.
constexpr std::uint32_t max_features = 8;

template <int D>
bool has_few_features(const Convex<D>& convex) {
    return has_features(convex) && convex.facets == nullptr && convex.count <= max_features;
}

/// The corners of a feature, by index; three of a face suffice.
struct Corners {
    std::array<std::uint32_t, 3> indices{};
    std::size_t count = 1;
};

Corners corners_of_face(const Convex<2>&, std::uint32_t face) {
    return {{face}, 1};
}
Corners corners_of_face(const Convex<3>& convex, std::uint32_t face) {
    if (convex.core == Core::points) return {{0, 1, 2}, 3};
    const std::uint32_t axis = face / 2, low = (face & 1u) << axis;
    return {{low, low | 1u << (axis + 1) % 3, low | 1u << (axis + 2) % 3}, 3};
}

template <int D>
Corners corners_of_feature(const Convex<D>& convex, const ClosestFeature<D>& feature) {
    if (feature.kind == FeatureKind::edge) return {{feature.index & 0xffffu, feature.index >> 16}, 2};
    if (feature.kind == FeatureKind::face) return corners_of_face(convex, feature.index);
    return {{feature.index}, 1};
}

/// The distance of a polytope A from a point B, with their radii.
template <int D>
SignedDistance<D> distance_from_point(const Convex<D>& a, const Convex<D>& b) {
    const DVec<D> point = b.place.point(DVec<D>(b.vertices()[0]));
    const ClosestFeature<D> nearest = closest_feature(a, point);
    const Corners corners = corners_of_feature(a, nearest);
    SignedDistance<D> result;
    result.distance = nearest.distance - a.radius - b.radius;
    result.normal = nearest.normal;
    result.on_a = nearest.point + nearest.normal * a.radius;
    result.corners.count = corners.count;
    std::copy(corners.indices.begin(), corners.indices.end(), result.corners.a.begin());
    return result;
}

/// The remaining pairs of a point and a polytope of few features.
template <int D>
bool polytope_point(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result) {
    if (!has_few_features(a)) return false;
    result = distance_from_point(a, b);
    return true;
}

bool segment_segment(const Convex<2>& a, const Convex<2>& b, SignedDistance<2>& result) {
    const DVec<2> origin = core_corner(a, 0);
    SegmentsClosest<2> closest;
    if (!closest_on_segments(core_corner(a, 1) - origin, core_corner(b, 0) - origin, core_corner(b, 1) - origin,
                             closest))
        return false;
    result.distance = closest.gap - a.radius - b.radius;
    result.normal = closest.normal;
    result.on_a = origin + closest.on_a + closest.normal * a.radius;
    const auto name_ends = [](double part, CornerIndices<2>& corners) {
        corners[0] = part >= 1 ? 1 : 0;
        corners[1] = part > 0 ? 1 : 0;
    };
    name_ends(closest.places.on_a, result.corners.a);
    name_ends(closest.places.on_b, result.corners.b);
    result.corners.count = 2;
    return true;
}

bool distance_from(const Convex<2>& a, const Convex<2>& b, SignedDistance<2>& result) {
    if (is_round_points(b, 1)) return polytope_point(a, b, result);
    return is_round_points(a, 2) && is_round_points(b, 2) && segment_segment(a, b, result);
}

/// Of a triangle or a polyhedron.
bool distance_from(const Convex<3>& a, const Convex<3>& b, SignedDistance<3>& result) {
    if (is_round_points(b, 2)) return is_round_points(a, 3) && triangle_segment(a, b, result);
    if (!is_round_points(b, 1)) return false;
    if (is_plain_hull(a)) return hull_point(a, b, result);
    return (is_round_points(a, 3) && triangle_point(a, b, result)) || polytope_point(a, b, result);
}

/// The complexity of a core: B is to be the simpler one of a pair.
template <int D>
std::uint32_t complexity(const Convex<D>& convex) {
    return convex.core == Core::points ? convex.count : std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

template <int D>
bool closed_form_distance(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result) {
    if constexpr (D == 3) {
        CoresDistance found;
        if (distance_of_cores(a, b, nullptr, found)) {
            set_distance(found, result);
            return true;
        }
    }
    if (complexity(b) <= complexity(a)) return distance_from(a, b, result);
    if (!distance_from(b, a, result)) return false;
    flip(result);
    return true;
}

template bool closed_form_distance(const Convex<2>&, const Convex<2>&, SignedDistance<2>&);
template bool closed_form_distance(const Convex<3>&, const Convex<3>&, SignedDistance<3>&);

}  // namespace abut::detail
