#include <abut/io/gltf/geometry_reader.hpp>
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
using detail::ReadScene;

constexpr std::size_t max_instances = std::size_t{1} << 20;

class SceneReader {
public:
    SceneReader(const Document& document, const std::filesystem::path& folder, const ReadOptions& options)
        : document_(document),
          geometries_(document, detail::ReferencedFiles(folder, options.allow_outside), options.normals, read_.scene),
          ignores_colliders_(options.ignore_colliders),
          uses_colliders_(!options.ignore_colliders && !document.colliders.empty()),
          scene_node_(document.nodes.size(), no_index) {}

    Result<ReadScene> read();

private:
    std::string title(const Animation& animation) const;

    std::optional<Problem> read_nodes();
    std::optional<Problem> read_geometry(const Node& from, std::uint32_t index, SceneNode& node);
    std::optional<Problem> read_instances(const Node& from, std::uint32_t scene_node);
    std::optional<Problem> read_skins();
    Result<std::vector<double>> first_weights(const Node& node, std::uint32_t index);
    template <class Value, int N>
    Result<KeyTrack<Value>> read_track(const Sampler& sampler, const std::string& where);
    std::optional<Problem> read_animation(const Animation& animation);

    const Document& document_;
    ReadScene read_;
    GeometryReader geometries_;
    bool ignores_colliders_, uses_colliders_;
    std::vector<std::uint32_t> scene_node_;  // scene node of each document node
    std::size_t instances_ = 0;              // of all nodes so far
};

std::string SceneReader::title(const Animation& animation) const {
    const auto place = static_cast<std::size_t>(&animation - document_.animations.data());
    return animation.name.empty() ? "animation " + std::to_string(place) : "animation '" + animation.name + "'";
}

// The weights of the morph targets when the animation begins.
Result<std::vector<double>> SceneReader::first_weights(const Node& node, std::uint32_t index) {
    for (const Animation& animation : document_.animations)
        for (const Channel& channel : animation.channels) {
            if (channel.target != Target::weights || channel.node != index) continue;
            const Sampler& sampler = animation.samplers[channel.sampler];
            if (sampler.output == no_index || sampler.input == no_index) continue;
            Result<std::vector<double>> values = geometries_.data().numbers(sampler.output, 1);
            if (!values) return Problem{values.problem().code, title(animation) + ": " + values.problem().message};
            const std::uint64_t keys = document_.accessors[sampler.input].count;
            const std::size_t per_key = keys == 0 ? 0 : values->size() / keys;
            // A cubic key has a tangent before and after its value.
            const std::size_t targets = sampler.curve == Curve::cubic ? per_key / 3 : per_key;
            const std::size_t begin = sampler.curve == Curve::cubic ? targets : 0;
            if (targets == 0) continue;
            const auto first = values->begin() + static_cast<std::ptrdiff_t>(begin);
            return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(targets));
        }
    return node.weights.empty() ? document_.meshes[node.mesh].weights : node.weights;
}

// Adds what collides of a node: its collider if the file has any, else its mesh.
std::optional<Problem> SceneReader::read_geometry(const Node& from, std::uint32_t index, SceneNode& node) {
    if (uses_colliders_) {
        if (from.collider == no_index) return std::nullopt;
        Result<std::vector<std::uint32_t>> geometries = geometries_.collider(from.collider, index);
        if (!geometries) return geometries.problem();
        node.geometries = *std::move(geometries);
        return std::nullopt;
    }
    if (from.mesh == no_index || (from.no_collision && !ignores_colliders_)) return std::nullopt;
    if (from.skin != no_index) return std::nullopt;
    Result<std::vector<double>> weights = first_weights(from, index);
    if (!weights) return weights.problem();
    Result<std::vector<std::uint32_t>> geometries = geometries_.mesh(from.mesh, *weights);
    if (!geometries) return geometries.problem();
    node.geometries = *std::move(geometries);
    return std::nullopt;
}

// Gives each instance a node of its own below the node, which keeps none of its geometry.
std::optional<Problem> SceneReader::read_instances(const Node& from, std::uint32_t scene_node) {
    struct Attribute {
        std::uint32_t accessor, components;
        std::vector<double> values;
    };
    Attribute translations{from.instance_translations, 3, {}}, rotations{from.instance_rotations, 4, {}},
        scales{from.instance_scales, 3, {}};
    std::optional<std::size_t> count;
    for (Attribute* attribute : {&translations, &rotations, &scales}) {
        if (attribute->accessor == no_index) continue;
        Result<std::vector<double>> values = geometries_.data().numbers(attribute->accessor, attribute->components);
        if (!values) return values.problem();
        attribute->values = *std::move(values);
        const std::size_t own = attribute->values.size() / attribute->components;
        if (count && *count != own)
            return Problem{ProblemCode::bad_format,
                           "instances: " + std::to_string(*count) + " and " + std::to_string(own) + " of them"};
        count = own;
    }
    instances_ += count.value_or(0);
    if (instances_ > max_instances)
        return Problem{ProblemCode::too_large,
                       std::to_string(instances_) + " instances; the limit is " + std::to_string(max_instances)};
    const std::vector<std::uint32_t> geometries = std::exchange(read_.scene.nodes[scene_node].geometries, {});
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
        glm::dmat4 local(1.0);
        if (const double* t = translations.values.empty() ? nullptr : &translations.values[3 * i])
            local = glm::translate(local, glm::dvec3(t[0], t[1], t[2]));
        if (const double* q = rotations.values.empty() ? nullptr : &rotations.values[4 * i])
            local *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
        if (const double* s = scales.values.empty() ? nullptr : &scales.values[3 * i])
            local = glm::scale(local, glm::dvec3(s[0], s[1], s[2]));
        SceneNode node;
        node.name = "instance " + std::to_string(i);
        node.parent = scene_node;
        node.local = local;
        node.geometries = geometries;
        read_.scene.nodes.push_back(std::move(node));
    }
    return std::nullopt;
}

