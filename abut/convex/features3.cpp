// Closest features of triangles and polyhedra. Coordinates are relative to the query point.

#include <abut/convex/features.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// A point no farther behind a face than this may lie on it: relative to the coordinates for rounding, and relative to
/// the extent for nearly coplanar faces of a hull.
constexpr double space_rounding = 0x1p-40, face_tolerance = 2 * hull_flatness;
/// A face whose normal the placement shrinks below this has become a line.
constexpr double flattened = 0x1p-40;
/// A triangle whose sides enclose no larger sine than this is a line.
constexpr double no_area = 0x1p-30;
/// Unit normals that differ by no more than this are equal, but for rounding to float.
constexpr double same_normal = 0x1p-22;

/// The plane of a face, midway between its lowest and highest vertex.
struct Plane {
    DVec<3> normal{0.0};   ///< of length 1; zero if the face has no area, and other faces cover it
    double beyond = 0;     ///< the distance of the origin along the normal
    double tolerance = 0;  ///< the origin may be in front of the face if it is no farther behind than this

    bool proper() const { return normal != DVec<3>(0.0); }
    bool faces_origin() const { return proper() && beyond >= -tolerance; }
};

ClosestFeature<3> on_plane(const Plane& plane, std::uint32_t face) {
    ClosestFeature<3> result;
    result.kind = FeatureKind::face;
    result.index = face;
    result.point = -plane.normal * plane.beyond;
    result.normal = plane.normal;
    result.distance = plane.beyond;
    return result;
}

ClosestFeature<3> named(ClosestFeature<3> on_segment, std::uint32_t from, std::uint32_t to) {
    on_segment.index = on_segment.kind == FeatureKind::edge ? edge_index(from, to) : on_segment.index == 0 ? from : to;
    return on_segment;
}

/// Point in polygon by crossing number, along the axis closest to the normal. Tests against the edges' planes fail
/// here: the vertices of a hull's face aren't quite coplanar, so a short edge may have any direction.
template <class Corner>
bool is_within(const DVec<3>& place, const DVec<3>& normal, std::uint32_t count, const Corner& corner) {
    const int up = longest_axis(normal);
    const auto relative = [&](const DVec<3>& p) { return DVec<2>(p[(up + 1) % 3], p[(up + 2) % 3]); };
    const DVec<2> from = relative(place);
    bool result = false;
    DVec<2> a = relative(corner(count - 1)) - from;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> b = relative(corner(i)) - from;
        const bool rising = b.y > 0;
        if ((a.y > 0) != rising && (cross(a, b) > 0) == rising) result = !result;
        a = b;
    }
    return result;
}

/// The closest point on a face with corner(i) for i < count, whose vertex numbers are name(i).
template <class Corner, class Name>
ClosestFeature<3> closest_on_face(std::uint32_t face, const Plane& plane, std::uint32_t count, const Corner& corner,
                                  const Name& name) {
    const ClosestFeature<3> projection = on_plane(plane, face);
    if (is_within(projection.point, plane.normal, count, corner)) return projection;
    ClosestFeature<3> best;
    best.distance = std::numeric_limits<double>::infinity();
    std::uint32_t previous = count - 1;
    for (std::uint32_t i = 0; i < count; ++i) {
        const ClosestFeature<3> found = closest_on_segment(corner(previous), corner(i), DVec<3>(0.0), plane.normal);
        if (found.distance < best.distance) best = named(found, name(previous), name(i));
        previous = i;
    }
    return best;
}

/// For collinear points: the segment between their ends.
template <class Corner>
ClosestFeature<3> closest_on_row(std::uint32_t count, const Corner& corner) {
    const auto farthest_from = [&](std::uint32_t start) {
        std::uint32_t result = start;
        for (std::uint32_t i = 0; i < count; ++i)
            if (length(corner(i) - corner(start)) > length(corner(result) - corner(start))) result = i;
        return result;
    };
    const std::uint32_t from = farthest_from(0), to = farthest_from(from);
    return named(closest_on_segment(corner(from), corner(to), DVec<3>(0.0)), from, to);
}

/// A placed polyhedron, relative to the query point.
class Surface {
public:
    Surface(std::span<const Vec3> points, const Facets& facets, const Affine<3>& relative)
        : points_(points), facets_(facets), relative_(relative) {
        const DVec<3>&u = relative.column[0], &v = relative.column[1], &w = relative.column[2];
        const double along_u = length(u), along_v = length(v), along_w = length(w);
        min_normal_ = flattened * std::max({along_u * along_v, along_v * along_w, along_w * along_u});
        tolerance_ = face_tolerance * extent<3>(points) * std::max({along_u, along_v, along_w});
    }

    std::uint32_t face_count() const { return static_cast<std::uint32_t>(facets_.normals.size()); }

