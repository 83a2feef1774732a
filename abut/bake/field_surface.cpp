#include <abut/bake/field_surface.hpp>
#include <abut/bake/wind.hpp>
#include <abut/math/predicates.hpp>
#include <abut/shape/half_edges.hpp>

#include <algorithm>
#include <utility>

namespace abut {
namespace {

/// An edge that the surface runs along more often this way than the other, once for each time more.
struct Rim {
    std::uint32_t from = 0, to = 0;
};

struct Rims {
    std::vector<Rim> rims;  ///< by where they come from, then by where they lead to
    std::size_t edges = 0;
};

Rims rims_of(std::span<const glm::uvec3> triangles) {
    Rims result;
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        std::ptrdiff_t upwards = 0;
        for (const HalfEdge& side : edge) upwards += side.upwards ? 1 : -1;
        const Rim rim = upwards > 0 ? Rim{edge[0].low, edge[0].high} : Rim{edge[0].high, edge[0].low};
        result.rims.insert(result.rims.end(), static_cast<std::size_t>(std::abs(upwards)), rim);
        result.edges += upwards != 0;
    });
    std::sort(result.rims.begin(), result.rims.end(),
              [](const Rim& a, const Rim& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
    return result;
}

/// Triangles between a loop and the chord from its first corner to its last, against the way that the loop goes; of
/// halves of it, and halves of these, so that most of them are small and close to their part of it.
void cap_loop(std::span<const std::uint32_t> loop, std::vector<glm::uvec3>& cap) {
    std::vector<std::pair<std::size_t, std::size_t>> waiting{{0, loop.size() - 1}};
    while (!waiting.empty()) {
        const auto [first, last] = waiting.back();
        waiting.pop_back();
        if (last - first < 2) continue;
        const std::size_t middle = first + (last - first) / 2;
        cap.emplace_back(loop[last], loop[middle], loop[first]);
        waiting.emplace_back(middle, last);
        waiting.emplace_back(first, middle);
    }
}

/// As many rims lead to a point as away from it: whoever follows them comes back. Where the way comes to a point for
/// the second time, a loop is closed.
std::vector<glm::uvec3> cap_of(const std::vector<Rim>& rims, std::size_t points) {
    constexpr std::uint32_t none = no_side;
    std::vector<glm::uvec3> result;
    std::vector<std::uint32_t> next(points, none), place(points, none), way;
    for (std::size_t i = rims.size(); i-- > 0;) next[rims[i].from] = static_cast<std::uint32_t>(i);
    const auto has_next = [&](std::uint32_t point) {
        return next[point] < rims.size() && rims[next[point]].from == point;
    };
    for (const Rim& start : rims) {
        if (!has_next(start.from)) continue;
        way.assign(1, start.from);
        place[start.from] = 0;
        while (has_next(way.back())) {
            const std::uint32_t to = rims[next[way.back()]++].to;
            if (place[to] == none) {
                place[to] = static_cast<std::uint32_t>(way.size());
                way.push_back(to);
                continue;
            }
            const std::size_t first = place[to];
            cap_loop(std::span(way).subspan(first), result);
            for (std::size_t i = first + 1; i < way.size(); ++i) place[way[i]] = none;
            way.resize(first + 1);
        }
        place[way.back()] = none;
    }
    return result;
}

}  // namespace

Result<FieldSurface> field_surface(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite(points[i])) return Problem{ProblemCode::not_finite, "a point of the mesh is not finite", i};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (triangles[i][k] >= points.size())
                return Problem{ProblemCode::index_out_of_range, "a triangle has a point that there is not", i};

    FieldSurface result;
    result.mesh = weld(points, triangles);
    Rims rims = rims_of(result.mesh.triangles);
    if (rims.edges > 0) {
        const std::vector<glm::uvec3> as_they_came = result.mesh.triangles;
        wind_alike(result.mesh);
        for (std::size_t i = 0; i < as_they_came.size(); ++i)
            result.rewound += result.mesh.triangles[i] != as_they_came[i];
        if (result.rewound > 0) rims = rims_of(result.mesh.triangles);
    }
    result.gaps = rims.edges;
    result.cap = cap_of(rims.rims, result.mesh.points.size());

    const std::vector<Vec3>& corners = result.mesh.points;
    for (std::uint32_t i = 0; i < result.mesh.triangles.size(); ++i) {
        const glm::uvec3& t = result.mesh.triangles[i];
        if (on_line(corners[t.x], corners[t.y], corners[t.z])) continue;
        result.solid.push_back(i);
        for (int k = 0; k < 3; ++k) result.box = merged(result.box, Aabb3{corners[t[k]], corners[t[k]]});
    }
    if (result.solid.empty()) return Problem{ProblemCode::empty_input, "no triangle of the mesh has an area", 0};
    return result;
}

}  // namespace abut
