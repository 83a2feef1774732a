#include <abut/math/coincident.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/sin_cos.hpp>
#include <abut/recast/bake_walk_mesh.hpp>
#include <abut/recast/recast_polygons.hpp>
#include <abut/recast/stitch.hpp>
#include <abut/shape/check_triangles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 28;
constexpr double most_columns = 1 << 26, most_along = 65000, most_high = 8000, most_of_walker = 250;

Problem bad(const std::string& message) {
    return {ProblemCode::bad_argument, message, 0};
}
Problem too_large(const std::string& message) {
    return {ProblemCode::too_large, message, 0};
}

std::optional<Problem> problem_of(const WalkMeshBakeOptions& options) {
    const auto in = [](float value, float least, float most) { return value >= least && value <= most; };
    constexpr float large = 1e15f;
    if (!is_finite(options.up) || options.up == Vec3(0.0f)) return bad("up is a direction: finite, and not 0");
    if (!in(options.radius, 0, large)) return bad("the radius is from 0 to 1e15");
    if (!in(options.max_step, 0, large)) return bad("the highest step is from 0 to 1e15");
    if (!in(options.height, 0, large) || !(options.height > options.max_step))
        return bad("the height is above the step height, up to 1e15");
    if (!in(options.max_slope, 0, 1.5f)) return bad("the steepest slope is from 0 to 1.5 radians");
    if (!in(options.cell, 0, large)) return bad("the cell is from 0 to 1e15");
    if (options.cell == 0 && options.radius == 0) return bad("without a radius, a cell has to be given");
    if (!in(options.least_area, 0, std::numeric_limits<float>::max())) return bad("the least area is 0 or above");
    for (std::size_t i = 0; i < options.starts.size(); ++i)
        if (!is_finite(options.starts[i]))
            return Problem{ProblemCode::not_finite, "start " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

/// The level with its lowest corner at the origin and the second axis up, in floats; and the way back.
class Upright {
public:
    Upright(std::span<const Vec3> given, const Vec3& up) {
        const DVec<3> y = normalized(DVec<3>(up)), x = perpendicular(y);
        axes_ = {x, y, cross(x, y)};
        DVec<3> least(std::numeric_limits<double>::infinity()), most = -least;
        for (const Vec3& point : given) {
            const DVec<3> turned = along_axes(DVec<3>(point));
            least = glm::min(least, turned);
            most = glm::max(most, turned);
        }
        least_ = least;
        size = most - least;
        for (const Vec3& point : given) points.push_back(to_float(along_axes(DVec<3>(point)) - least_));
    }

    Vec3 back(const DVec<3>& point) const {
        const DVec<3> p = point + least_;
        return to_float(axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z);
    }

    std::vector<Vec3> points;
    DVec<3> size;

private:
    DVec<3> along_axes(const DVec<3>& p) const { return {dot(axes_[0], p), dot(axes_[1], p), dot(axes_[2], p)}; }

    std::array<DVec<3>, 3> axes_;
    DVec<3> least_;
};

/// Which triangles are floor: that have an area, and rise no more than the steepest.
std::vector<std::uint8_t> find_floor(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                     const WalkMeshBakeOptions& options) {
    const double least = sin_cos(static_cast<double>(options.max_slope)).cos * (1 - 1e-6);
    std::vector<std::uint8_t> result;
    for (const glm::uvec3& t : triangles) {
        const DVec<3> a(points[t.x]), normal = cross(DVec<3>(points[t.y]) - a, DVec<3>(points[t.z]) - a);
        const double up = options.both_sides ? std::abs(normal.y) : normal.y;
        result.push_back(up > 0 && up >= least * length(normal) ? 1 : 0);
    }
    return result;
}

Result<RecastPlan> make_plan(const DVec<3>& size, const WalkMeshBakeOptions& options) {
    const SinCos steepest = sin_cos(static_cast<double>(options.max_slope));
    const double rise = steepest.sin / steepest.cos, radius = options.radius, step = options.max_step;
    // So fine that a step is told from two cells of the steepest slope, but for its rounding.
    const double chosen = std::clamp(step / (2 * rise + 0.5), radius / 6, radius / 3);
    RecastPlan plan;
    plan.cell = options.cell > 0 ? options.cell : static_cast<float>(chosen);
    plan.cell_height = 0.5f * plan.cell;
    const double cell = plan.cell, high = plan.cell_height;

    const double columns = std::ceil(size.x / cell), rows = std::ceil(size.z / cell);
    if (!(columns <= most_along) || !(rows <= most_along) || !(columns * rows <= most_columns))
        return too_large("the level has more than 2^26 cells, or 65,000 along a side: take larger ones than " +
                         std::to_string(cell));
    if (!(size.y / high <= most_high))
        return too_large("the level is higher than 8,000 halves of a cell: take larger ones than " +
                         std::to_string(cell));
    if (!(options.height / high <= most_of_walker) || !(radius / cell <= most_of_walker))
        return bad("the cell is so small that the walker is more than 250 of them wide, or 125 high");

    // What is a whole number of cells but for its rounding counts as such.
    const auto whole = [](double number) { return static_cast<int>(std::ceil(number - 0.01)); };
    plan.columns = std::max(1, static_cast<int>(columns));
    plan.rows = std::max(1, static_cast<int>(rows));
    plan.top = static_cast<float>(size.y + 2 * high);
    plan.height = std::max(3, whole(options.height / high));
    plan.climb = std::min(plan.height - 1, std::max(whole(step / high), whole(rise * cell / high) + 1));
    plan.ledge = std::max(plan.climb, whole(2 * rise * cell / high) + 1);
    plan.radius = whole(radius / cell);
    plan.least_region = static_cast<int>(std::min(1e9, std::ceil(options.least_area / (cell * cell))));
    return plan;
}

/// To the floor that is nearest above or below, where there is one within reach.
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
                      constexpr double little = -1e-6;
                      if (!(second >= little) || !(third >= little) || !(1 - second - third >= little)) return true;
                      const double height = a.y + second * u.y + third * v.y;
                      if (std::abs(height - point.y) < std::abs(nearest - point.y)) nearest = height;
                      return true;
                  });
        if (std::abs(nearest - point.y) <= reach) point.y = nearest;
    }
}

