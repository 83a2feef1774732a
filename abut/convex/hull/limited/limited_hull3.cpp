// Hulls with a vertex limit in 3D.

#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/interior_filter.hpp>
#include <abut/convex/hull/limited/inner_hull.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/hull/limited/minimum_box.hpp>
#include <abut/convex/hull/limited/outer_hull.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace abut::detail {
namespace {

/// The tolerance of the surface, for a body of about size 1. The planes move outwards to all points at the end.
constexpr double coarse = 0x1p-17;
constexpr std::size_t few_corners = 32, very_few_corners = 16, box_corners = 32, pool_corners = 64;
constexpr int tightening_rounds = 8;

/// Whether all points lie in the hull of a closed surface with outward winding: none is above a triangle.
bool holds(std::span<const Vec3> corners, std::span<const std::uint32_t> triangles, std::span<const Vec3> points) {
    const auto [low, high] = min_max<3>(points);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const Vec3 &a = corners[triangles[i]], &b = corners[triangles[i + 1]], &c = corners[triangles[i + 2]];
        const DVec<3> origin(a), u = DVec<3>(b) - origin, v = DVec<3>(c) - origin, normal = cross(u, v);
        const double surely = 1e-14 * length(u) * length(v) * (length(low - origin) + length(high - low));
        for (const Vec3& point : points)
            if (!(dot(normal, DVec<3>(point) - origin) < -surely) && orientation(a, b, c, point) > 0) return false;
    }
    return true;
}

/// Searches for the smallest of several bodies around one set of points.
class LimitedHull3Search {
public:
    LimitedHull3Search(const ConvexSurface& surface, std::size_t limit, const StretchedFrame<3>& frame)
        : inside_(surface), limit_(limit), frame_(frame) {
        OuterHull mesh(surface);
        mesh.simplify(std::max(limit, pool_corners));
        offer_simplified(mesh);
        if (limit <= few_corners) offer_inner();
        if (limit <= pool_corners) offer_polar(mesh.body());
        mesh.simplify(box_corners);
        offer_prisms(mesh.body());
    }

    std::vector<OuterBody<3>> bodies() && { return std::move(bodies_); }

private:
    /// A surface much larger than the best one isn't tightened. It stays as a fallback if rounding fails for the
    /// others.
    void offer(OuterHull mesh) {
        const double hopeless = 1 + 4.0 / static_cast<double>(limit_);
        if (mesh.count() > limit_) return;
        if (!(mesh.volume() > hopeless * min_volume_)) mesh.tighten(inside_, tightening_rounds);
        const double volume = mesh.volume();
        if (!(volume > 0)) return;
        min_volume_ = std::min(min_volume_, volume);
        bodies_.push_back(mesh.body());
        bodies_.back().size = volume * determinant(frame_.out);
    }

    void offer_simplified(OuterHull mesh) {
        mesh.simplify(limit_);
        if (mesh.count() > limit_) {
            // No edge could collapse. From other positions some may.
            mesh.tighten(inside_, 1);
            mesh.simplify(limit_);
        }
        offer(std::move(mesh));
    }

    /// The hull of the corners, scaled until it contains all points.
    void offer_grown(std::span<const DVec<3>> corners) {
        const std::optional<ConvexSurface> surface = convex_surface(corners, 0);
        if (!surface) return;
        OuterHull mesh(*surface);
        mesh.grow(inside_);
        offer(std::move(mesh));
    }

    /// Inner hulls with this number of corners, which suit round bodies.
    void offer_inner() {
        std::vector<Vec3> points;
        for (const DVec<3>& point : inside_.points()) points.push_back(to_float(point));
        for (int start = 0; start < (limit_ <= very_few_corners ? 3 : 1); ++start) {
            const Hull3 inner = inner_hull(points, limit_, to_float(inside_.highest(axis<3>(start))));
            offer_grown(std::vector<DVec<3>>(inner.points.begin(), inner.points.end()));
        }
    }

    /// The corners of half as many planes, chosen among those of a body by duality: the hull of their polar points, at
    /// 1 / offset along the normals, has faces that are such corners.
    void offer_polar(const OuterBody<3>& body) {
        constexpr double min_offset = 1e-3;
        std::vector<Vec3> polar;
        for (const Plane<3>& plane : body.planes)
            if (plane.offset > min_offset) polar.push_back(to_float(plane.normal / plane.offset));
        if (polar.size() < 4) return;
        const Hull3 chosen = inner_hull(polar, limit_ / 2 + 2, polar[0]);
        std::vector<DVec<3>> corners;
        for (std::size_t face = 0; face < chosen.normals.size(); ++face)
            if (chosen.offsets[face] > min_offset)
                corners.push_back(DVec<3>(chosen.normals[face]) / chosen.offsets[face]);
        if (corners.size() >= 4) offer_grown(corners);
    }

