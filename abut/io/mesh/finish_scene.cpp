#include <abut/io/mesh/collider_names.hpp>
#include <abut/io/mesh/finish_scene.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include <glm/ext/quaternion_geometric.hpp>

namespace abut::detail {
namespace {

constexpr std::size_t max_depth = 1000;

std::string title(const Scene& scene, const Geometry& geometry) {
    const auto index = static_cast<std::size_t>(&geometry - scene.geometries.data());
    return geometry.name.empty() ? "mesh " + std::to_string(index) : "mesh '" + geometry.name + "'";
}

std::string title(const SceneNode& node) {
    return "node '" + node.name + "'";
}

std::optional<Problem> check_points(const Scene& scene, const Geometry& geometry) {
    for (std::size_t i = 0; i < geometry.points.size(); ++i)
        if (!is_finite<3>(geometry.points[i]))
            return Problem{ProblemCode::not_finite,
                           title(scene, geometry) + ", vertex " + std::to_string(i) + ": coordinate is not finite", i};
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::uvec3& t = geometry.triangles[i];
        const std::uint32_t largest_index = std::max({t.x, t.y, t.z});
        if (largest_index >= geometry.points.size())
            return Problem{ProblemCode::index_out_of_range,
                           title(scene, geometry) + ", triangle " + std::to_string(i) + ": index " +
                               std::to_string(largest_index) + " is out of range (" +
                               std::to_string(geometry.points.size()) + " vertices)",
                           i};
    }
    return std::nullopt;
}

// Requires check_points. Removes and counts triangles of zero area, or rejects them if `strict`.
std::optional<Problem> check_areas(const Scene& scene, Geometry& geometry, bool strict) {
    const auto is_degenerate = [&](const glm::uvec3& t) {
        return has_zero_area(geometry.points[t.x], geometry.points[t.y], geometry.points[t.z]);
    };
    const auto first = std::find_if(geometry.triangles.begin(), geometry.triangles.end(), is_degenerate);
    if (first == geometry.triangles.end()) return std::nullopt;
    if (strict) {
        const auto i = static_cast<std::size_t>(first - geometry.triangles.begin());
        return Problem{ProblemCode::degenerate,
                       title(scene, geometry) + ", triangle " + std::to_string(i) + ": zero area", i};
    }
    const auto end = std::remove_if(first, geometry.triangles.end(), is_degenerate);
    geometry.left_out += static_cast<std::uint64_t>(geometry.triangles.end() - end);
    geometry.triangles.erase(end, geometry.triangles.end());
    return std::nullopt;
}

// Requires check_points.
void check_normals(Scene& scene, Geometry& geometry) {
    const auto bad = std::find_if(geometry.normals.begin(), geometry.normals.end(),
                                  [](const Vec3& normal) { return !is_finite<3>(normal); });
    std::string why;
    if (bad != geometry.normals.end())
        why = "that of vertex " + std::to_string(bad - geometry.normals.begin()) + " is not finite";
    else if (!geometry.normals.empty() && geometry.normals.size() != geometry.points.size())
        why = std::to_string(geometry.normals.size()) + " of " + std::to_string(geometry.points.size()) + " vertices";
    if (why.empty()) return;
    geometry.normals.clear();
    scene.warnings.push_back(title(scene, geometry) + ": its normals are left out: " + why);
}

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

std::optional<Problem> check_nodes(const Scene& scene) {
    std::vector<std::size_t> depths;
    std::size_t depth = 0;
    std::size_t too_deep = scene.nodes.size();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        if (!is_finite(node.local))
            return Problem{ProblemCode::not_finite, title(node) + ": transform is not finite", i};
        depths.push_back(node.parent == SceneNode::no_parent ? 1 : depths[node.parent] + 1);
        depth = std::max(depth, depths.back());
        if (depths.back() > max_depth) too_deep = std::min(too_deep, i);
    }
    if (depth <= max_depth) return std::nullopt;
    return Problem{ProblemCode::too_large,
                   "node tree is " + std::to_string(depth) + " deep; the limit is " + std::to_string(max_depth) +
                       ", passed at " + title(scene.nodes[too_deep]),
                   too_deep};
}

template <int N>
bool is_finite(const glm::vec<N, double>& value) {
    for (int i = 0; i < N; ++i)
        if (!std::isfinite(value[i])) return false;
    return true;
}
bool is_finite(const glm::dquat& value) {
    return is_finite(glm::vec<3, double>(value.x, value.y, value.z)) && std::isfinite(value.w);
}

// The first invalid key, and the reason for the message.
struct BadKey {
    std::size_t key;
    const char* what;
};

template <class Value>
std::optional<BadKey> bad_key(const KeyTrack<Value>& track) {
    const auto finite = [](const std::vector<Value>& values, std::size_t i) {
        return i >= values.size() || is_finite(values[i]);
    };
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        if (!std::isfinite(track.times[i]) || !finite(track.values, i) || !finite(track.in_tangents, i) ||
            !finite(track.out_tangents, i))
            return BadKey{i, "is not finite"};
        if (i > 0 && track.times[i] < track.times[i - 1]) return BadKey{i, "is earlier than the one before"};
    }
    return std::nullopt;
}

