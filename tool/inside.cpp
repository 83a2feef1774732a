#include "inside.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// How far under the surface a ray begins, as a part of the triangle's size, so that it doesn't end where it begins.
constexpr float skin = 1e-3f;

glm::vec3 area_vector(const Triangle3& t) {
    return glm::cross(t.b - t.a, t.c - t.a);
}

std::uint32_t largest_triangle(const Mesh& mesh) {
    std::uint32_t largest = 0;
    float most = -1;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        const float area = glm::length(area_vector(mesh.triangle(i)));
        if (area > most) {
            most = area;
            largest = i;
        }
    }
    return largest;
}

// Half way from the middle of the largest triangle to what is opposite.
std::optional<Vec3> middle_of(const Mesh& mesh) {
    const Triangle3 t = mesh.triangle(largest_triangle(mesh));
    const Vec3 area = area_vector(t);
    const float size = std::sqrt(glm::length(area));
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    const Vec3 inwards = -glm::normalize(area);
    const Vec3 start = (t.a + t.b + t.c) / 3.0f + inwards * (skin * size);
    const Ray<3> ray{start, inwards, std::numeric_limits<float>::infinity()};
    const std::optional<Hit<3>> opposite = raycast(ray, mesh);
    if (!opposite) return std::nullopt;
    const Vec3 middle = start + inwards * (0.5f * opposite->distance);
    return contains(mesh, middle) ? std::optional(middle) : std::nullopt;
}

// Of the lines of a shape, the longest segment.
struct Longest {
    Segment2 segment{};
    float length = -1;

    void take(const Chain& chain) {
        for (std::uint32_t i = 0; i < chain.size(); ++i) {
            const Segment2 s = chain.segment(i);
            const float other = glm::length(s.b - s.a);
            if (other > length) *this = {s, other};
        }
    }
};

// Half way from the middle of the longest segment to what is opposite, on the side that is inside.
template <class Lines>
std::optional<Vec2> middle_of(const Lines& lines, const Longest& longest) {
    if (!(longest.length > 0) || !std::isfinite(longest.length)) return std::nullopt;
    const Segment2& s = longest.segment;
    const Vec2 along = (s.b - s.a) / longest.length;
    for (const Vec2& inwards : {Vec2(-along.y, along.x), Vec2(along.y, -along.x)}) {
        const Vec2 start = s.a + 0.5f * (s.b - s.a) + inwards * (skin * longest.length);
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
    result.take(chain);
    return result;
}
Longest longest_of(const Outlines& outlines) {
    Longest result;
    for (const Chain& chain : outlines.chains) result.take(chain);
    return result;
}

// Of lines, a place on them where they enclose nothing.
template <class Lines>
InsidePoint<2> inside_lines(const Lines& lines, bool filled) {
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

// A place of the shape near the middle of its box, or that itself.
template <class S>
InsidePoint<2> near(const S& shape, const Vec2& place) {
    const Closest<2> way = closest(shape, place);
    return way.distance <= 0 ? InsidePoint<2>{place, -way.distance} : InsidePoint<2>{way.on_a, 0};
}

struct Inside {
    bool filled;

    InsidePoint<2> operator()(const Chain& chain) const { return inside_lines(chain, filled); }
    InsidePoint<2> operator()(const Outlines& outlines) const { return inside_lines(outlines, filled); }
    InsidePoint<2> operator()(const TileMap& map) const { return near(map, middle_of(map)); }
    template <class S>
    InsidePoint<2> operator()(const S& shape) const {
        return near(shape, center(bounds(View<2>(view(shape)))));
    }
};

}  // namespace

InsidePoint<3> inside_point(const Polyhedron& solid) {
    const Vec3 middle = solid.centroid();
    return {middle, std::max(0.0f, -closest(solid, middle).distance)};
}

InsidePoint<3> inside_point(const Mesh& mesh, bool filled) {
    if (filled)
        if (const std::optional<Vec3> middle = middle_of(mesh)) return {*middle, closest(mesh, *middle).distance};
    return {mesh.points().front(), 0};
}

InsidePoint<2> inside_point(const LevelShape& shape, bool filled) {
    return std::visit(Inside{filled}, shape);
}

}  // namespace abut::tool
