// Hulls with a vertex limit in 3D.

#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/interior_filter.hpp>
#include <abut/convex/hull/limited/convex_surface.hpp>
#include <abut/convex/hull/limited/hull_in_frame.hpp>
#include <abut/convex/hull/limited/inner_hull.hpp>
#include <abut/convex/hull/limited/limited_flat_hull.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/hull/limited/minimum_box.hpp>
#include <abut/convex/hull/limited/outer_hull.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace abut::detail {
namespace {

/// The tolerance of the surface, for a body of about size 1. The planes move outwards to all points at the end.
constexpr double coarse = 0x1p-17;
constexpr std::size_t few_corners = 32, very_few_corners = 16, box_corners = 32, pool_corners = 64;
constexpr int tightening_rounds = 8, max_margins3 = 14;
constexpr double first_margin3 = 0x1p-24;

/// Searches for the smallest of several surfaces around one body.
class LimitedHull3Search {
public:
    LimitedHull3Search(std::vector<Vec3> points, std::size_t limit, const StretchedFrame<3>& frame)
        : points_(std::move(points)), limit_(limit), frame_(frame) {
        for (const Vec3& point : points_) seen_.push_back(frame.from_world(DVec<3>(point)));
    }

    std::optional<Hull3> run() {
        const std::optional<ConvexSurface> surface = convex_surface(seen_, coarse);
        if (surface) {
            const VertexGraph inside(*surface);
            OuterHull mesh(*surface);
            mesh.simplify(std::max(limit_, pool_corners));
            OuterHull simple = mesh;
            simple.simplify(limit_);
            offer(std::move(simple), inside);
            if (limit_ <= few_corners) offer_inner(inside);
            if (limit_ <= few_corners) offer_polar(mesh, inside);
            offer_boxes(std::move(mesh), inside);
        }
        return smallest_rounded();
    }

private:
    /// A surface much larger than the best one isn't tightened. It stays as a fallback if rounding fails for the
    /// others.
    void offer(OuterHull mesh, const VertexGraph& inside) {
        constexpr double hopeless = 1.4;
        if (mesh.count() > limit_) return;
        double volume = mesh.volume();
        if (!(volume > hopeless * min_volume_)) {
            mesh.tighten(inside, tightening_rounds);
            volume = mesh.volume();
        }
        if (!(volume > 0)) return;
        min_volume_ = std::min(min_volume_, volume);
        meshes_.emplace_back(volume * determinant(frame_.out), std::move(mesh));
    }

    /// The hull of the corners, scaled until it contains all points.
    void offer_grown(std::span<const DVec<3>> corners, const VertexGraph& inside) {
        const std::optional<ConvexSurface> surface = convex_surface(corners, 0);
        if (!surface) return;
        OuterHull mesh(*surface);
        DVec<3> middle(0.0);
        for (const DVec<3>& corner : surface->points) middle += corner;
        mesh.grow(middle / static_cast<double>(surface->points.size()), inside);
        offer(std::move(mesh), inside);
    }

    /// The corners of half as many planes, chosen among those of the mesh by duality: the hull of their polar points,
    /// at 1 / offset along the normals, has faces that are such corners.
    void offer_polar(const OuterHull& mesh, const VertexGraph& inside) {
        constexpr double min_offset = 1e-3;
        std::vector<Vec3> polar;
        for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
            if (mesh.has_triangle(triangle) && mesh.plane(triangle).offset > min_offset)
                polar.push_back(to_float(mesh.plane(triangle).normal / mesh.plane(triangle).offset));
        if (polar.size() < 4) return;
        const Hull3 chosen = inner_hull(polar, limit_ / 2 + 2, polar[0]);
        std::vector<DVec<3>> corners;
        for (std::size_t face = 0; face < chosen.normals.size(); ++face)
            if (chosen.offsets[face] > min_offset)
                corners.push_back(DVec<3>(chosen.normals[face]) / chosen.offsets[face]);
        if (corners.size() >= 4) offer_grown(corners, inside);
    }

    /// An inner hull with this number of corners, which suits round bodies.
    void offer_inner(const VertexGraph& inside) {
        std::vector<Vec3> points;
        for (const DVec<3>& point : inside.points()) points.push_back(to_float(point));
        const int starts = limit_ <= very_few_corners ? 3 : 1;
        for (int start = 0; start < starts; ++start) {
            std::vector<DVec<3>> corners;
            const Vec3& first = points[inside.highest(axis<3>(start), 0)];
            for (const Vec3& corner : inner_hull(points, limit_, first).points) corners.emplace_back(corner);
            offer_grown(corners, inside);
        }
    }