// Reads the geometry of skinned nodes, which `finish_scene` poses.
std::optional<Problem> SceneReader::read_skins() {
    if (uses_colliders_) return std::nullopt;
    for (std::uint32_t index = 0; index < document_.nodes.size(); ++index) {
        const Node& from = document_.nodes[index];
        const std::uint32_t node = scene_node_[index];
        if (from.skin == no_index || from.mesh == no_index || node == no_index ||
            (from.no_collision && !ignores_colliders_))
            continue;
        const std::string where = name_of(document_, index) + ": skin: ";
        detail::Skin skin;
        skin.node = node;
        for (const std::uint32_t joint : document_.skins[from.skin].joints) {
            skin.joints.push_back(scene_node_[joint]);
            if (skin.joints.back() == no_index)
                return Problem{ProblemCode::bad_format, where + name_of(document_, joint) + " is not in the scene"};
        }
        skin.inverse_binds.assign(skin.joints.size(), glm::dmat4(1.0));
        if (document_.skins[from.skin].inverse_bind != no_index) {
            const Result<std::vector<double>> numbers =
                geometries_.data().numbers(document_.skins[from.skin].inverse_bind, 16);
            if (!numbers) return Problem{numbers.problem().code, where + numbers.problem().message};
            if (numbers->size() < 16 * skin.joints.size())
                return Problem{ProblemCode::bad_format, where + "fewer matrices than joints"};
            for (std::size_t i = 0; i < 16 * skin.joints.size(); ++i)
                skin.inverse_binds[i / 16][static_cast<int>(i / 4 % 4)][static_cast<int>(i % 4)] = (*numbers)[i];
        }
        const Result<std::vector<double>> weights = first_weights(from, index);
        if (!weights) return weights.problem();
        Result<std::vector<std::pair<std::uint32_t, PointJoints>>> parts =
            geometries_.skinned_mesh(from.mesh, *weights);
        if (!parts) return parts.problem();
        for (const auto& [geometry, points] : *parts) {
            read_.scene.nodes[node].geometries.push_back(geometry);
            if (skin.joints.empty() || points.joints.empty()) continue;
            const std::size_t count = 4 * read_.scene.geometries[geometry].points.size();
            if (points.joints.size() != count || points.weights.size() != count)
                return Problem{ProblemCode::bad_format, where + "not one set of joints and weights per point"};
            skin.geometry = geometry;
            skin.influences.clear();
            for (std::size_t i = 0; i < points.joints.size(); ++i) {
                if (!(points.weights[i] > 0)) continue;
                if (points.joints[i] >= skin.joints.size())
                    return Problem{ProblemCode::index_out_of_range,
                                   where + "joint " + std::to_string(points.joints[i]) + " is out of range"};
                skin.influences.push_back({static_cast<std::uint32_t>(i / 4), points.joints[i], points.weights[i]});
            }
            read_.skins.push_back(skin);
        }
        geometries_.warn_once("skinned meshes are posed as at the first time, and move with the root of their joints");
    }
    return std::nullopt;
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
        node.local = local_matrix(from);
        const std::uint32_t own = static_cast<std::uint32_t>(read_.scene.nodes.size());
        node.is_body = from.is_body;
        if (std::optional<Problem> problem = read_geometry(from, index, node)) return problem;
        scene_node_[index] = own;
        for (auto child = from.children.rbegin(); child != from.children.rend(); ++child)
            stack.push_back({*child, own});
        read_.scene.nodes.push_back(std::move(node));
        if (!from.instanced) continue;
        if (std::optional<Problem> problem = read_instances(from, own))
            return Problem{problem->code, name_of(document_, index) + ": " + problem->message};
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
    Result<std::vector<double>> times = geometries_.data().numbers(sampler.input, 1);
    if (!times) return problem(times.problem());
    const Result<std::vector<double>> numbers = geometries_.data().numbers(sampler.output, N);
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
            geometries_.warn_once("morphed meshes keep the shape that they have at the first time");
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
    if (!animation.motions.empty()) read_.scene.animations.push_back(std::move(animation));
    return std::nullopt;
}

Result<ReadScene> SceneReader::read() {
    std::optional<Problem> problem = read_nodes();
    if (!problem) problem = read_skins();
    for (const Animation& animation : document_.animations)
        if (!problem) problem = read_animation(animation);
    if (problem) return *std::move(problem);
    read_.has_colliders = uses_colliders_;
    return std::move(read_);
}

}  // namespace

Result<ReadScene> read_gltf(const Document& document, const std::filesystem::path& folder, const ReadOptions& options) {
    return SceneReader(document, folder, options).read();
}

}  // namespace abut::gltf
