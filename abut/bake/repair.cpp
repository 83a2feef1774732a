#include <abut/bake/repair.hpp>
#include <abut/bake/repair/fill_holes.hpp>
#include <abut/bake/repair/orientation.hpp>
#include <abut/math/detail/coincident.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/clean_up.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr std::uint32_t max_hole_edges = 1000;

std::optional<Problem> problem_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                  const RepairOptions& options) {
    if (!std::isfinite(options.weld_distance) || options.weld_distance < 0)
        return Problem{ProblemCode::bad_argument, "the weld distance is not a finite number of at least 0"};
    if (!(options.hole_area >= 0 && options.hole_area <= 1))
        return Problem{ProblemCode::bad_argument, "hole_area is not between 0 and 1"};
    if (options.hole_edges > max_hole_edges)
        return Problem{ProblemCode::bad_argument, "holes to fill have more than 1000 edges"};
    return problem_of_faces<3>(points, triangles, "a surface");
}

void count_points(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const Welded& surface,
                  Repairs& repairs) {
    const std::vector<std::uint32_t> first = first_coincident(points);
    std::vector<bool> is_used(points.size(), false);
    for (const glm::uvec3& t : triangles)
        for (int k = 0; k < 3; ++k) is_used[t[k]] = true;
    repairs.points_unused = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), false));
    std::vector<bool> is_place(points.size(), false);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (is_used[i]) is_place[first[i]] = true;
    const auto places = static_cast<std::size_t>(std::count(is_place.begin(), is_place.end(), true));
    repairs.points_joined = points.size() - repairs.points_unused - places;
    repairs.points_welded = places - surface.points.size();
}

}  // namespace

Result<Repaired> repair(const PointSpan<3>& given, std::span<const glm::uvec3> triangles,
                        const RepairOptions& options) {
    const PackedPoints<3> packed(given);
    const std::span<const Vec3> points = packed.points();
    if (std::optional<Problem> problem = problem_of(points, triangles, options)) return *std::move(problem);

    Repaired result;
    Repairs& repairs = result.repairs;
    Welded surface = weld(points, triangles, options.weld_distance);
    count_points(points, triangles, surface, repairs);
    repairs.triangles_lost = triangles.size() - surface.triangles.size();
    repairs.triangles_double = remove_duplicate_triangles(surface);

    const std::vector<glm::uvec3> original = surface.triangles;
    Patches patches = orient_consistently(surface);
    const FilledHoles filled = fill_holes(surface, patches, options.hole_edges, options.hole_area);
    repairs.holes_filled = filled.holes;
    repairs.triangles_added = filled.triangles;
    if (options.face_outwards) {
        const InwardSurfaces insides = orient_outwards(surface, patches);
        repairs.cavities = insides.cavities;
        repairs.rooms = insides.rooms;
    }
    for (std::size_t i = 0; i < original.size(); ++i) repairs.triangles_turned += surface.triangles[i] != original[i];
    repairs.triangles_lost += remove_slivers(surface);
    if (surface.triangles.empty()) return Problem{ProblemCode::degenerate, "no triangle has an area"};

    // Corners of removed triangles may be unused now.
    surface = weld(surface.points, surface.triangles);
    const EdgeFaults faults = edge_faults(surface.triangles);
    repairs.open_edges = faults.boundary;
    repairs.non_manifold_edges = faults.non_manifold;
    repairs.disagreeing_edges = faults.inconsistent;
    result.closed = faults.closed;
    result.points = std::move(surface.points);
    result.triangles = std::move(surface.triangles);
    return result;
}

bool changed(const Repairs& repairs) {
    return repairs.points_welded + repairs.triangles_lost + repairs.triangles_double + repairs.triangles_turned +
               repairs.holes_filled >
           0;
}

std::string described(const Repairs& repairs) {
    std::string text;
    const auto add = [&](std::size_t count, const char* one, const char* many, const char* what) {
        if (count == 0) return;
        if (!text.empty() && !text.ends_with("; ")) text += ", ";
        text += std::to_string(count) + " " + (count == 1 ? one : many) + what;
    };
    add(repairs.points_welded, "point", "points", " welded");
    add(repairs.triangles_lost, "triangle", "triangles", " without area dropped");
    add(repairs.triangles_double, "double triangle", "double triangles", " dropped");
    add(repairs.triangles_turned, "triangle", "triangles", " turned");
    add(repairs.holes_filled, "hole", "holes", " filled");
    if (text.empty()) text = "nothing to repair";
    text += "; ";
    const std::size_t before = text.size();
    add(repairs.open_edges, "open edge", "open edges", "");
    add(repairs.non_manifold_edges, "edge", "edges", " of more than two triangles");
    add(repairs.disagreeing_edges, "edge", "edges", " whose triangles can't agree");
    if (text.size() == before)
        text.resize(before - 2);
    else
        text += " left";
    return text;
}

}  // namespace abut
