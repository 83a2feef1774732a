#include <abut/io/godot/shapes.hpp>
#include <abut/io/mesh/primitives.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut::godot {
namespace {

double number(const Section& resource, std::string_view name, double otherwise) {
    const Value* const value = resource.property(name);
    return value != nullptr && value->numbers.size() == 1 ? value->numbers[0] : otherwise;
}

std::vector<Vec3> points(const Section& resource, std::string_view name) {
    std::vector<Vec3> result;
    const Value* const value = resource.property(name);
    if (value == nullptr) return result;
    for (std::size_t i = 0; i + 2 < value->numbers.size(); i += 3)
        result.emplace_back(value->numbers[i], value->numbers[i + 1], value->numbers[i + 2]);
    return result;
}

Geometry triangles(const Section& resource) {
    Geometry mesh;
    mesh.points = points(resource, "data");
    for (std::uint32_t i = 0; i + 2 < mesh.points.size(); i += 3) mesh.triangles.push_back({i, i + 2, i + 1});
    return mesh;
}

// Heights at whole numbers around the middle.
Geometry height_map(const Section& resource) {
    const double width = number(resource, "map_width", 2), depth = number(resource, "map_depth", 2);
    const Value* const heights = resource.property("map_data");
    Geometry mesh;
    if (heights == nullptr || !(width >= 2 && depth >= 2) ||
        static_cast<double>(heights->numbers.size()) != width * depth)
        return mesh;
    const auto columns = static_cast<std::uint32_t>(width), rows = static_cast<std::uint32_t>(depth);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t corner = row * columns + column;
            mesh.points.emplace_back(column - 0.5 * (width - 1), heights->numbers[corner], row - 0.5 * (depth - 1));
            if (row + 1 == rows || column + 1 == columns) continue;
            mesh.triangles.push_back({corner, corner + columns, corner + 1});
            mesh.triangles.push_back({corner + 1, corner + columns, corner + columns + 1});
        }
    return mesh;
}

Geometry round_shape(std::string_view type, const Section& resource) {
    const double radius = number(resource, "radius", 0.5), height = number(resource, "height", 2);
    if (!(radius > 0)) return {};
    if (type == "SphereShape3D") return detail::sphere_mesh(radius);
    if (type == "CylinderShape3D") return detail::cylinder_mesh(radius, radius, height);
    return detail::capsule_mesh(radius, radius, std::max(0.0, height - 2 * radius));
}

}  // namespace

std::optional<Geometry> mesh_of_shape(std::string_view type, const Section& resource) {
    Geometry mesh;
    if (type == "BoxShape3D")
        mesh = detail::box_mesh(resource.vector("size").value_or(glm::dvec3(1)));
    else if (type == "SphereShape3D" || type == "CylinderShape3D" || type == "CapsuleShape3D")
        mesh = round_shape(type, resource);
    else if (type == "ConvexPolygonShape3D")
        mesh = detail::hull_mesh(points(resource, "points"));
    else if (type == "ConcavePolygonShape3D")
        mesh = triangles(resource);
    else if (type == "HeightMapShape3D")
        mesh = height_map(resource);
    if (mesh.triangles.empty()) return std::nullopt;
    mesh.name = type;
    return mesh;
}

}  // namespace abut::godot
