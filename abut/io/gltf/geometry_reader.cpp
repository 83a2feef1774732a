#include <abut/io/gltf/decompress.hpp>
#include <abut/io/gltf/geometry_reader.hpp>
#include <abut/io/mesh/primitives.hpp>

#include <algorithm>
#include <cmath>

#include <glm/ext/vector_double4.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut::gltf {
namespace {

using detail::no_index;

// Of all meshes, each as often as it is read. A few bytes can use one mesh many times.
constexpr std::size_t max_points = std::size_t{1} << 25;

enum TriangleMode : std::uint32_t { triangle_list = 4, triangle_strip = 5, triangle_fan = 6 };

// Assembles triangles from vertex indices. Degenerate triangles that join parts of a strip are left out, and so are
// trailing indices that don't complete a triangle, as the specification demands.
std::vector<glm::uvec3> assemble(const std::vector<std::uint32_t>& indices, std::uint32_t mode) {
    std::vector<glm::uvec3> triangles;
    if (mode == triangle_list) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        const glm::uvec3 t = mode == triangle_fan ? glm::uvec3(indices[i + 1], indices[i + 2], indices[0])
                             : i % 2 == 0         ? glm::uvec3(indices[i], indices[i + 1], indices[i + 2])
                                                  : glm::uvec3(indices[i], indices[i + 2], indices[i + 1]);
        const bool seam = t.x == t.y || t.y == t.z || t.z == t.x;
        if (mode == triangle_fan || !seam) triangles.push_back(t);
    }
    return triangles;
}

std::vector<Vec3> as_vectors(const std::vector<double>& numbers) {
    std::vector<Vec3> result(numbers.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) result[i][static_cast<int>(k)] = static_cast<float>(numbers[3 * i + k]);
    return result;
}

std::vector<std::uint32_t> as_indices(const std::vector<double>& numbers) {
    std::vector<std::uint32_t> result;
    for (const double number : numbers) result.push_back(number >= 0 ? static_cast<std::uint32_t>(number) : 0);
    return result;
}

bool is_zero(const std::vector<double>& weights) {
    return std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; });
}

std::string name_of(const Document& document, const Mesh& mesh) {
    const auto index = static_cast<std::size_t>(&mesh - document.meshes.data());
    return mesh.name.empty() ? "meshes[" + std::to_string(index) + "]" : mesh.name;
}

// Hulls and boxes read the corners before the scene is validated.
std::optional<Problem> check_indices(const std::vector<Geometry>& meshes) {
    for (const Geometry& mesh : meshes)
        for (const glm::uvec3& t : mesh.triangles)
            if (std::max({t.x, t.y, t.z}) >= mesh.points.size())
                return Problem{ProblemCode::index_out_of_range,
                               "mesh '" + mesh.name + "': index " + std::to_string(std::max({t.x, t.y, t.z})) +
                                   " is out of range (" + std::to_string(mesh.points.size()) + " vertices)"};
    return std::nullopt;
}

}  // namespace

glm::dmat4 local_matrix(const Node& node) {
    if (node.has_matrix) return node.matrix;
    return glm::scale(glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(glm::normalize(node.rotation)),
                      node.scale);
}

void GeometryReader::warn_once(const std::string& warning) {
    if (std::find(scene_.warnings.begin(), scene_.warnings.end(), warning) == scene_.warnings.end())
        scene_.warnings.push_back(warning);
}

std::uint32_t GeometryReader::add(Geometry geometry) {
    scene_.geometries.push_back(std::move(geometry));
    return static_cast<std::uint32_t>(scene_.geometries.size() - 1);
}

Result<std::vector<Vec3>> GeometryReader::vectors(std::uint32_t accessor) {
    const Result<std::vector<double>> numbers = data_.numbers(accessor, 3);
    if (!numbers) return numbers.problem();
    return as_vectors(*numbers);
}

std::optional<Problem> GeometryReader::draco_primitive(const Primitive& from, bool with_joints, ReadPrimitive& to) {
    const Result<std::span<const std::byte>> bytes = data_.view(from.draco_view);
    if (!bytes) return bytes.problem();
    const auto is_normalized = [&](std::uint32_t accessor) {
        return accessor != no_index && document_.accessors[accessor].normalized;
    };
    const DracoAttribute attributes[] = {
        {from.draco_positions, 3, is_normalized(from.positions)},
        {with_normals_ ? from.draco_normals : no_index, 3, is_normalized(from.normals)},
        {with_joints ? from.draco_joints : no_index, 4},
        {with_joints ? from.draco_weights : no_index, 4, is_normalized(from.weights)}};
    Result<DracoMesh> mesh = decode_draco(*bytes, attributes);
    if (!mesh) return mesh.problem();
    to.geometry.points = as_vectors(mesh->attributes[0]);
    to.geometry.normals = as_vectors(mesh->attributes[1]);
    to.geometry.triangles = std::move(mesh->triangles);
    to.joints = {as_indices(mesh->attributes[2]), std::move(mesh->attributes[3])};
    return std::nullopt;
}