    /// Prisms along the axes of the minimum oriented box; pyramids if the limit is below 6. A prism over an outline
    /// with half as many corners is no larger than the box, or twice the box if that outline is a triangle. A pyramid
    /// three times as high, 1.5 times as wide at its base, has 2.25 times the volume of the prism.
    void offer_prisms(const OuterBody<3>& approximate) {
        std::vector<DVec<3>> points, corners, normals;
        for (const DVec<3>& column : frame_.out.column) normals.push_back(normalized(column));
        for (int i = 0; i < 3; ++i) normals.push_back(axis<3>(i));
        for (const Plane<3>& plane : approximate.planes)
            normals.push_back(normalized(frame_.into.transposed(plane.normal)));
        for (const DVec<3>& corner : approximate.corners) corners.push_back(frame_.out.vector(corner));
        for (const DVec<3>& point : inside_.points()) points.push_back(frame_.out.vector(point));
        const OrientedBox box = minimum_box(points, corners, normals);
        for (int up = 0; up < 3; ++up) {
            const int right = (up + 1) % 3, ahead = (up + 2) % 3;
            Loop2 outline;
            for (const std::uint32_t i : silhouette(points, box, up)) {
                const DVec<3> share = box.share(points[i]);
                outline.emplace_back(share[right], share[ahead]);
            }
            const bool pyramid = limit_ < 6;
            const std::size_t count = pyramid ? limit_ - 1 : limit_ / 2;
            if (outline.size() > count) {
                const std::vector<Loop2> found = outer_polygons(outline, count);
                outline = found.empty() ? Loop2() : found[0];
            }
            if (outline.size() < 3) continue;
            std::vector<DVec<3>> around;
            const auto add = [&](const DVec<2>& place, double height) {
                DVec<3> share;
                share[right] = place.x;
                share[ahead] = place.y;
                share[up] = height;
                around.push_back(frame_.into.vector(box.at(share)));
            };
            DVec<2> middle(0.0);
            for (const DVec<2>& corner : outline) middle += corner / static_cast<double>(outline.size());
            for (const DVec<2>& corner : outline) {
                add(pyramid ? middle + (corner - middle) * 1.5 : corner, 0);
                if (!pyramid) add(corner, 1);
            }
            if (pyramid) add(middle, 3);
            offer_grown(around);
        }
    }

    SupportSearch inside_;
    std::size_t limit_;
    const StretchedFrame<3>& frame_;
    std::vector<OuterBody<3>> bodies_;
    double min_volume_ = std::numeric_limits<double>::max();  ///< of the volumes in the frame
};

std::optional<Hull3> limited_solid(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const std::vector<Vec3> sorted = sorted_without_copies(without_interior_points(points));
    const std::optional<StretchedFrame<3>> frame = stretched_frame<3>(full.points, sorted);
    if (!frame) return std::nullopt;
    std::vector<DVec<3>> seen;
    for (const Vec3& point : sorted) seen.push_back(frame->from_world(DVec<3>(point)));
    std::vector<OuterBody<3>> bodies;
    if (const std::optional<ConvexSurface> surface = convex_surface(seen, coarse))
        bodies = LimitedHull3Search(*surface, limit, *frame).bodies();
    return smallest_rounded<3>(std::move(bodies), sorted, limit, *frame);
}

/// Coplanar points as pairs of the next floats below and above: a body as thick as rounding.
std::vector<Vec3> thickened(const Hull3& full, std::span<const Vec3> points) {
    const int up = longest_axis(DVec<3>(full.normals[0]));
    std::vector<Vec3> result;
    for (const Vec3& point : points)
        for (const float limit : {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()}) {
            result.push_back(point);
            result.back()[up] = std::nextafter(point[up], limit);
        }
    return result;
}

}  // namespace

double size_of(const Hull3& hull) {
    return hull.volume;
}

std::optional<Hull3> hull_around(std::span<const Vec3> corners, std::span<const Vec3> points,
                                 const StretchedFrame<3>& frame) {
    const std::vector<Vec3> sorted = sorted_without_copies({corners.begin(), corners.end()});
    std::vector<DVec<3>> seen;
    for (const Vec3& corner : sorted) seen.push_back(frame.from_world(DVec<3>(corner)));
    const HullGrid grid = on_grid(seen);
    const Spread spread = spread_of(grid, grid.tolerance);
    if (spread.rank < 3) return std::nullopt;
    const TriangleSurface surface = quickhull(grid.points, spread.points, 0);
    if (!holds(sorted, surface.origin, points)) return std::nullopt;

    Hull3 result;
    result.rank = 3;
    measure(result, sorted, surface.origin);
    HullFaces faces = in_order(hull_faces(grid.points, surface, grid.tolerance, grid.flatness), sorted.size());
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        Vec3& normal = faces.normals[face];
        normal = normal_of_loop(sorted, faces.loop(face));
        result.offsets.push_back(std::max(offset_above(normal, sorted), offset_above(normal, points)));
    }
    take_faces(result, sorted, std::move(faces));
    return result;
}

Result<Hull3> limited_hull(std::span<const Vec3> points, const HullOptions& options) {
    if (options.added != nullptr) *options.added = 0;
    if (options.max_vertices != 0 && options.max_vertices < 4)
        return Problem{
            ProblemCode::bad_argument,
            "max_vertices is " + std::to_string(options.max_vertices) + ", and a solid has 4 corners or more", 0};
    Result<Hull3> full = hull(points);
    if (!full || options.max_vertices == 0 || full->points.size() <= options.max_vertices) return full;
    const std::size_t limit = options.max_vertices;
    const bool flat = full->rank == 2;
    std::optional<Hull3> result = flat ? limited_flat_hull(*full, points, limit) : limited_solid(*full, points, limit);
    if (flat && !result) result = limited_solid(*full, thickened(*full, points), limit);
    if (!result) return beyond_floats();
    // The volume of the hull is rounded to its grid, and may be too large.
    const double added = flat ? result->area - full->area : result->volume - full->volume;
    if (options.added != nullptr) *options.added = std::max(0.0, added);
    return *std::move(result);
}

}  // namespace abut::detail
