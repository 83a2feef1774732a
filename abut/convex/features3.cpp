// Triangles and polyhedra in space: the point is seen at the origin.

#include <abut/convex/features.hpp>
#include <abut/convex/hull.hpp>

#include <limits>

namespace abut {
namespace {

/// What is not farther behind a face than this may be on it: for rounding, seen from coordinates of size 1, and in
/// parts of the extent, for faces of a hull that are not quite in one plane.
constexpr double on_it = 0x1p-40, on_hull = 2 * hull_flatness;
/// A face whose normal the placement shrinks by more than this has become a line.
constexpr double flattened = 0x1p-40;
/// A triangle whose sides meet at no greater sine than this is a line.
constexpr double no_area = 0x1p-30;
/// Normals of length 1 that agree to within this are the same but for rounding to float.
constexpr double same_normal = 0x1p-22;

/// The plane of a face, midway between its lowest and highest corner.
struct Plane {
    DVec<3> normal{0.0};  ///< of length 1; zero where the face has no area: other faces cover what it covers
    double beyond = 0;    ///< of the origin, along the normal
    double doubt = 0;     ///< the origin may be in front of the face where it is behind by no more than this

    bool proper() const { return normal != DVec<3>(0.0); }
    bool faces_origin() const { return proper() && beyond >= -doubt; }
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

/// Whether a place on the plane of a loop lies within it, by counting crossings along the axis closest to the normal.
/// The sides of edges would do, but that those of a hull's face aren't quite in one plane: a short edge may run
/// anywhere, and its outer side be where the face is.
template <class Corner>
bool is_within(const DVec<3>& place, const DVec<3>& normal, std::uint32_t count, const Corner& corner) {
    const DVec<3> steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    const auto seen = [&](const DVec<3>& p) { return DVec<2>(p[(up + 1) % 3], p[(up + 2) % 3]); };
    const DVec<2> from = seen(place);
    bool result = false;
    DVec<2> a = seen(corner(count - 1)) - from;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> b = seen(corner(i)) - from;
        const bool rising = b.y > 0;
        if ((a.y > 0) != rising && (cross(a, b) > 0) == rising) result = !result;
        a = b;
    }
    return result;
}

/// The closest place of a face with corner(i) for i < count, named by name(i).
template <class Corner, class Name>
ClosestFeature<3> closest_on_face(std::uint32_t face, const Plane& plane, std::uint32_t count, const Corner& corner,
                                  const Name& name) {
    const ClosestFeature<3> foot = on_plane(plane, face);
    if (is_within(foot.point, plane.normal, count, corner)) return foot;
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

/// Of points on a line: the segment between its ends.
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

/// A placed polyhedron, seen from the point.
class Surface {
public:
    Surface(std::span<const Vec3> points, const Facets& facets, const Affine<3>& seen)
        : points_(points), facets_(facets), seen_(seen) {
        const DVec<3>&u = seen.column[0], &v = seen.column[1], &w = seen.column[2];
        const double along_u = length(u), along_v = length(v), along_w = length(w);
        least_normal_ = flattened * std::max({along_u * along_v, along_v * along_w, along_w * along_u});
        Vec3 low = points[0], high = low;
        for (const Vec3& point : points)
            for (int i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], point[i]);
                high[i] = std::max(high[i], point[i]);
            }
        doubt_ = on_hull * largest(DVec<3>(high) - DVec<3>(low)) * std::max({along_u, along_v, along_w});
    }

    std::uint32_t face_count() const { return static_cast<std::uint32_t>(facets_.normals.size()); }

    Plane plane(std::uint32_t face) const {
        const DVec<3> normal = mapped_normal(seen_, own_normal(face));
        Plane result;
        if (length(normal) > least_normal_) result.normal = normalized(normal);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t i : facets_.loop(face)) {
            const DVec<3> p = corner(i);
            low = std::min(low, dot(result.normal, p));
            high = std::max(high, dot(result.normal, p));
            result.doubt = std::max(result.doubt, on_it * largest(p));
        }
        result.beyond = -0.5 * (low + high);
        result.doubt += doubt_;
        return result;
    }

    ClosestFeature<3> closest_on(std::uint32_t face, const Plane& plane) const {
        const std::span<const std::uint32_t> loop = facets_.loop(face);
        return closest_on_face(
            face, plane, static_cast<std::uint32_t>(loop.size()), [&](std::uint32_t i) { return corner(loop[i]); },
            [&](std::uint32_t i) { return loop[i]; });
    }

    std::uint32_t corner_count() const { return static_cast<std::uint32_t>(points_.size()); }
    DVec<3> corner(std::uint32_t i) const { return seen_.point(DVec<3>(points_[i])); }

private:
    /// Before it is placed: the stored one without its rounding to float. The normal of a sliver, made of its corners,
    /// may be anything, and then the stored one is right: all of the hull lies behind it.
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
    const Affine<3>& seen_;
    double least_normal_ = 0;
    double doubt_ = 0;
};

/// Seen from the point, outside or near the surface: the closest of all faces that look at it.
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

/// Whether all of the surface lies behind the plane through the closest place, to within the doubt.
bool is_way_out(const Surface& surface, const ClosestFeature<3>& found, double doubt) {
    for (std::uint32_t i = 0; i < surface.corner_count(); ++i)
        if (dot(found.normal, surface.corner(i) - found.point) > doubt) return false;
    return true;
}

ClosestFeature<3> closest_seen(const Surface& surface) {
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
    // Just below an edge between two faces of almost one plane, the point may be taken to neither. Then it is inside.
    const bool near_edge = result.kind != FeatureKind::face && result.distance <= nearest.doubt;
    if (near_edge && !is_way_out(surface, result, nearest.doubt)) {
        result.normal = nearest.normal;
        result.distance = nearest.beyond;
    }
    return result;
}

}  // namespace

ClosestFeature<3> closest_on_triangle(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& point) {
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
    Affine<3> seen = place;
    seen.offset -= point;
    ClosestFeature<3> result = closest_seen(Surface(points, facets, seen));
    result.point += point;
    return result;
}

}  // namespace abut