Result<GeometryReader::ReadPrimitive> GeometryReader::primitive(const Primitive& from, std::string name,
                                                                bool with_joints) {
    ReadPrimitive result;
    Geometry& geometry = result.geometry;
    geometry.name = std::move(name);
    const auto problem = [&](const Problem& what) {
        return Problem{what.code, "mesh '" + geometry.name + "': " + what.message};
    };
    if (from.draco_view != no_index) {
        if (const std::optional<Problem> failed = draco_primitive(from, with_joints, result)) return problem(*failed);
        return result;
    }
    Result<std::vector<Vec3>> points = vectors(from.positions);
    if (!points) return problem(points.problem());
    geometry.points = *std::move(points);
    if (with_normals_ && from.normals != no_index) {
        Result<std::vector<Vec3>> normals = vectors(from.normals);
        if (!normals) return problem(normals.problem());
        geometry.normals = *std::move(normals);
    }
    if (with_joints && from.joints != no_index && from.weights != no_index) {
        const Result<std::vector<double>> joints = data_.numbers(from.joints, 4);
        if (!joints) return problem(joints.problem());
        Result<std::vector<double>> weights = data_.numbers(from.weights, 4);
        if (!weights) return problem(weights.problem());
        result.joints = {as_indices(*joints), *std::move(weights)};
    }

    std::vector<std::uint32_t> indices(geometry.points.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    if (from.indices != no_index) {
        Result<std::vector<std::uint32_t>> from_file = data_.indices(from.indices);
        if (!from_file) return problem(from_file.problem());
        indices = *std::move(from_file);
    }
    geometry.triangles = assemble(indices, from.mode);
    return result;
}

// Moves the points by the morph targets. Normals don't follow.
std::optional<Problem> GeometryReader::morph(const Primitive& from, const std::vector<double>& weights,
                                             Geometry& geometry) {
    for (std::size_t i = 0; i < std::min(weights.size(), from.target_positions.size()); ++i) {
        if (weights[i] == 0 || from.target_positions[i] == no_index) continue;
        const Result<std::vector<double>> moves = data_.numbers(from.target_positions[i], 3);
        if (!moves) return moves.problem();
        if (moves->size() != 3 * geometry.points.size())
            return Problem{ProblemCode::bad_format,
                           "morph target " + std::to_string(i) + " has another number of points"};
        for (std::size_t k = 0; k < geometry.points.size(); ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                float& coordinate = geometry.points[k][static_cast<int>(axis)];
                coordinate = static_cast<float>(static_cast<double>(coordinate) + weights[i] * (*moves)[3 * k + axis]);
            }
        geometry.normals.clear();
    }
    return std::nullopt;
}

Result<std::vector<GeometryReader::ReadPrimitive>> GeometryReader::primitives(std::uint32_t index,
                                                                              const std::vector<double>& weights,
                                                                              bool with_joints) {
    const Mesh& mesh = document_.meshes[index];
    const std::string name = name_of(document_, mesh);
    std::vector<ReadPrimitive> result;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& from = mesh.primitives[i];
        if (from.positions == no_index && from.draco_positions == no_index) continue;
        if (from.mode > triangle_fan)
            return Problem{ProblemCode::bad_format,
                           "mesh '" + name + "': unknown primitive mode " + std::to_string(from.mode)};
        if (from.mode < triangle_list) {
            warn_once("points and lines are left out: only triangles collide");
            continue;
        }
        const std::string part = mesh.primitives.size() == 1 ? "" : ", primitive " + std::to_string(i);
        Result<ReadPrimitive> read = primitive(from, name + part, with_joints);
        if (!read) return read.problem();
        points_ += read->geometry.points.size();
        if (points_ > max_points)
            return Problem{ProblemCode::too_large, "mesh '" + name + "': more than " + std::to_string(max_points) +
                                                       " points in all, the limit"};
        if (const std::optional<Problem> problem = morph(from, weights, read->geometry))
            return Problem{problem->code, "mesh '" + name + part + "': " + problem->message};
        result.push_back(*std::move(read));
    }
    return result;
}

Result<std::vector<std::uint32_t>> GeometryReader::mesh(std::uint32_t index, const std::vector<double>& weights) {
    const auto key = std::pair(index, is_zero(weights) ? std::vector<double>() : weights);
    const auto known = geometries_of_mesh_.find(key);
    if (known != geometries_of_mesh_.end()) return known->second;
    Result<std::vector<ReadPrimitive>> read = primitives(index, weights, false);
    if (!read) return read.problem();
    std::vector<std::uint32_t> geometries;
    for (ReadPrimitive& each : *read) geometries.push_back(add(std::move(each.geometry)));
    geometries_of_mesh_.emplace(key, geometries);
    return geometries;
}