std::optional<Problem> check_animations(const Scene& scene) {
    for (const Animation& animation : scene.animations)
        for (const NodeMotion& motion : animation.motions) {
            std::optional<BadKey> bad = bad_key(motion.translation);
            if (!bad) bad = bad_key(motion.rotation);
            if (!bad) bad = bad_key(motion.scale);
            if (bad)
                return Problem{ProblemCode::not_finite,
                               "animation '" + animation.name + "', " + title(scene.nodes[motion.node]) + ": key " +
                                   std::to_string(bad->key) + " " + bad->what,
                               bad->key};
        }
    return std::nullopt;
}

void remove_empty_geometry(Scene& scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        SceneNode& node = scene.nodes[i];
        NodeLeftOut left_out{static_cast<std::uint32_t>(i), 0};
        for (const std::uint32_t geometry : node.geometries) left_out.triangles += scene.geometries[geometry].left_out;
        // The warning names an object without a shape too.
        if (node.name.empty() && left_out.triangles > 0) node.name = scene.geometries[node.geometries.front()].name;
        std::erase_if(node.geometries, [&](std::uint32_t k) { return scene.geometries[k].triangles.empty(); });
        if (left_out.triangles > 0) scene.left_out.push_back(left_out);
    }
}

// Requires make_paths_unique.
void warn_of_left_out(Scene& scene) {
    std::uint64_t triangles = 0;
    std::vector<std::string> without_shape;
    for (const NodeLeftOut& left_out : scene.left_out) {
        triangles += left_out.triangles;
        if (scene.nodes[left_out.node].geometries.empty()) without_shape.push_back(path(scene, left_out.node));
    }
    if (triangles > 0)
        scene.warnings.push_back(std::to_string(triangles) +
                                 (triangles == 1 ? " triangle of zero area is" : " triangles of zero area are") +
                                 " left out, such as in '" + path(scene, scene.left_out.front().node) + "'");
    if (!without_shape.empty())
        scene.warnings.push_back((without_shape.size() == 1 ? std::string("1 object has")
                                                            : std::to_string(without_shape.size()) + " objects have") +
                                 " no triangles but those, and so no shape: '" + without_shape.front() +
                                 (without_shape.size() == 1 ? "'" : "', ..."));
}

// The first node with a path keeps it; later ones get a number as suffix.
void make_paths_unique(Scene& scene) {
    std::unordered_set<std::string> taken;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        SceneNode& node = scene.nodes[i];
        if (node.name.empty() && !node.geometries.empty()) node.name = scene.geometries[node.geometries.front()].name;
        if (node.name.empty() && !node.geometries.empty()) node.name = "unnamed";
        if (node.name.empty()) continue;
        const std::string name = node.name;
        for (std::size_t number = 2; !taken.insert(path(scene, i)).second; ++number)
            node.name = name + "#" + std::to_string(number);
    }
}

void normalize_rotations(Scene& scene) {
    for (Animation& animation : scene.animations)
        for (NodeMotion& motion : animation.motions)
            if (motion.rotation.interpolation != Interpolation::cubic)
                for (glm::dquat& rotation : motion.rotation.values) rotation = glm::normalize(rotation);
}

}  // namespace

Result<Scene> finish_scene(ReadScene read, const ReadOptions& options) {
    Scene& scene = read.scene;
    std::optional<Problem> problem = check_nodes(scene);
    for (Geometry& geometry : scene.geometries) {
        if (!problem) problem = check_points(scene, geometry);
        if (!problem) check_normals(scene, geometry);
    }
    if (!problem) problem = check_animations(scene);
    if (problem) return *std::move(problem);

    normalize_rotations(scene);
    schedule(scene);
    pose_skins(scene, read.skins);
    if (!read.skins.empty()) problem = check_nodes(scene);
    for (Geometry& geometry : scene.geometries) {
        if (!problem && !read.skins.empty()) problem = check_points(scene, geometry);
        if (!problem && !options.keep_degenerate) problem = check_areas(scene, geometry, options.strict);
    }
    if (problem) return *std::move(problem);
    if (!options.ignore_colliders && !read.has_colliders) select_colliders(scene);

    remove_empty_geometry(scene);
    const bool has_objects = std::any_of(scene.nodes.begin(), scene.nodes.end(),
                                         [](const SceneNode& node) { return !node.geometries.empty(); });
    if (!has_objects)
        return Problem{ProblemCode::empty_input, scene.left_out.empty()
                                                     ? "no triangles in it: 0 objects"
                                                     : "all triangles in it have zero area: 0 objects"};
    make_paths_unique(scene);
    warn_of_left_out(scene);
    if (read.has_colliders)
        scene.warnings.push_back(
            "the file has colliders of its own: these are read, and not the meshes that are drawn");
    return std::move(scene);
}

}  // namespace abut::detail
