#include <abut/convex/features.hpp>
#include <abut/query/closed_form.hpp>

namespace abut {
namespace {

/// So many sides of a polygon are looked at one by one as fast as a search finds the right one. Of a polyhedron they
/// never are.
constexpr std::uint32_t few = 8;

template <int D>
bool is_round_points(const Convex<D>& convex, std::uint32_t count) {
    return convex.core == Core::points && convex.count == count && convex.inner_radius == 0;
}

template <int D>
bool has_few_features(const Convex<D>& convex) {
    return has_features(convex) && convex.facets == nullptr && convex.count <= few;
}

/// The corners of a feature, by number; at most three of a face.
struct Corners {
    std::array<std::uint32_t, 3> numbers{};
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
Corners corners_of(const Convex<D>& convex, const ClosestFeature<D>& feature) {
    if (feature.kind == FeatureKind::edge) return {{feature.index & 0xffffu, feature.index >> 16}, 2};
    if (feature.kind == FeatureKind::face) return corners_of_face(convex, feature.index);
    return {{feature.index}, 1};
}

/// The distance of a polytope A from a point B, with their radii.
template <int D>
SignedDistance<D> distance_from_point(const Convex<D>& a, const Convex<D>& b) {
    const DVec<D> point = b.place.point(DVec<D>(b.vertices()[0]));
    const ClosestFeature<D> nearest = closest_feature(a, point);
    const Corners corners = corners_of(a, nearest);
    SignedDistance<D> result;
    result.distance = nearest.distance - a.radius - b.radius;
    result.normal = nearest.normal;
    result.on_a = nearest.point + nearest.normal * a.radius;
    result.corners.count = corners.count;
    std::copy(corners.numbers.begin(), corners.numbers.end(), result.corners.a.begin());
    return result;
}

template <int D>
SignedDistance<D> turned_round(SignedDistance<D> distance) {
    distance.on_a = distance.on_b();
    distance.normal = -distance.normal;
    std::swap(distance.corners.a, distance.corners.b);
    return distance;
}

/// Two places on two segments, by their parts of the way.
struct Places {
    double on_a, on_b;
};

/// Where two segments are nearest: an end of one and its foot on the other, or the feet of the common perpendicular.
/// Ericson, Real-Time Collision Detection (2005), 5.1.9; each candidate is tried, so that parallel ones are no case of
/// their own.
template <int D>
Places nearest_places(const DVec<D>& a, const DVec<D>& u, const DVec<D>& b, const DVec<D>& v) {
    const DVec<D> w = a - b;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    Places best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](double s, double t) {
        const double distance = length_squared(w + u * s - v * t);
        if (distance >= least) return;
        least = distance;
        best = {s, t};
    };
    const auto part = [](double along, double whole) { return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0; };
    const double whole = uu * vv - uv * uv;
    if (whole > 0) {
        const double s = (uv * vw - vv * uw) / whole, t = (uu * vw - uv * uw) / whole;
        if (s > 0 && s < 1 && t > 0 && t < 1) offer(s, t);
    }
    offer(0, part(vw, vv));
    offer(1, part(vw + uv, vv));
    offer(part(-uw, uu), 0);
    offer(part(uv - uw, uu), 1);
    return best;
}

template <int D>
std::optional<SignedDistance<D>> distance_of_segments(const Convex<D>& a, const Convex<D>& b) {
    const DVec<D> origin = a.place.point(DVec<D>(a.vertices()[0]));
    const auto corner = [&](const Convex<D>& convex, std::uint32_t i) {
        return convex.place.point(DVec<D>(convex.vertices()[i])) - origin;
    };
    const DVec<D> a_ends[2] = {corner(a, 0), corner(a, 1)}, b_ends[2] = {corner(b, 0), corner(b, 1)};
    const DVec<D> u = a_ends[1] - a_ends[0], v = b_ends[1] - b_ends[0];
    const Places places = nearest_places(a_ends[0], u, b_ends[0], v);
    const DVec<D> on_a = a_ends[0] + u * places.on_a, on_b = b_ends[0] + v * places.on_b, between = on_b - on_a;
    const double gap = length(between);
    // Nearer than this the direction between the points is rounding; and where nearly parallel segments are nearest may
    // be. Then there is no plane between them that proves the gap.
    const double scale = std::max({largest(a_ends[1]), largest(b_ends[0]), largest(b_ends[1])});
    if (!(gap > 1e-6 * scale)) return std::nullopt;
    const DVec<D> normal = between / gap;
    const double proven = std::min(dot(normal, b_ends[0]), dot(normal, b_ends[1])) -
                          std::max(dot(normal, a_ends[0]), dot(normal, a_ends[1]));
    if (gap - proven > 1e-9 * scale) return std::nullopt;

    SignedDistance<D> result;
    result.distance = gap - a.radius - b.radius;
    result.normal = normal;
    result.on_a = origin + on_a + result.normal * a.radius;
    const auto corners = [](double part) -> Corners {
        return part <= 0 ? Corners{{0}, 1} : part >= 1 ? Corners{{1}, 1} : Corners{{0, 1}, 2};
    };
    const Corners of_a = corners(places.on_a), of_b = corners(places.on_b);
    result.corners.count = std::max(of_a.count, of_b.count);
    for (std::size_t i = 0; i < result.corners.count; ++i) {
        result.corners.a[i] = of_a.numbers[std::min(i, of_a.count - 1)];
        result.corners.b[i] = of_b.numbers[std::min(i, of_b.count - 1)];
    }
    return result;
}

}  // namespace

template <int D>
std::optional<SignedDistance<D>> closed_form(const Convex<D>& a, const Convex<D>& b) {
    if (is_round_points(b, 1) && has_few_features(a)) return distance_from_point(a, b);
    if (is_round_points(a, 1) && has_few_features(b)) return turned_round(distance_from_point(b, a));
    if (is_round_points(a, 2) && is_round_points(b, 2)) return distance_of_segments(a, b);
    return std::nullopt;
}

template std::optional<SignedDistance<2>> closed_form(const Convex<2>&, const Convex<2>&);
template std::optional<SignedDistance<3>> closed_form(const Convex<3>&, const Convex<3>&);

}  // namespace abut
