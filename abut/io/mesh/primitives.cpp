#include <abut/io/mesh/primitives.hpp>
#include <abut/io/write_mesh.hpp>
#include <abut/math/aabb.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace abut::detail {
namespace {

void add_ring(double radius, double y, std::vector<Vec3>& points) {
    for (int i = 0; i < sides_of_round_shapes; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides_of_round_shapes;
        points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
}

// A sphere around a point of the y axis.
void add_sphere(double radius, double y, std::vector<Vec3>& points) {
    constexpr int rings = sides_of_round_shapes / 2;
    for (int i = 0; i <= rings; ++i) {
        const double angle = std::numbers::pi * i / rings;
        const bool is_pole = i == 0 || i == rings;
        if (is_pole)
            points.emplace_back(0.0, y + radius * std::cos(angle), 0.0);
        else
            add_ring(radius * std::sin(angle), y + radius * std::cos(angle), points);
    }
}

Aabb3 box_of(std::span<const Geometry> meshes) {
    Aabb3 box = Aabb3::empty();
    for (const Geometry& mesh : meshes)
        for (const glm::uvec3& t : mesh.triangles)
            for (int i = 0; i < 3; ++i) {
                const Vec3& point = mesh.points[t[i]];
                box = merged(box, Aabb3{point, point});
            }
    return box;
}

void move(Geometry& mesh, const Vec3& by) {
    for (Vec3& point : mesh.points) point += by;
}

}  // namespace

Geometry hull_mesh(const std::vector<Vec3>& points) {
    const Result<Polyhedron> hull = Polyhedron::build(points);
    if (!hull || hull->rank() < 3) return {};
    return mesh_of(*hull);
}

Geometry box_mesh(const glm::dvec3& size) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i)
        points.emplace_back(((i & 1) != 0 ? 0.5 : -0.5) * size.x, ((i & 2) != 0 ? 0.5 : -0.5) * size.y,
                            ((i & 4) != 0 ? 0.5 : -0.5) * size.z);
    return hull_mesh(points);
}

Geometry sphere_mesh(double radius) {
    std::vector<Vec3> points;
    add_sphere(radius, 0, points);
    return hull_mesh(points);
}

Geometry capsule_mesh(double radius_bottom, double radius_top, double height) {
    std::vector<Vec3> points;
    if (radius_bottom > 0) add_sphere(radius_bottom, -0.5 * height, points);
    if (radius_top > 0) add_sphere(radius_top, 0.5 * height, points);
    return hull_mesh(points);
}

Geometry cylinder_mesh(double radius_bottom, double radius_top, double height) {
    std::vector<Vec3> points;
    for (const auto& [radius, y] : {std::pair(radius_bottom, -0.5 * height), std::pair(radius_top, 0.5 * height)}) {
        if (radius > 0)
            add_ring(radius, y, points);
        else
            points.emplace_back(0.0, y, 0.0);
    }
    return hull_mesh(points);
}

Geometry plane_mesh(double size_x, double size_z) {
    const double x = 0.5 * size_x, z = 0.5 * size_z;
    Geometry mesh;
    mesh.points = {Vec3(-x, 0, -z), Vec3(x, 0, -z), Vec3(x, 0, z), Vec3(-x, 0, z)};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    return mesh;
}

Geometry hull_mesh(const Geometry& mesh) {
    std::vector<Vec3> points;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) points.push_back(mesh.points[t[i]]);
    Geometry hull = hull_mesh(points);
    if (hull.triangles.empty()) return mesh;
    hull.name = mesh.name;
    return hull;
}

Geometry box_around(std::span<const Geometry> meshes) {
    const Aabb3 box = box_of(meshes);
    if (!(box.min.x <= box.max.x)) return {};
    Geometry result = box_mesh(glm::dvec3(box.max - box.min));
    move(result, 0.5f * (box.min + box.max));
    return result;
}

Geometry sphere_around(std::span<const Geometry> meshes) {
    const Aabb3 box = box_of(meshes);
    if (!(box.min.x <= box.max.x)) return {};
    const Vec3 center = 0.5f * (box.min + box.max);
    float radius = 0;
    for (const Geometry& mesh : meshes)
        for (const glm::uvec3& t : mesh.triangles)
            for (int i = 0; i < 3; ++i) radius = std::max(radius, glm::distance(mesh.points[t[i]], center));
    Geometry result = sphere_mesh(static_cast<double>(radius));
    move(result, center);
    return result;
}

}  // namespace abut::detail
