#include <abut/math/detail/coincident.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/dvec.hpp>
#include <abut/recast/bake_walk_mesh.hpp>
#include <abut/recast/recast_polygons.hpp>
#include <abut/recast/stitch.hpp>
#include <abut/shape/mesh/check_triangles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

constexpr std::size_t max_triangles = std::size_t{1} << 28;
constexpr double max_cells = 1 << 26, max_cells_along = 65000, max_cells_high = 8000, max_walker_cells = 250;

Problem bad(const std::string& message) {
    return {ProblemCode::bad_argument, message, 0};
}
Problem too_large(const std::string& message) {
    return {ProblemCode::too_large, message, 0};
}

std::optional<Problem> problem_of(const WalkMeshBakeOptions& options) {
    const auto in = [](float value, float min, float max) { return value >= min && value <= max; };
    constexpr float large = 1e15f;
    if (!is_finite(options.up) || options.up == Vec3(0.0f)) return bad("up is not a finite direction other than 0");
    if (!in(options.radius, 0, large)) return bad("the radius is from 0 to 1e15");
    if (!in(options.max_step, 0, large)) return bad("the highest step is from 0 to 1e15");
    if (!in(options.height, 0, large) || !(options.height > options.max_step))
        return bad("the height is above the step height, up to 1e15");
    if (!in(options.max_slope, 0, 1.5f)) return bad("the steepest slope is from 0 to 1.5 radians");
    if (!in(options.cell, 0, large)) return bad("the cell is from 0 to 1e15");
    if (options.cell == 0 && options.radius == 0) return bad("without a radius, a cell has to be given");
    if (!in(options.min_area, 0, std::numeric_limits<float>::max())) return bad("the minimum area is 0 or above");
    for (std::size_t i = 0; i < options.starts.size(); ++i)
        if (!is_finite(options.starts[i]))
            return Problem{ProblemCode::not_finite, "start " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

/// The level in float with its lowest corner at the origin and the second axis up, and the inverse transformation.
class UprightLevel {
public:
    UprightLevel(std::span<const Vec3> given, const Vec3& up) {
        const DVec<3> y = normalized(DVec<3>(up)), x = perpendicular(y);
        axes_ = {x, y, cross(x, y)};
        DVec<3> min(std::numeric_limits<double>::infinity()), max = -min;
        for (const Vec3& point : given) {
            const DVec<3> rotated = along_axes(DVec<3>(point));
            min = glm::min(min, rotated);
            max = glm::max(max, rotated);
        }
        min_ = min;
        size = max - min;
        for (const Vec3& point : given) points.push_back(to_float(along_axes(DVec<3>(point)) - min_));
    }

    Vec3 to_level(const DVec<3>& point) const {
        const DVec<3> p = point + min_;
        return to_float(axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z);
    }

    std::vector<Vec3> points;
    DVec<3> size;

private:
    DVec<3> along_axes(const DVec<3>& p) const { return {dot(axes_[0], p), dot(axes_[1], p), dot(axes_[2], p)}; }

    std::array<DVec<3>, 3> axes_;
    DVec<3> min_;
};

/// Marks the walkable triangles: they have an area and at most the maximum slope.
std::vector<std::uint8_t> find_floor(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                     const WalkMeshBakeOptions& options) {
    const double min = sin_cos(static_cast<double>(options.max_slope)).cos * (1 - 1e-6);
    std::vector<std::uint8_t> result;
    for (const glm::uvec3& t : triangles) {
        const DVec<3> a(points[t.x]), normal = cross(DVec<3>(points[t.y]) - a, DVec<3>(points[t.z]) - a);
        const double up = options.both_sides ? std::abs(normal.y) : normal.y;
        result.push_back(up > 0 && up >= min * length(normal) ? 1 : 0);
    }
    return result;
}

Result<RecastPlan> make_plan(const DVec<3>& size, const WalkMeshBakeOptions& options) {
    const SinCos steepest = sin_cos(static_cast<double>(options.max_slope));
    const double rise = steepest.sin / steepest.cos, radius = options.radius, step = options.max_step;
    // Fine enough to distinguish a step from two cells at the maximum slope, up to rounding.
    const double chosen = std::clamp(step / (2 * rise + 0.5), radius / 6, radius / 3);
    RecastPlan plan;
    plan.cell = options.cell > 0 ? options.cell : static_cast<float>(chosen);
    plan.cell_height = 0.5f * plan.cell;
    const double cell = plan.cell, high = plan.cell_height;

    const double columns = std::ceil(size.x / cell), rows = std::ceil(size.z / cell);
    if (!(columns <= max_cells_along) || !(rows <= max_cells_along) || !(columns * rows <= max_cells))
        return too_large("the level has more than 2^26 cells, or 65,000 along a side: use cells larger than " +
                         std::to_string(cell));
    if (!(size.y / high <= max_cells_high))
        return too_large("the level is higher than 4,000 cells: use cells larger than " + std::to_string(cell));
    if (!(options.height / high <= max_walker_cells) || !(radius / cell <= max_walker_cells))
        return bad("the cell is so small that the walker is more than 250 of them wide, or 125 high");

    // Numbers within rounding of an integer are not rounded up.
    const auto rounded_up = [](double number) { return static_cast<int>(std::ceil(number - 0.01)); };
    plan.columns = std::max(1, static_cast<int>(columns));
    plan.rows = std::max(1, static_cast<int>(rows));
    plan.top = static_cast<float>(size.y + 2 * high);
    plan.height = std::max(3, rounded_up(options.height / high));
    plan.climb = std::min(plan.height - 1, std::max(rounded_up(step / high), rounded_up(rise * cell / high) + 1));
    plan.ledge = std::max(plan.climb, rounded_up(2 * rise * cell / high) + 1);
    plan.radius = rounded_up(radius / cell);
    plan.min_region = static_cast<int>(std::min(1e9, std::ceil(options.min_area / (cell * cell))));
    return plan;
}

/// Moves points to the nearest floor above or below, within `reach`.
void set_heights(std::vector<DVec<3>>& points, const Mesh& level, std::span<const std::uint8_t> floor, double reach) {
    for (DVec<3>& point : points) {
        const DVec<3> away(0, reach, 0);
        double nearest = std::numeric_limits<double>::infinity();
        each_part(level, Aabb3{to_float(point - away), to_float(point + away)},
                  [&](const Triangle3& t, std::uint32_t i) {
                      if (floor[i] == 0) return true;
                      const DVec<3> a(t.a), u = DVec<3>(t.b) - a, v = DVec<3>(t.c) - a, w = point - a;
                      const double area = u.x * v.z - u.z * v.x;
                      const double second = (w.x * v.z - w.z * v.x) / area, third = (u.x * w.z - u.z * w.x) / area;
                      constexpr double negligible = -1e-6;
                      if (!(second >= negligible) || !(third >= negligible) || !(1 - second - third >= negligible))
                          return true;
                      const double height = a.y + second * u.y + third * v.y;
                      if (std::abs(height - point.y) < std::abs(nearest - point.y)) nearest = height;
                      return true;
                  });
        if (std::abs(nearest - point.y) <= reach) point.y = nearest;
    }
}

/// Moves points onto the level. Points that would coincide are not moved, because the mesh would be connected there.
std::vector<Vec3> place_on_level(std::span<const DVec<3>> points, const Mesh& level,
                                 std::span<const std::uint8_t> floor, double reach, const UprightLevel& upright_level) {
    std::vector<DVec<3>> moved(points.begin(), points.end());
    set_heights(moved, level, floor, reach);
    std::vector<Vec3> result;
    for (const DVec<3>& point : moved) result.push_back(upright_level.to_level(point));
    const std::vector<std::uint32_t> same = first_coincident(result);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (same[i] != i)
            for (const std::size_t k : {i, std::size_t{same[i]}}) result[k] = upright_level.to_level(points[k]);
    return result;
}

/// Triangles and only the points that they use.
struct CompactSurface {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

CompactSurface with_points(std::span<const Vec3> points, std::vector<glm::uvec3> triangles) {
    std::vector<std::uint32_t> number(points.size(), no_index);
    CompactSurface result{{}, std::move(triangles)};
    for (glm::uvec3& t : result.triangles)
        for (int k = 0; k < 3; ++k) {
            if (number[t[k]] == no_index) {
                number[t[k]] = static_cast<std::uint32_t>(result.points.size());
                result.points.push_back(points[t[k]]);
            }
            t[k] = number[t[k]];
        }
    return result;
}

/// The triangles of the connected components that contain a start.
std::vector<glm::uvec3> reachable(const WalkMesh& mesh, std::span<const Vec3> starts, std::size_t& left_out) {
    std::vector<std::uint8_t> is_reachable(mesh.report().components, 0);
    for (const Vec3& start : starts) is_reachable[mesh.component(mesh.nearest(start).triangle)] = 1;
    left_out = static_cast<std::size_t>(std::count(is_reachable.begin(), is_reachable.end(), std::uint8_t{0}));
    std::vector<glm::uvec3> result;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        if (mesh.is_walkable(i) && is_reachable[mesh.component(i)] != 0) result.push_back(mesh.triangles()[i]);
    return result;
}

}  // namespace

Result<WalkMesh> bake_walk_mesh(const PointSpan<3>& given, std::span<const glm::uvec3> triangles,
                                const WalkMeshBakeOptions& options) {
    const PackedPoints<3> packed(given);
    const std::span<const Vec3> points = packed.points();
    if (std::optional<Problem> problem = problem_of(options)) return *std::move(problem);
    if (std::optional<Problem> problem = problem_of_faces<3>(points, triangles, "a level")) return *std::move(problem);
    if (triangles.size() >= max_triangles || points.size() >= max_triangles)
        return too_large("a level has fewer than 2^28 triangles and points");
    const auto report = [&](double done) { return !options.progress || (*options.progress)(done); };

    const UprightLevel upright_level(points, options.up);
    const Result<RecastPlan> plan = make_plan(upright_level.size, options);
    if (!plan) return plan.problem();
    const std::vector<std::uint8_t> floor = find_floor(upright_level.points, triangles, options);
    if (std::find(floor.begin(), floor.end(), std::uint8_t{1}) == floor.end())
        return Problem{ProblemCode::empty_input, "no part of the level is walkable: no triangle is flat enough", 0};

    const Result<RecastPolygons> found =
        recast_polygons(upright_level.points, triangles, floor, *plan, [&](double done) { return report(0.9 * done); });
    if (!found) return found.problem();
    if (!report(0.9)) return cancelled();
    const double high = plan->cell_height;
    Stitched surface =
        stitch(found->corners, found->polygons, {.tolerance = 0.05 * plan->cell, .step = (plan->climb + 1) * high});
    const Result<Mesh> level = Mesh::build(upright_level.points, triangles);
    if (!level) return level.problem();
    const std::vector<Vec3> placed =
        place_on_level(surface.points, *level, floor, (plan->climb + 1) * high, upright_level);
    if (!report(0.97)) return cancelled();
    CompactSurface walked = with_points(placed, std::move(surface.triangles));
    Result<WalkMesh> result = WalkMesh::build(walked.points, walked.triangles);
    std::size_t left_out = 0;
    if (result && !options.starts.empty()) {
        walked = with_points(walked.points, reachable(*result, options.starts, left_out));
        result = WalkMesh::build(walked.points, walked.triangles);
    }
    if (options.report != nullptr)
        *options.report = {plan->cell,
                           plan->cell_height,
                           static_cast<std::size_t>(plan->columns) * static_cast<std::size_t>(plan->rows),
                           found->polygons.size(),
                           found->warnings + surface.repaired,
                           left_out};
    if (!report(1)) return cancelled();
    return result;
}

Result<WalkMesh> bake_walk_mesh(const Mesh& level, const WalkMeshBakeOptions& options) {
    return bake_walk_mesh(level.points(), level.triangles(), options);
}

}  // namespace abut
