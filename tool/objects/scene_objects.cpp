#include "tool/objects/scene_objects.hpp"

#include "tool/objects/transforms.hpp"
#include <abut/bake/solid.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace abut::tool {
namespace {

// Merges all geometry of a node to one welded surface.
Welded surface_of(const Scene& scene, const std::vector<std::uint32_t>& geometries) {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (const std::uint32_t index : geometries) {
        const Geometry& geometry = scene.geometries[index];
        const auto offset = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), geometry.points.begin(), geometry.points.end());
        for (const glm::uvec3& t : geometry.triangles) triangles.push_back(t + offset);
    }
    return weld(points, triangles);
}

// A rotation with optional mirroring and uniform scale: preserves convexity to within the same tolerance.
bool is_similarity(const glm::dmat3& m) {
    const double scale = glm::length(m[0]);
    glm::dmat3 rotation = m / scale;
    if (glm::determinant(rotation) < 0) rotation[0] = -rotation[0];
    return is_rotation(rotation);
}

// True if the map collapses shapes to a line or a point. A collapse to a plane keeps the shape.
bool is_collapsed(const glm::dmat3& m) {
    const double longest = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
    const double widest = std::max({glm::length(glm::cross(m[0], m[1])), glm::length(glm::cross(m[1], m[2])),
                                    glm::length(glm::cross(m[2], m[0]))});
    return !(widest > 1e-12 * longest * longest);
}

float bounding_radius(std::span<const Vec3> points) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& p : points) box = merged(box, Aabb3{p, p});
    const Vec3 middle = center(box);
    double radius = 0;
    for (const Vec3& p : points) radius = std::max(radius, glm::length(glm::dvec3(p) - glm::dvec3(middle)));
    return static_cast<float>(radius);
}

Problem out_of_range(const Object<3>& object) {
    return {ProblemCode::not_finite, "object '" + object.path + "': its transform takes it out of the range of floats"};
}

}  // namespace

SceneObjects::SceneObjects(const Scene& scene) : scene_(scene) {
    std::vector<std::pair<std::string, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        if (!scene.nodes[i].geometries.empty()) order.emplace_back(path(scene, i), i);
    std::sort(order.begin(), order.end());

    std::map<std::vector<std::uint32_t>, std::size_t> model_of_geometries;
    for (auto& [path, i] : order) {
        const SceneNode& node = scene.nodes[i];
        const auto [found, is_new] = model_of_geometries.try_emplace(node.geometries, models_.size());
        if (is_new) {
            Model model{surface_of(scene, node.geometries)};
            model.solid = is_convex_solid(model.surface.points, model.surface.triangles);
            models_.push_back(std::move(model));
        }
        Object<3> object;
        object.path = std::move(path);
        object.name = node.name;
        object.parts = models_[found->second].surface.triangles.size();
        objects_.push_back(std::move(object));
        Node& from = nodes_.emplace_back();
        from.node = i;
        from.model = found->second;
    }
    was_hidden_.assign(objects_.size(), false);
    was_discontinuous_.assign(objects_.size(), false);
    motion_times_ = motion_times(scene);
    const auto is_cubic = [](const auto& track) { return track.interpolation == Interpolation::cubic; };
    for (const Animation& animation : scene.animations)
        for (const NodeMotion& motion : animation.motions)
            has_curves_ = has_curves_ || is_cubic(motion.translation) || is_cubic(motion.rotation);
}

std::optional<Problem> SceneObjects::go_to(double time, ProgressCall progress) {
    world_matrices(scene_, time, matrices_);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        Object<3>& object = objects_[i];
        const glm::dmat4& matrix = matrices_[nodes_[i].node];
        object.moved = nodes_[i].matrix != matrix;
        if (object.moved)
            if (std::optional<Problem> problem = set_transform(i, matrix)) return problem;
        if (!object.present) was_hidden_[i] = true;
        progress(i + 1, objects_.size());
    }
    return std::nullopt;
}

// The shape is reused as long as its node only rotates and translates.
std::optional<Problem> SceneObjects::set_transform(std::size_t i, const glm::dmat4& matrix) {
    Object<3>& object = objects_[i];
    Node& node = nodes_[i];
    node.matrix = matrix;
    object.box = Aabb3::empty();
    if (!is_finite(matrix)) return out_of_range(object);
    const glm::dmat3 linear(matrix);
    object.present = !is_collapsed(linear);
    if (!object.present) return std::nullopt;

    std::optional<glm::dmat3> rotation = rotation_since(node.baked, linear);
    if (!rotation) {
        if (std::optional<Problem> problem = bake(i, linear)) return problem;
        rotation = glm::dmat3(1.0);
    }
    object.pose.position = Vec3(matrix[3]);
    object.pose.rotation = glm::qua<float>(glm::normalize(glm::quat_cast(*rotation)));
    object.placed = view(at(object.shape, object.pose));
    object.box = bounds(object.placed);
    if (!abut::detail::is_finite(object.box.min) || !abut::detail::is_finite(object.box.max))
        return out_of_range(object);
    return std::nullopt;
}

std::optional<Problem> SceneObjects::bake(std::size_t i, const glm::dmat3& linear) {
    Object<3>& object = objects_[i];
    Node& node = nodes_[i];
    const Model& model = models_[node.model];
    std::vector<Vec3> points;
    points.reserve(model.surface.points.size());
    for (const Vec3& p : model.surface.points) points.emplace_back(linear * glm::dvec3(p));
    std::vector<glm::uvec3> triangles = model.surface.triangles;
    if (glm::determinant(linear) < 0)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);

    node.baked = linear;
    object.radius = bounding_radius(points);
    object.reach = 0;
    for (const Vec3& p : points) object.reach = std::max(object.reach, glm::length(p));
    object.solid = model.solid && (is_similarity(linear) || is_convex_solid(points, triangles));
    object.kind = object.solid ? "solid" : "mesh";
    object.part_name = object.solid ? "" : "triangle";
    object.filled = false;
    if (object.solid) {
        Result<Polyhedron> built = Polyhedron::build(points);
        if (!built) return out_of_range(object);
        object.inside = interior_point(*built);
        node.shape = std::make_shared<const Shape>(*std::move(built));
    } else {
        Result<Mesh> built = Mesh::build(points, triangles);
        if (!built) return out_of_range(object);
        object.filled = built->closed() && signed_volume(points, triangles) > 0;
        object.inside = interior_point(*built, object.filled);
        node.shape = std::make_shared<const Shape>(*std::move(built));
    }
    object.data = node.shape;
    object.surface = std::visit([](const auto& shape) { return View<3>(view(shape)); }, *node.shape);
    object.shape = object.filled ? View<3>(view(solid(std::get<Mesh>(*node.shape)))) : object.surface;
    return std::nullopt;
}

std::vector<std::string> SceneObjects::paths_where(const std::vector<bool>& selected) const {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < objects_.size(); ++i)
        if (selected[i]) paths.push_back(objects_[i].path);
    return paths;
}

std::vector<std::string> SceneObjects::hidden() const {
    return paths_where(was_hidden_);
}

}  // namespace abut::tool