    /// The minimum oriented box, or its substitute below 8 corners; and prisms along its axes.
    void offer_boxes(OuterHull mesh, const VertexGraph& inside) {
        mesh.simplify(box_corners);
        std::vector<DVec<3>> corners, normals;
        for (const DVec<3>& column : frame_.out.column) normals.push_back(normalized(column));
        for (int i = 0; i < 3; ++i) normals.push_back(axis<3>(i));
        for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
            if (mesh.has_triangle(triangle))
                normals.push_back(normalized(frame_.into.transposed(mesh.plane(triangle).normal)));
        std::vector<DVec<3>> approximate;
        for (std::uint32_t point = 0; point < mesh.points().size(); ++point)
            if (mesh.has_point(point)) approximate.push_back(frame_.out.vector(mesh.points()[point]));
        for (const DVec<3>& point : inside.points()) corners.push_back(frame_.out.vector(point));
        const OrientedBox box = minimum_box(corners, approximate, normals);
        const auto place = [&](const DVec<3>& unit) {
            DVec<3> result(0.0);
            for (int i = 0; i < 3; ++i)
                result += box.axes[static_cast<std::size_t>(i)] * (box.low[i] + (box.high[i] - box.low[i]) * unit[i]);
            return frame_.into.vector(result);
        };
        std::vector<DVec<3>> around;
        for (const DVec<3>& unit : around_unit_cube<3>(limit_)) around.push_back(place(unit));
        offer_grown(around, inside);
        if (limit_ < 6) return;
        for (std::size_t up = 0; up < 3; ++up) {
            const std::size_t right = (up + 1) % 3, ahead = (up + 2) % 3;
            std::vector<DVec<2>> loop;
            for (const std::uint32_t i : silhouette(corners, box.axes[right], box.axes[ahead]))
                loop.push_back(scaled(box, corners[i], right, ahead));
            if (loop.size() < 3) continue;
            if (loop.size() > limit_ / 2) loop = outer_polygon(loop, limit_ / 2);
            around.clear();
            for (const DVec<2>& corner : loop)
                for (const double height : {0.0, 1.0}) {
                    DVec<3> unit;
                    unit[static_cast<int>(right)] = corner.x;
                    unit[static_cast<int>(ahead)] = corner.y;
                    unit[static_cast<int>(up)] = height;
                    around.push_back(place(unit));
                }
            offer_grown(around, inside);
        }
    }

    static DVec<2> scaled(const OrientedBox& box, const DVec<3>& p, std::size_t right, std::size_t ahead) {
        const auto share = [&](std::size_t axis) {
            const int i = static_cast<int>(axis);
            return (dot(box.axes[axis], p) - box.low[i]) / (box.high[i] - box.low[i]);
        };
        return {share(right), share(ahead)};
    }

    /// The corners of a mesh in floats: outside of the planes of their triangles by `margin`, after the planes were
    /// moved outwards to all points. Nothing if one leaves the range of floats.
    std::optional<std::vector<Vec3>> rounded_corners(const OuterHull& mesh, double margin) const {
        std::vector<Plane<3>> planes(mesh.triangle_count());
        for (std::uint32_t triangle = 0; triangle < planes.size(); ++triangle) {
            if (!mesh.has_triangle(triangle)) continue;
            planes[triangle] = mesh.plane(triangle);
            for (const DVec<3>& point : seen_)
                planes[triangle].offset = std::max(planes[triangle].offset, dot(planes[triangle].normal, point));
            planes[triangle].offset += margin;
        }
        std::vector<Vec3> result;
        std::vector<Plane<3>> around;
        for (std::uint32_t point = 0; point < mesh.points().size(); ++point) {
            if (!mesh.has_point(point)) continue;
            around.clear();
            mesh.each_triangle_around(point, [&](std::uint32_t triangle) { around.push_back(planes[triangle]); });
            const std::optional<Vec3> corner = rounded_corner<3>(mesh.points()[point], around, frame_);
            if (!corner) return std::nullopt;
            result.push_back(*corner);
        }
        return result;
    }

    std::optional<Hull3> rounded(const OuterHull& mesh) const {
        double margin = 0;
        for (int i = 0; i < max_margins3; ++i) {
            const std::optional<std::vector<Vec3>> corners = rounded_corners(mesh, margin);
            if (!corners) return std::nullopt;
            if (std::optional<Hull3> result = hull_in_frame(*corners, points_, frame_)) return result;
            margin = margin == 0 ? first_margin3 : 4 * margin;
        }
        return std::nullopt;
    }

    /// The bounding box, whose corners are floats, or its substitute below 8 corners.
    std::optional<Hull3> bounding_box() const {
        for (const double growth : {0x1p-20, 0x1p-10, 1.0}) {
            const std::vector<Vec3> corners = corners_of_box<3>(points_, limit_, growth);
            if (corners.empty()) return std::nullopt;
            if (std::optional<Hull3> result = hull_in_frame(corners, points_, frame_)) return result;
        }
        return std::nullopt;
    }

    /// Rounding only adds volume: a mesh no smaller than the best result is skipped.
    std::optional<Hull3> smallest_rounded() {
        std::stable_sort(meshes_.begin(), meshes_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::optional<Hull3> best = bounding_box();
        for (const auto& [volume, mesh] : meshes_) {
            if (best && best->volume <= volume) break;
            std::optional<Hull3> next = rounded(mesh);
            if (next && (!best || next->volume < best->volume)) best = std::move(next);
        }
        return best;
    }

    std::vector<Vec3> points_;
    std::size_t limit_;
    const StretchedFrame<3>& frame_;
    std::vector<DVec<3>> seen_;                               ///< the points in the frame
    std::vector<std::pair<double, OuterHull>> meshes_;        ///< with their volumes in the world
    double min_volume_ = std::numeric_limits<double>::max();  ///< of the volumes in the frame
};

std::optional<Hull3> limited_solid(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    std::vector<Vec3> sorted = without_interior_points(points);
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    const std::optional<StretchedFrame<3>> frame = stretched_frame(full.points, sorted);
    if (!frame) return std::nullopt;
    return LimitedHull3Search(std::move(sorted), limit, *frame).run();
}

/// Coplanar points as pairs of the next floats below and above: a body as thick as rounding.
std::vector<Vec3> thickened(const Hull3& full, std::span<const Vec3> points) {
    const DVec<3> normal(full.normals[0]), steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    std::vector<Vec3> result;
    for (const Vec3& point : points)
        for (const float limit : {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()}) {
            result.push_back(point);
            result.back()[up] = std::nextafter(point[up], limit);
        }
    return result;
}

}  // namespace

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
