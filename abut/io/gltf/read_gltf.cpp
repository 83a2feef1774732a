#include <abut/io/gltf/accessors.hpp>
#include <abut/io/gltf/read_gltf.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut::gltf {
namespace {

using detail::no_index;

enum Mode : std::uint32_t { triangle_list = 4, triangle_strip = 5, triangle_fan = 6 };

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

class SceneReader {
public:
    SceneReader(const Document& document, const std::filesystem::path& folder, const ReadOptions& options)
        : document_(document),
          data_(document, detail::ReferencedFiles(folder, options.allow_outside)),
          with_normals_(options.normals),
          scene_node_(document.nodes.size(), no_index) {}

    Result<Scene> read();

private:
    void warn_once(const std::string& warning) {
        if (std::find(scene_.warnings.begin(), scene_.warnings.end(), warning) == scene_.warnings.end())
            scene_.warnings.push_back(warning);
    }
    std::string title(const Animation& animation) const;

    Result<std::vector<Vec3>> read_vectors(std::uint32_t accessor);
    Result<Geometry> read_primitive(const Primitive& primitive, std::string name);
    Result<std::vector<std::uint32_t>> read_mesh(std::uint32_t mesh);
    std::optional<Problem> read_nodes();
    template <class Value, int N>
    Result<KeyTrack<Value>> read_track(const Sampler& sampler, const std::string& where);
    std::optional<Problem> read_animation(const Animation& animation);

    const Document& document_;
    AccessorReader data_;
    bool with_normals_;
    Scene scene_;
    std::vector<std::uint32_t> scene_node_;  // scene node of each document node
    std::map<std::uint32_t, std::vector<std::uint32_t>> geometries_of_mesh_;
};

std::string SceneReader::title(const Animation& animation) const {
    const auto place = static_cast<std::size_t>(&animation - document_.animations.data());
    return animation.name.empty() ? "animation " + std::to_string(place) : "animation '" + animation.name + "'";
}

Result<std::vector<Vec3>> SceneReader::read_vectors(std::uint32_t accessor) {
    const Result<std::vector<double>> numbers = data_.numbers(accessor, 3);
    if (!numbers) return numbers.problem();
    std::vector<Vec3> result(numbers->size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) result[i][static_cast<int>(k)] = static_cast<float>((*numbers)[3 * i + k]);
    return result;
}

Result<Geometry> SceneReader::read_primitive(const Primitive& primitive, std::string name) {
    Geometry geometry{std::move(name), {}, {}};
    const auto problem = [&](const Problem& from) {
        return Problem{from.code, "mesh '" + geometry.name + "': " + from.message};
    };
    Result<std::vector<Vec3>> points = read_vectors(primitive.positions);
    if (!points) return problem(points.problem());
    geometry.points = *std::move(points);
    if (with_normals_ && primitive.normals != no_index) {
        Result<std::vector<Vec3>> normals = read_vectors(primitive.normals);
        if (!normals) return problem(normals.problem());
        geometry.normals = *std::move(normals);
    }

    std::vector<std::uint32_t> indices(geometry.points.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    if (primitive.indices != no_index) {
        Result<std::vector<std::uint32_t>> from_file = data_.indices(primitive.indices);
        if (!from_file) return problem(from_file.problem());
        indices = *std::move(from_file);
    }
    geometry.triangles = assemble(indices, primitive.mode);
    return geometry;
}

// Returns the geometries of a mesh, one per triangle primitive.
Result<std::vector<std::uint32_t>> SceneReader::read_mesh(std::uint32_t index) {
    const auto known = geometries_of_mesh_.find(index);
    if (known != geometries_of_mesh_.end()) return known->second;
    const Mesh& mesh = document_.meshes[index];
    const std::string name = mesh.name.empty() ? "meshes[" + std::to_string(index) + "]" : mesh.name;
    if (mesh.morphs) warn_once("morph targets are left out: such meshes are taken in their base shape");

    std::vector<std::uint32_t> geometries;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& primitive = mesh.primitives[i];
        if (primitive.positions == no_index) continue;
        if (primitive.mode > triangle_fan)
            return Problem{ProblemCode::bad_format,
                           "mesh '" + name + "': unknown primitive mode " + std::to_string(primitive.mode)};
        if (primitive.mode < triangle_list) {
            warn_once("points and lines are left out: only triangles collide");
            continue;
        }
        const std::string part = mesh.primitives.size() == 1 ? "" : ", primitive " + std::to_string(i);
        Result<Geometry> geometry = read_primitive(primitive, name + part);
        if (!geometry) return geometry.problem();
        geometries.push_back(static_cast<std::uint32_t>(scene_.geometries.size()));
        scene_.geometries.push_back(*std::move(geometry));
    }
    geometries_of_mesh_.emplace(index, geometries);
    return geometries;
}

std::optional<Problem> SceneReader::read_nodes() {
    struct StackEntry {
        std::uint32_t node;
        std::uint32_t parent;
    };
    std::vector<StackEntry> stack;
    for (auto root = document_.roots.rbegin(); root != document_.roots.rend(); ++root)
        stack.push_back({*root, SceneNode::no_parent});
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const Node& from = document_.nodes[index];
        SceneNode node;
        node.name = from.name.empty() ? "nodes[" + std::to_string(index) + "]" : from.name;
        node.parent = parent;
        node.local = from.has_matrix ? from.matrix
                                     : glm::scale(glm::translate(glm::dmat4(1.0), from.translation) *
                                                      glm::mat4_cast(glm::normalize(from.rotation)),
                                                  from.scale);
        if (from.mesh != no_index) {
            Result<std::vector<std::uint32_t>> geometries = read_mesh(from.mesh);
            if (!geometries) return geometries.problem();
            node.geometries = *std::move(geometries);
            if (from.instanced)
                warn_once("instances made by EXT_mesh_gpu_instancing are left out, except the node itself");
            if (from.skinned) warn_once("skinned meshes are taken in their bind pose");
        }
        scene_node_[index] = static_cast<std::uint32_t>(scene_.nodes.size());
        for (auto child = from.children.rbegin(); child != from.children.rend(); ++child)
            stack.push_back({*child, scene_node_[index]});
        scene_.nodes.push_back(std::move(node));
    }
    return std::nullopt;
}