/// On the level, but for those that would come to be where another one is: the mesh would be joined there.
std::vector<Vec3> place(std::span<const DVec<3>> points, const Mesh& level, std::span<const std::uint8_t> floor,
                        double reach, const Upright& upright) {
    std::vector<DVec<3>> moved(points.begin(), points.end());
    set_heights(moved, level, floor, reach);
    std::vector<Vec3> result;
    for (const DVec<3>& point : moved) result.push_back(upright.back(point));
    const std::vector<std::uint32_t> same = first_coincident(result);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (same[i] != i)
            for (const std::size_t k : {i, std::size_t{same[i]}}) result[k] = upright.back(points[k]);
    return result;
}

/// Triangles of the points that they need.
struct Surface {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

Surface with_points(std::span<const Vec3> points, std::vector<glm::uvec3> triangles) {
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> number(points.size(), none);
    Surface result{{}, std::move(triangles)};
    for (glm::uvec3& t : result.triangles)
        for (int k = 0; k < 3; ++k) {
            if (number[t[k]] == none) {
                number[t[k]] = static_cast<std::uint32_t>(result.points.size());
                result.points.push_back(points[t[k]]);
            }
            t[k] = number[t[k]];
        }
    return result;
}

/// The islands that a start is on.
std::vector<glm::uvec3> reachable(const WalkMesh& mesh, std::span<const Vec3> starts, std::size_t& left_out) {
    std::vector<std::uint8_t> kept(mesh.report().islands, 0);
    for (const Vec3& start : starts) kept[mesh.island(mesh.nearest(start).triangle)] = 1;
    left_out = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), std::uint8_t{0}));
    std::vector<glm::uvec3> result;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        if (mesh.is_walkable(i) && kept[mesh.island(i)] != 0) result.push_back(mesh.triangles()[i]);
    return result;
}

Problem cancelled() {
    return {ProblemCode::cancelled, "cancelled", 0};
}

}  // namespace

Result<WalkMesh> bake_walk_mesh(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                const WalkMeshBakeOptions& options) {
    if (std::optional<Problem> problem = problem_of(options)) return *std::move(problem);
    if (std::optional<Problem> problem = problem_of_triangles(points, triangles, "a level")) return *std::move(problem);
    if (triangles.size() >= most_triangles || points.size() >= most_triangles)
        return too_large("a level has fewer than 2^28 triangles and points");
    const auto tell = [&](double done) { return !options.progress || (*options.progress)(done); };

    const Upright upright(points, options.up);
    const Result<RecastPlan> plan = make_plan(upright.size, options);
    if (!plan) return plan.problem();
    const std::vector<std::uint8_t> floor = find_floor(upright.points, triangles, options);
    if (std::find(floor.begin(), floor.end(), std::uint8_t{1}) == floor.end())
        return Problem{ProblemCode::empty_input, "nothing of the level can be walked on: no triangle is flat enough",
                       0};

    const Result<RecastPolygons> found =
        recast_polygons(upright.points, triangles, floor, *plan, [&](double done) { return tell(0.9 * done); });
    if (!found) return found.problem();
    if (!tell(0.9)) return cancelled();
    const double high = plan->cell_height;
    Stitched surface =
        stitch(found->corners, found->polygons, {.near = 0.05 * plan->cell, .step = (plan->climb + 1) * high});
    const Result<Mesh> level = Mesh::build(upright.points, triangles);
    if (!level) return level.problem();
    const std::vector<Vec3> placed = place(surface.points, *level, floor, (plan->climb + 1) * high, upright);
    if (!tell(0.97)) return cancelled();
    Surface walked = with_points(placed, std::move(surface.triangles));
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
                           found->warnings + surface.mended,
                           left_out};
    if (!tell(1)) return cancelled();
    return result;
}

Result<WalkMesh> bake_walk_mesh(const Mesh& level, const WalkMeshBakeOptions& options) {
    return bake_walk_mesh(level.points(), level.triangles(), options);
}

}  // namespace abut
