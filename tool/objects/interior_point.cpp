#include "tool/objects/interior_point.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// Offset of a ray's origin below the surface, relative to the facet's size, so that the ray doesn't hit its own facet.
constexpr float ray_offset = 1e-3f;

glm::vec3 area_vector(const Triangle3& t) {
    return glm::cross(t.b - t.a, t.c - t.a);
}

std::uint32_t largest_triangle(const Mesh& mesh) {
    std::uint32_t largest = 0;
    float largest_area = -1;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        const float area = glm::length(area_vector(mesh.triangle(i)));
        if (area > largest_area) {
            largest_area = area;
            largest = i;
        }
    }
    return largest;
}

// The midpoint between the centre of the largest triangle and the opposite surface.
std::optional<Vec3> middle_of(const Mesh& mesh) {
    const Triangle3 t = mesh.triangle(largest_triangle(mesh));
    const Vec3 area = area_vector(t);
    const float size = std::sqrt(glm::length(area));
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    const Vec3 inwards = -glm::normalize(area);
    const Vec3 start = (t.a + t.b + t.c) / 3.0f + inwards * (ray_offset * size);
    const Ray<3> ray{start, inwards, std::numeric_limits<float>::infinity()};
    const std::optional<Hit<3>> opposite = raycast(ray, mesh);
    if (!opposite) return std::nullopt;
    const Vec3 middle = start + inwards * (0.5f * opposite->distance);
    return contains(mesh, middle) ? std::optional(middle) : std::nullopt;
}

// The longest segment of a shape's lines.
struct Longest {
    Segment2 segment{};
    float length = -1;

    void include(const Chain& chain) {
        for (std::uint32_t i = 0; i < chain.size(); ++i) {
            const Segment2 s = chain.segment(i);
            const float other = glm::length(s.b - s.a);
            if (other > length) *this = {s, other};
        }
    }
};

// The midpoint between the centre of the longest segment and the opposite line, on the interior side.
template <class Lines>
std::optional<Vec2> middle_of(const Lines& lines, const Longest& longest) {
    if (!(longest.length > 0) || !std::isfinite(longest.length)) return std::nullopt;
    const Segment2& s = longest.segment;
    const Vec2 along = (s.b - s.a) / longest.length;
    for (const Vec2& inwards : {Vec2(-along.y, along.x), Vec2(along.y, -along.x)}) {
        const Vec2 start = s.a + 0.5f * (s.b - s.a) + inwards * (ray_offset * longest.length);
        const Ray<2> ray{start, inwards, std::numeric_limits<float>::infinity()};
        const std::optional<Hit<2>> opposite = raycast(ray, lines);
        if (!opposite) continue;
        const Vec2 middle = start + inwards * (0.5f * opposite->distance);
        if (contains(lines, middle)) return middle;
    }
    return std::nullopt;
}

Longest longest_of(const Chain& chain) {
    Longest result;
    result.include(chain);
    return result;
}
Longest longest_of(const Outlines& outlines) {
    Longest result;
    for (const Chain& chain : outlines.chains) result.include(chain);
    return result;
}

// An interior point if the lines enclose an area, else a point on them.
template <class Lines>
InteriorPoint<2> inside_lines(const Lines& lines, bool filled) {
    const Longest longest = longest_of(lines);
    if (filled)
        if (const std::optional<Vec2> middle = middle_of(lines, longest))
            return {*middle, closest(lines, *middle).distance};
    return {longest.segment.a, 0};
}

Vec2 middle_of(const TileMap& map) {
    std::uint32_t first = 0;
    while (first + 1 < map.size() && map.tile(first) == Tile::empty) ++first;
    return center(bounds(View<2>(map.part(first))));
}

// The given point if it is inside the shape, else the closest point of the shape.
template <class S>
InteriorPoint<2> near(const S& shape, const Vec2& place) {
    const Closest<2> nearest = closest(shape, place);
    return nearest.distance <= 0 ? InteriorPoint<2>{place, -nearest.distance} : InteriorPoint<2>{nearest.on_a, 0};
}

struct FindInteriorPoint {
    bool filled;

    InteriorPoint<2> operator()(const Chain& chain) const { return inside_lines(chain, filled); }
    InteriorPoint<2> operator()(const Outlines& outlines) const { return inside_lines(outlines, filled); }
    InteriorPoint<2> operator()(const TileMap& map) const { return near(map, middle_of(map)); }
    template <class S>
    InteriorPoint<2> operator()(const S& shape) const {
        return near(shape, center(bounds(View<2>(view(shape)))));
    }
};

}  // namespace

InteriorPoint<3> interior_point(const Polyhedron& solid) {
    const Vec3 middle = solid.centroid();
    return {middle, std::max(0.0f, -closest(solid, middle).distance)};
}

InteriorPoint<3> interior_point(const Mesh& mesh, bool filled) {
    if (filled)
        if (const std::optional<Vec3> middle = middle_of(mesh)) return {*middle, closest(mesh, *middle).distance};
    return {mesh.points().front(), 0};
}

InteriorPoint<2> interior_point(const LevelShape& shape, bool filled) {
    return std::visit(FindInteriorPoint{filled}, shape);
}

}  // namespace abut::tool