// Groups numbers N at a time. A quaternion is stored as x y z w in the file.
template <class Value, int N>
std::vector<Value> values_of(const std::vector<double>& numbers) {
    std::vector<Value> values(numbers.size() / N);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double* n = numbers.data() + i * N;
        if constexpr (N == 4)
            values[i] = Value(n[3], n[0], n[1], n[2]);
        else
            values[i] = Value(n[0], n[1], n[2]);
    }
    return values;
}

template <class Value, int N>
Result<KeyTrack<Value>> SceneReader::read_track(const Sampler& sampler, const std::string& where) {
    const auto problem = [&](const Problem& from) { return Problem{from.code, where + ": " + from.message}; };
    if (sampler.input == no_index || sampler.output == no_index)
        return Problem{ProblemCode::bad_format, where + ": times or values are missing"};
    Result<std::vector<double>> times = data_.numbers(sampler.input, 1);
    if (!times) return problem(times.problem());
    const Result<std::vector<double>> numbers = data_.numbers(sampler.output, N);
    if (!numbers) return problem(numbers.problem());

    KeyTrack<Value> track;
    track.times = *std::move(times);
    track.values = values_of<Value, N>(*numbers);
    const std::size_t per_key = sampler.curve == Curve::cubic ? 3 : 1;
    if (track.values.size() != per_key * track.times.size())
        return Problem{ProblemCode::bad_format, where + ": " + std::to_string(track.times.size()) + " times but " +
                                                    std::to_string(track.values.size()) + " values"};
    if (sampler.curve == Curve::step) track.interpolation = Interpolation::step;
    if (sampler.curve == Curve::cubic) {
        track.interpolation = Interpolation::cubic;
        std::vector<Value> values;
        for (std::size_t i = 0; i < track.times.size(); ++i) {
            track.in_tangents.push_back(track.values[3 * i]);
            values.push_back(track.values[3 * i + 1]);
            track.out_tangents.push_back(track.values[3 * i + 2]);
        }
        track.values = std::move(values);
    }
    return track;
}

std::optional<Problem> SceneReader::read_animation(const Animation& from) {
    abut::Animation animation;
    animation.name = from.name;
    std::map<std::uint32_t, std::size_t> motion_of_node;
    for (const Channel& channel : from.channels) {
        if (channel.target == Target::weights)
            warn_once("morph targets are left out: such meshes are taken in their base shape");
        if (channel.target == Target::weights || channel.node == no_index || scene_node_[channel.node] == no_index)
            continue;
        const std::uint32_t node = scene_node_[channel.node];
        const auto [place, is_new] = motion_of_node.try_emplace(node, animation.motions.size());
        if (is_new) animation.motions.push_back({.node = node, .translation = {}, .rotation = {}, .scale = {}});
        NodeMotion& motion = animation.motions[place->second];
        const Sampler& sampler = from.samplers[channel.sampler];
        const std::string where = title(from) + ", " + name_of(document_, channel.node);
        const auto set_track = [&](auto track, auto& to) -> std::optional<Problem> {
            if (!track) return track.problem();
            if (!track->times.empty()) animation.length = std::max(animation.length, track->times.back());
            to = *std::move(track);
            return std::nullopt;
        };
        std::optional<Problem> problem;
        if (channel.target == Target::rotation)
            problem = set_track(read_track<glm::dquat, 4>(sampler, where), motion.rotation);
        else if (channel.target == Target::translation)
            problem = set_track(read_track<glm::dvec3, 3>(sampler, where), motion.translation);
        else
            problem = set_track(read_track<glm::dvec3, 3>(sampler, where), motion.scale);
        if (problem) return problem;
    }
    if (!animation.motions.empty()) scene_.animations.push_back(std::move(animation));
    return std::nullopt;
}

Result<Scene> SceneReader::read() {
    for (const std::string& extension : document_.required_extensions) {
        if (extension.find("meshopt_compression") != std::string::npos)
            return Problem{ProblemCode::bad_format, "needs the extension " + extension + ", which can't be read"};
        if (extension == "EXT_mesh_gpu_instancing") warn_once("instances made by EXT_mesh_gpu_instancing are left out");
    }
    std::optional<Problem> problem = read_nodes();
    for (const Animation& animation : document_.animations)
        if (!problem) problem = read_animation(animation);
    if (problem) return *std::move(problem);
    return std::move(scene_);
}

}  // namespace

bool is_supported(const Document& document) {
    if (document.version != 2) return false;
    for (const Mesh& mesh : document.meshes)
        for (const Primitive& primitive : mesh.primitives)
            if (primitive.draco) return false;
    return true;
}

Result<Scene> read_gltf(const Document& document, const std::filesystem::path& folder, const ReadOptions& options) {
    return SceneReader(document, folder, options).read();
}

}  // namespace abut::gltf