Result<std::vector<std::pair<std::uint32_t, PointJoints>>> GeometryReader::skinned_mesh(
    std::uint32_t index, const std::vector<double>& weights) {
    Result<std::vector<ReadPrimitive>> read = primitives(index, weights, true);
    if (!read) return read.problem();
    std::vector<std::pair<std::uint32_t, PointJoints>> result;
    for (ReadPrimitive& each : *read) result.emplace_back(add(std::move(each.geometry)), std::move(each.joints));
    return result;
}

// The meshes of a node and of those below it, in the node's frame. Requires a forest, and nodes not too deep.
std::optional<Problem> GeometryReader::add_meshes_below(std::uint32_t root, const glm::dmat4& matrix,
                                                        std::vector<Geometry>& to) {
    std::vector<std::pair<std::uint32_t, glm::dmat4>> stack{{root, matrix}};
    while (!stack.empty()) {
        const auto [index, place] = stack.back();
        stack.pop_back();
        const Node& node = document_.nodes[index];
        if (node.mesh != no_index) {
            Result<std::vector<ReadPrimitive>> read = primitives(node.mesh, node.weights, false);
            if (!read) return read.problem();
            for (ReadPrimitive& each : *read) {
                for (Vec3& point : each.geometry.points)
                    point = Vec3(glm::dvec3(place * glm::dvec4(glm::dvec3(point), 1.0)));
                each.geometry.normals.clear();
                if (glm::determinant(place) < 0)
                    for (glm::uvec3& t : each.geometry.triangles) std::swap(t.y, t.z);
                to.push_back(std::move(each.geometry));
            }
        }
        for (const std::uint32_t child : node.children)
            stack.emplace_back(child, place * local_matrix(document_.nodes[child]));
    }
    return std::nullopt;
}

Result<std::vector<Geometry>> GeometryReader::collider_meshes(const Collider& collider) {
    std::vector<Geometry> meshes;
    if (collider.node != no_index) {
        if (std::optional<Problem> problem = add_meshes_below(collider.node, glm::dmat4(1.0), meshes))
            return *std::move(problem);
    } else if (collider.mesh != no_index) {
        Result<std::vector<ReadPrimitive>> read = primitives(collider.mesh, {}, false);
        if (!read) return read.problem();
        for (ReadPrimitive& each : *read) meshes.push_back(std::move(each.geometry));
    }
    if (std::optional<Problem> problem = check_indices(meshes)) return *std::move(problem);
    return meshes;
}

Result<std::vector<std::uint32_t>> GeometryReader::collider(std::uint32_t index, std::uint32_t node) {
    const Collider& collider = document_.colliders[index];
    Result<std::vector<Geometry>> read = collider_meshes(collider);
    if (!read) return read.problem();
    std::vector<Geometry> meshes = *std::move(read);
    switch (collider.form) {
        case Collider::Form::box:
            meshes = {collider.fits_mesh ? detail::box_around(meshes) : detail::box_mesh(collider.size)};
            break;
        case Collider::Form::sphere:
            meshes = {collider.fits_mesh ? detail::sphere_around(meshes) : detail::sphere_mesh(collider.radius_bottom)};
            break;
        case Collider::Form::capsule:
            meshes = {detail::capsule_mesh(collider.radius_bottom, collider.radius_top, collider.height)};
            break;
        case Collider::Form::cylinder:
            meshes = {detail::cylinder_mesh(collider.radius_bottom, collider.radius_top, collider.height)};
            break;
        case Collider::Form::plane:
            if (!std::isfinite(collider.size.x) || !std::isfinite(collider.size.z)) {
                warn_once("planes without end are left out");
                return std::vector<std::uint32_t>();
            }
            meshes = {detail::plane_mesh(collider.size.x, collider.size.z)};
            break;
        case Collider::Form::mesh:
            break;
    }
    if (collider.convex && !meshes.empty()) {
        Geometry all = std::move(meshes.front());
        for (std::size_t i = 1; i < meshes.size(); ++i) {
            const auto first = static_cast<std::uint32_t>(all.points.size());
            all.points.insert(all.points.end(), meshes[i].points.begin(), meshes[i].points.end());
            for (const glm::uvec3& t : meshes[i].triangles) all.triangles.push_back(t + first);
        }
        meshes = {detail::hull_mesh(all)};
    }
    std::vector<std::uint32_t> result;
    for (Geometry& mesh : meshes) {
        if (mesh.name.empty()) mesh.name = "collider of " + gltf::name_of(document_, node);
        result.push_back(add(std::move(mesh)));
    }
    return result;
}

}  // namespace abut::gltf
