#include "inside.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

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

}  // namespace

InsidePoint inside_point(const Polyhedron& solid) {
    const Vec3 middle = solid.centroid();
    return {middle, std::max(0.0f, -closest(solid, middle).distance)};
}

InsidePoint inside_point(const Mesh& mesh, bool filled) {
    if (filled)
        if (const std::optional<Vec3> middle = middle_of(mesh)) return {*middle, closest(mesh, *middle).distance};
    return {mesh.points().front(), 0};
}

}  // namespace abut::tool
