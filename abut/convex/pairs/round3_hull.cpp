// A point and a polyhedron: inside it, or certainly far from it.

#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/pairs/round3.hpp>
#include <abut/convex/point_soa.hpp>

namespace abut::detail {
namespace {

/// A point with a smaller depth, relative to the hull's extent, may be outside: the planes of two merged faces that
/// meet at a sharp edge may cross far from it.
constexpr double relative_tolerance = 1e-5;
static_assert(relative_tolerance > 4 * hull_flatness);

/// At least the longest side of the hull's bounding box.
double extent(const PointSoa& points) {
    double half = 0;
    for (int i = 0; i < 3; ++i) {
        const auto reach = static_cast<double>(points.reach[i]),
                   beside = std::abs(static_cast<double>(points.middle[i]));
        constexpr double rounding = 1e-6;
        half = std::max(half, reach - beside + rounding * reach);
    }
    return 2 * half;
}

/// The plane of a face, midway between its lowest and highest corner.
double offset_of(const Convex<3>& hull, std::uint32_t face, const DVec<3>& normal) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t i : hull.facets->loop(face)) {
        const double along = dot(normal, DVec<3>(hull.vertices()[i]));
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return 0.5 * (low + high);
}

DVec<3> seen_from(const Convex<3>& hull, const DVec<3>& point) {
    return hull.place.transposed(point - hull.place.offset) * (1 / (hull.scale * hull.scale));
}

}  // namespace

bool is_beyond_a_face(const Convex<3>& hull, const DVec<3>& point, double within) {
    // The lengths of the normals, and the products, are off by less.
    constexpr double rounding = 1e-6;
    const Facets& facets = *hull.facets;
    if (facets.offsets.empty()) return false;
    const DVec<3> seen = seen_from(hull, point);
    const std::uint32_t likely = farthest_point(facets.normals, seen);
    const double along = dot(DVec<3>(facets.normals[likely]), seen), offset = facets.offsets[likely];
    const double gap = along - offset - rounding * (std::abs(along) + std::abs(offset));
    return gap * hull.scale - hull.radius > within;
}

bool hull_point(const Convex<3>& hull, const Convex<3>& point, SignedDistance<3>& result) {
    if (hull.lanes == nullptr) return false;
    const DVec<3> seen = seen_from(hull, core_corner(point, 0));
    const Facets& facets = *hull.facets;
    const auto corner = [&](std::uint32_t i) { return DVec<3>(hull.vertices()[facets.loops[i]]); };
    // For most points outside one face decides.
    const std::uint32_t likely = farthest_point(facets.normals, seen);
    if (dot(DVec<3>(facets.normals[likely]), seen - corner(facets.loop_ends[likely] - 1)) >= 0) return false;
    double nearest = -std::numeric_limits<double>::infinity();
    std::uint32_t face = 0, begin = 0;
    for (std::uint32_t i = 0; i < facets.normals.size(); ++i) {
        const double beyond = dot(DVec<3>(facets.normals[i]), seen - corner(begin));
        begin = facets.loop_ends[i];
        if (!(beyond < 0)) return false;
        if (beyond <= nearest) continue;
        nearest = beyond;
        face = i;
    }
    if (!(nearest < -relative_tolerance * extent(*hull.lanes))) return false;

    const DVec<3> normal = normalized(DVec<3>(facets.normals[face]));
    const double beyond = dot(normal, seen) - offset_of(hull, face, normal);
    result.distance = beyond * hull.scale - hull.radius - point.radius;
    result.normal = normalized(hull.place.vector(normal));
    result.on_a = hull.place.point(seen - normal * beyond) + result.normal * hull.radius;
    const std::span<const std::uint32_t> loop = facets.loop(face);
    for (std::size_t i = 0; i < 3; ++i) result.corners.a[i] = loop[std::min(i, loop.size() - 1)];
    result.corners.count = 3;
    return true;
}

}  // namespace abut::detail