    Plane plane(std::uint32_t face) const {
        const DVec<3> normal = mapped_normal(relative_, own_normal(face));
        Plane result;
        if (length(normal) > min_normal_) result.normal = normalized(normal);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t i : facets_.loop(face)) {
            const DVec<3> p = corner(i);
            low = std::min(low, dot(result.normal, p));
            high = std::max(high, dot(result.normal, p));
            result.tolerance = std::max(result.tolerance, space_rounding * largest(p));
        }
        result.beyond = -0.5 * (low + high);
        result.tolerance += tolerance_;
        return result;
    }

    ClosestFeature<3> closest_on(std::uint32_t face, const Plane& plane) const {
        const std::span<const std::uint32_t> loop = facets_.loop(face);
        return closest_on_face(
            face, plane, static_cast<std::uint32_t>(loop.size()), [&](std::uint32_t i) { return corner(loop[i]); },
            [&](std::uint32_t i) { return loop[i]; });
    }

    std::uint32_t corner_count() const { return static_cast<std::uint32_t>(points_.size()); }
    DVec<3> corner(std::uint32_t i) const { return relative_.point(DVec<3>(points_[i])); }

private:
    /// The normal before placement: the stored one without its rounding to float. For a sliver the normal from the
    /// vertices may be anything; the stored one is right, because all of the hull lies behind it.
    DVec<3> own_normal(std::uint32_t face) const {
        const std::span<const std::uint32_t> loop = facets_.loop(face);
        const DVec<3> stored = normalized(DVec<3>(facets_.normals[face])), first(points_[loop[0]]);
        DVec<3> area(0.0), last = DVec<3>(points_[loop[1]]) - first;
        for (std::size_t i = 2; i < loop.size(); ++i) {
            const DVec<3> next = DVec<3>(points_[loop[i]]) - first;
            area += cross(last, next);
            last = next;
        }
        const DVec<3> exact = normalized(area, stored);
        return length(exact - stored) <= same_normal ? exact : stored;
    }

    std::span<const Vec3> points_;
    const Facets& facets_;
    const Affine<3>& relative_;
    double min_normal_ = 0;
    double tolerance_ = 0;
};

/// For a query point outside or near the surface: the closest of all faces that it is in front of.
ClosestFeature<3> closest_in_front(const Surface& surface) {
    ClosestFeature<3> best;
    best.distance = std::numeric_limits<double>::infinity();
    for (std::uint32_t face = 0; face < surface.face_count(); ++face) {
        const Plane plane = surface.plane(face);
        if (!plane.faces_origin()) continue;
        const ClosestFeature<3> found = surface.closest_on(face, plane);
        if (found.kind == FeatureKind::face && found.distance >= 0) return found;
        if (std::abs(found.distance) < std::abs(best.distance)) best = found;
    }
    return best;
}

/// Whether all of the surface lies behind the plane through the closest point, to within the tolerance.
bool is_outward_normal(const Surface& surface, const ClosestFeature<3>& found, double tolerance) {
    for (std::uint32_t i = 0; i < surface.corner_count(); ++i)
        if (dot(found.normal, surface.corner(i) - found.point) > tolerance) return false;
    return true;
}

ClosestFeature<3> closest_on_surface(const Surface& surface) {
    Plane nearest;
    std::uint32_t nearest_face = 0;
    for (std::uint32_t face = 0; face < surface.face_count(); ++face) {
        const Plane plane = surface.plane(face);
        if (!plane.proper() || (nearest.proper() && plane.beyond <= nearest.beyond)) continue;
        nearest = plane;
        nearest_face = face;
    }
    if (!nearest.proper())
        return closest_on_row(surface.corner_count(), [&](std::uint32_t i) { return surface.corner(i); });
    if (!nearest.faces_origin()) return on_plane(nearest, nearest_face);
    ClosestFeature<3> result = closest_in_front(surface);
    // Just below an edge between two nearly coplanar faces, neither face may contain the projection. The point is
    // inside.
    const bool near_edge = result.kind != FeatureKind::face && result.distance <= nearest.tolerance;
    if (near_edge && !is_outward_normal(surface, result, nearest.tolerance)) {
        result.normal = nearest.normal;
        result.distance = nearest.beyond;
    }
    return result;
}

}  // namespace

ClosestFeature<3> closest_on_triangle(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& point) {
    detail::enter_library();
    const std::array<DVec<3>, 3> corners{a - point, b - point, c - point};
    const auto corner = [&](std::uint32_t i) { return corners[i]; };
    const DVec<3> u = b - a, v = c - a, area = cross(u, v);
    ClosestFeature<3> result;
    if (length(area) > no_area * length(u) * length(v)) {
        const bool behind = dot(area, corners[0]) > 0;
        const DVec<3> normal = normalized(behind ? -area : area);
        const Plane plane{normal, -dot(normal, corners[0]), 0};
        result = closest_on_face(behind ? 1 : 0, plane, 3, corner, [](std::uint32_t i) { return i; });
    } else {
        result = closest_on_row(3, corner);
    }
    result.point += point;
    return result;
}

ClosestFeature<3> closest_on_polyhedron(std::span<const Vec3> points, const Facets& facets, const DVec<3>& point,
                                        const Affine<3>& place) {
    detail::enter_library();
    Affine<3> relative = place;
    relative.offset -= point;
    ClosestFeature<3> result = closest_on_surface(Surface(points, facets, relative));
    result.point += point;
    return result;
}

}  // namespace abut::detail
