#include "tool/decompose/decompose_report.hpp"
#include "tool/shared/picture.hpp"
#include <abut/math/dvec.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

namespace abut::tool {

using namespace detail;

namespace {

constexpr Vec3 towards_eye{1, 0.9f, 1.4f};

std::vector<Vec3> corners_of(const Polyhedron& part, std::uint32_t face) {
    std::vector<Vec3> corners;
    for (const std::uint32_t corner : part.facets().loop(face)) corners.push_back(part.points()[corner]);
    return corners;
}

Color shaded(Color color, const Vec3& normal) {
    const DVec<3> light = normalized(DVec<3>(0.35, 1, 0.6));
    const double bright = 0.62 + 0.38 * std::max(0.0, dot(DVec<3>(normal), light));
    const auto scaled = [&](std::uint8_t channel) { return static_cast<std::uint8_t>(channel * bright); };
    return {scaled(color.red), scaled(color.green), scaled(color.blue)};
}

/// A part with its projection and its depth.
struct SeenPart {
    Aabb2 place = Aabb2::empty();
    double nearness = 0;
    std::vector<std::uint32_t> in_front;  ///< parts that may occlude it
    std::size_t behind = 0;               ///< count of parts behind it that are not drawn yet
};

/// True if one part may occlude the other: a separating plane has the eye on one side.
void find_who_hides_whom(const std::vector<PartReport>& parts, std::vector<SeenPart>& seen_parts) {
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (std::uint32_t j = i + 1; j < parts.size(); ++j) {
            if (!overlaps(seen_parts[i].place, seen_parts[j].place)) continue;
            const Vec3 normal = closest(parts[i].part, parts[j].part).normal;
            const double towards = dot(DVec<3>(normal), DVec<3>(towards_eye));
            SeenPart &hidden = seen_parts[towards > 0 ? i : j], &hiding = seen_parts[towards > 0 ? j : i];
            hidden.in_front.push_back(towards > 0 ? j : i);
            ++hiding.behind;
        }
}

/// Painter's algorithm: parts behind come first. Cyclic occlusion is broken at the farthest part.
std::vector<std::uint32_t> drawing_order(const std::vector<PartReport>& parts, const Projected& view) {
    // Above this count the quadratic search for occlusions is skipped, and parts are sorted by depth.
    constexpr std::size_t most_compared = 1000;
    std::vector<SeenPart> seen_parts(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        seen_parts[i].nearness = dot(DVec<3>(parts[i].part.centroid()), DVec<3>(towards_eye));
        for (const Vec3& corner : parts[i].part.points())
            seen_parts[i].place = merged(seen_parts[i].place, Aabb2{view(corner), view(corner)});
    }
    if (parts.size() <= most_compared) find_who_hides_whom(parts, seen_parts);
    std::set<std::tuple<std::size_t, double, std::uint32_t>> waiting;
    const auto key = [&](std::uint32_t i) { return std::tuple(seen_parts[i].behind, seen_parts[i].nearness, i); };
    for (std::uint32_t i = 0; i < parts.size(); ++i) waiting.insert(key(i));
    std::vector<std::uint32_t> order;
    while (!waiting.empty()) {
        const std::uint32_t next = std::get<2>(*waiting.begin());
        waiting.erase(waiting.begin());
        order.push_back(next);
        for (const std::uint32_t other : seen_parts[next].in_front)
            if (waiting.erase(key(other)) > 0) {
                --seen_parts[other].behind;
                waiting.insert(key(other));
            }
    }
    return order;
}

}  // namespace

std::string picture(const std::vector<PartReport>& parts) {
    Aabb3 box = Aabb3::empty();
    for (const PartReport& part : parts)
        for (const Vec3& corner : part.part.points()) box = merged(box, Aabb3{corner, corner});
    const Aabb2 plane = projected_bounds(box, towards_eye);
    constexpr float margin = 0.04f;
    SvgCanvas canvas =
        make_canvas(grown(plane, margin * std::max(plane.max.x - plane.min.x, plane.max.y - plane.min.y)));
    Projected view(canvas, box, towards_eye, {0, 1, 0});
    for (const std::uint32_t i : drawing_order(parts, view)) {
        const Facets& facets = parts[i].part.facets();
        for (std::uint32_t face = 0; face < facets.normals.size(); ++face) {
            if (dot(DVec<3>(facets.normals[face]), DVec<3>(towards_eye)) <= 0) continue;
            const Color color = shaded(color_of_part(i), facets.normals[face]);
            view.polygon(corners_of(parts[i].part, face), Style{{30, 41, 59, 160}, 0.8f, color});
        }
    }
    return canvas.document();
}

}  // namespace abut::tool
