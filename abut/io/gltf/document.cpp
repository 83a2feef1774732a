#include <abut/io/file/parse_json-inl.h>
#include <abut/io/gltf/container.hpp>
#include <abut/io/gltf/document.hpp>
#include <abut/io/gltf/extensions-inl.h>
#include <abut/io/gltf/json-inl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/ext/quaternion_geometric.hpp>

namespace abut::gltf {
namespace {

using detail::no_index;

// Reads the JSON in one pass. Only the first error is recorded; invalid values are replaced by defaults until the end.
class DocumentReader : FieldReader {
public:
    explicit DocumentReader(const Json& root) : FieldReader(root) {}

    Result<Document> read(std::span<const std::byte> binary);

private:
    void read_version();
    void read_buffers();
    void read_accessors();
    void read_sparse(const Json& json, Accessor& accessor, const Where& where);
    void read_draco(const Json& json, Primitive& primitive, const Where& where);
    std::vector<double> number_list(const Json& json, const char* key, const Where& where);
    void read_meshes();
    void read_skins();
    void read_nodes();
    void read_version_1_nodes();
    void read_roots();
    void read_animations();
    void check_tree();

    Document document_;
    std::vector<std::uint32_t> parents_;
};

void DocumentReader::read_version() {
    const Json* asset = member(root_, "asset");
    const Json* version = asset == nullptr ? nullptr : member(*asset, "version");
    const Json* nodes = member(root_, "nodes");
    if (version != nullptr && version->is_string()) {
        const auto& number = version->get_ref<const std::string&>();
        if (number.starts_with("1."))
            document_.version = 1;
        else if (!number.starts_with("2."))
            fail(ProblemCode::bad_format, "glTF version " + number + " is unknown");
    } else if (nodes != nullptr && nodes->is_object()) {
        document_.version = 1;
    }
}

void DocumentReader::read_buffers() {
    each("buffers", [&](const Json& json, const Where& where) {
        Buffer buffer;
        buffer.length = unsigned_integer(json, "byteLength", 0, where);
        if (const Json* uri = member(json, "uri")) {
            if (uri->is_string())
                buffer.uri = uri->get<std::string>();
            else
                fail(where, "uri", "a string was expected");
        }
        document_.buffers.push_back(std::move(buffer));
    });
    each("bufferViews", [&](const Json& json, const Where& where) {
        BufferView view;
        view.buffer = index(json, "buffer", "buffers", where);
        view.offset = unsigned_integer(json, "byteOffset", 0, where);
        view.length = unsigned_integer(json, "byteLength", 0, where);
        view.stride = unsigned_integer(json, "byteStride", 0, where);
        document_.views.push_back(view);
    });
}

void DocumentReader::read_sparse(const Json& json, Accessor& accessor, const Where& where) {
    const Json* sparse = member(json, "sparse");
    if (sparse == nullptr) return;
    const Json* indices = member(*sparse, "indices");
    const Json* values = member(*sparse, "values");
    if (indices == nullptr || values == nullptr) return fail(where, "sparse", "indices or values are missing");
    accessor.sparse_count = unsigned_integer(*sparse, "count", 0, where);
    accessor.sparse_indices_view = index(*indices, "bufferView", "bufferViews", where);
    accessor.sparse_indices_offset = unsigned_integer(*indices, "byteOffset", 0, where);
    accessor.sparse_indices_component = type_number(*indices, "componentType", 0, where);
    accessor.sparse_values_view = index(*values, "bufferView", "bufferViews", where);
    accessor.sparse_values_offset = unsigned_integer(*values, "byteOffset", 0, where);
}

void DocumentReader::read_accessors() {
    static constexpr std::pair<std::string_view, std::uint32_t> types[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    each("accessors", [&](const Json& json, const Where& where) {
        Accessor accessor;
        accessor.view = index(json, "bufferView", "bufferViews", where);
        accessor.offset = unsigned_integer(json, "byteOffset", 0, where);
        accessor.count = unsigned_integer(json, "count", 0, where);
        accessor.component = type_number(json, "componentType", 0, where);
        if (const Json* normalized = member(json, "normalized"))
            accessor.normalized = normalized->is_boolean() && normalized->get<bool>();
        const Json* type = member(json, "type");
        if (type != nullptr && type->is_string())
            for (const auto& [name, components] : types)
                if (type->get_ref<const std::string&>() == name) accessor.components = components;
        read_sparse(json, accessor, where);
        document_.accessors.push_back(accessor);
    });
}

void DocumentReader::read_draco(const Json& json, Primitive& primitive, const Where& where) {
    primitive.draco_view = index(json, "bufferView", "bufferViews", where);
    const Json* attributes = member(json, "attributes");
    if (primitive.draco_view == no_index || attributes == nullptr)
        return fail(where, "KHR_draco_mesh_compression", "bufferView or attributes are missing");
    primitive.draco_positions = type_number(*attributes, "POSITION", no_index, where);
    primitive.draco_normals = type_number(*attributes, "NORMAL", no_index, where);
    primitive.draco_joints = type_number(*attributes, "JOINTS_0", no_index, where);
    primitive.draco_weights = type_number(*attributes, "WEIGHTS_0", no_index, where);
}

std::vector<double> DocumentReader::number_list(const Json& json, const char* key, const Where& where) {
    std::vector<double> result;
    each_member(json, key, where, [&](const Json& value) {
        if (!value.is_number()) return fail(where, key, "a number was expected");
        result.push_back(value.get<double>());
    });
    return result;
}

void DocumentReader::read_meshes() {
    each("meshes", [&](const Json& json, const Where& where) {
        Mesh mesh;
        mesh.name = name_in(json);
        each_member(json, "primitives", where, [&](const Json& part) {
            Primitive primitive;
            if (const Json* attributes = member(part, "attributes")) {
                primitive.positions = index(*attributes, "POSITION", "accessors", where);
                primitive.normals = index(*attributes, "NORMAL", "accessors", where);
                primitive.joints = index(*attributes, "JOINTS_0", "accessors", where);
                primitive.weights = index(*attributes, "WEIGHTS_0", "accessors", where);
            }
            primitive.indices = index(part, "indices", "accessors", where);
            primitive.mode = type_number(part, "mode", 4, where);
            if (const Json* draco = extension(part, "KHR_draco_mesh_compression")) read_draco(*draco, primitive, where);
            each_member(part, "targets", where, [&](const Json& target) {
                primitive.target_positions.push_back(index(target, "POSITION", "accessors", where));
            });
            mesh.primitives.push_back(std::move(primitive));
        });
        mesh.weights = number_list(json, "weights", where);
        document_.meshes.push_back(std::move(mesh));
    });
}

void DocumentReader::read_skins() {
    each("skins", [&](const Json& json, const Where& where) {
        Skin skin;
        skin.inverse_bind = index(json, "inverseBindMatrices", "accessors", where);
        each_member(json, "joints", where,
                    [&](const Json& joint) { skin.joints.push_back(index(joint, count("nodes"), where, "joints")); });
        document_.skins.push_back(std::move(skin));
    });
}

void DocumentReader::read_nodes() {
    each("nodes", [&](const Json& json, const Where& where) {
        Node node;
        node.name = name_in(json);
        node.mesh = index(json, "mesh", "meshes", where);
        node.skin = index(json, "skin", "skins", where);
        node.weights = number_list(json, "weights", where);
        each_member(json, "children", where, [&](const Json& child) {
            node.children.push_back(index(child, count("nodes"), where, "children"));
        });
        double m[16];
        node.has_matrix = numbers(json, "matrix", m, where);
        if (node.has_matrix)
            for (int i = 0; i < 16; ++i) node.matrix[i / 4][i % 4] = m[i];
        double v[3];
        if (numbers(json, "translation", v, where)) node.translation = {v[0], v[1], v[2]};
        if (numbers(json, "scale", v, where)) node.scale = {v[0], v[1], v[2]};
        double q[4];
        if (numbers(json, "rotation", q, where)) node.rotation = glm::dquat(q[3], q[0], q[1], q[2]);
        document_.nodes.push_back(std::move(node));
    });
}

// Version 1 refers to objects by name and not by index.
void DocumentReader::read_version_1_nodes() {
    const Json* nodes = member(root_, "nodes");
    if (nodes == nullptr || !nodes->is_object()) return;
    std::map<std::string, std::uint32_t> numbers_of;
    for (const auto& [key, value] : nodes->items())
        numbers_of.emplace(key, static_cast<std::uint32_t>(numbers_of.size()));
    for (const auto& [key, value] : nodes->items()) {
        Node node;
        node.name = key;
        const Where where{"nodes", document_.nodes.size()};
        each_member(value, "children", where, [&](const Json& child) {
            const auto found = child.is_string() ? numbers_of.find(child.get<std::string>()) : numbers_of.end();
            if (found == numbers_of.end()) return fail(where, "children", "there is no such node");
            node.children.push_back(found->second);
        });
        document_.nodes.push_back(std::move(node));
    }
}

void DocumentReader::read_animations() {
    each("animations", [&](const Json& json, const Where& where) {
        Animation animation;
        animation.name = name_in(json);
        each_member(json, "samplers", where, [&](const Json& part) {
            Sampler sampler;
            sampler.input = index(part, "input", "accessors", where);
            sampler.output = index(part, "output", "accessors", where);
            const Json* curve = member(part, "interpolation");
            if (curve != nullptr && *curve == "STEP") sampler.curve = Curve::step;
            if (curve != nullptr && *curve == "CUBICSPLINE") sampler.curve = Curve::cubic;
            animation.samplers.push_back(sampler);
        });
        each_member(json, "channels", where, [&](const Json& part) {
            const Json* target = member(part, "target");
            const Json* sampler = member(part, "sampler");
            const Json* path = target == nullptr ? nullptr : member(*target, "path");
            if (sampler == nullptr || path == nullptr) return fail(where, "channels", "sampler or target is missing");
            Channel channel;
            channel.sampler = index(*sampler, animation.samplers.size(), where, "channels");
            channel.node = index(*target, "node", "nodes", where);
            if (*path == "translation")
                channel.target = Target::translation;
            else if (*path == "rotation")
                channel.target = Target::rotation;
            else if (*path == "scale")
                channel.target = Target::scale;
            else
                channel.target = Target::weights;
            animation.channels.push_back(channel);
        });
        document_.animations.push_back(std::move(animation));
    });
}

// Verifies that the nodes form a forest.
void DocumentReader::check_tree() {
    const std::vector<Node>& nodes = document_.nodes;
    parents_.assign(nodes.size(), no_index);
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
        for (const std::uint32_t child : nodes[i].children) {
            if (parents_[child] != no_index)
                return fail(ProblemCode::bad_format, "node tree: " + name_of(document_, child) + " has two parents, " +
                                                         name_of(document_, parents_[child]) + " and " +
                                                         name_of(document_, i));
            parents_[child] = i;
        }
    // Every node has at max_exact one parent, so what can't be reached from a root goes round in a unvisited.
    std::vector<std::uint32_t> stack;
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
        if (parents_[i] == no_index) stack.push_back(i);
    std::vector<bool> seen(nodes.size(), false);
    while (!stack.empty()) {
        const std::uint32_t node = stack.back();
        stack.pop_back();
        seen[node] = true;
        stack.insert(stack.end(), nodes[node].children.begin(), nodes[node].children.end());
    }
    const auto unvisited = std::find(seen.begin(), seen.end(), false);
    if (unvisited != seen.end())
        fail(ProblemCode::bad_format,
             "node tree: " + name_of(document_, static_cast<std::uint32_t>(unvisited - seen.begin())) +
                 " is part of a cycle");
}

// Collects the roots of the default scene. A node listed together with one of its ancestors is no root.
void DocumentReader::read_roots() {
    std::vector<bool> listed(document_.nodes.size(), false);
    const Json* scenes = member(root_, "scenes");
    if (scenes == nullptr || scenes->empty()) {
        for (std::size_t i = 0; i < listed.size(); ++i) listed[i] = parents_[i] == no_index;
    } else {
        const Json* scene = member(root_, "scene");
        const std::size_t number = scene == nullptr ? 0 : index(*scene, scenes->size(), {"scene", 0}, "scene");
        std::size_t i = 0;
        each("scenes", [&](const Json& json, const Where& where) {
            if (i++ != number) return;
            each_member(json, "nodes", where, [&](const Json& node) {
                const std::uint32_t root = index(node, listed.size(), where, "nodes");
                if (root != no_index) listed[root] = true;
            });
        });
    }
    // Whether a node is shown, because it or an ancestor is listed. Each node is visited once, however deep the tree.
    enum class Shown : std::uint8_t { unknown, no, yes };
    std::vector<Shown> shown(listed.size(), Shown::unknown);
    std::vector<std::uint32_t> path;
    const auto is_shown = [&](std::uint32_t node) {
        for (; node != no_index && shown[node] == Shown::unknown; node = parents_[node]) path.push_back(node);
        Shown found = node == no_index ? Shown::no : shown[node];
        for (; !path.empty(); path.pop_back()) {
            if (listed[path.back()]) found = Shown::yes;
            shown[path.back()] = found;
        }
        return found == Shown::yes;
    };
    for (std::uint32_t i = 0; i < listed.size(); ++i)
        if (listed[i] && !is_shown(parents_[i])) document_.roots.push_back(i);
}

Result<Document> DocumentReader::read(std::span<const std::byte> binary) {
    document_.binary = binary;
    read_version();
    if (document_.version == 1) {
        read_version_1_nodes();
        if (!problem_) check_tree();
    } else {
        const Json* required = member(root_, "extensionsRequired");
        if (required != nullptr && required->is_array())
            for (const Json& extension : *required)
                if (extension.is_string()) document_.required_extensions.push_back(extension.get<std::string>());
        read_buffers();
        read_accessors();
        read_meshes();
        read_skins();
        read_nodes();
        read_animations();
        if (!problem_) problem_ = read_extensions(root_, document_);
        if (!problem_) check_tree();
        if (!problem_) read_roots();
    }
    if (problem_) return *problem_;
    return std::move(document_);
}

}  // namespace

Result<Document> parse(std::span<const std::byte> bytes, bool binary_container) {
    Container container{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
    if (binary_container) {
        const Result<Container> opened = open_container(bytes);
        if (!opened) return opened.problem();
        container = *opened;
    }
    while (!container.json.empty() && container.json.back() == '\0') container.json.remove_suffix(1);
    const Result<Json> json = detail::parse_json(container.json);
    if (!json) return json.problem();
    if (!json->is_object()) return Problem{ProblemCode::bad_format, "JSON: an object was expected"};
    return DocumentReader(*json).read(container.binary);
}

std::string name_of(const Document& document, std::uint32_t node) {
    const std::string& name = document.nodes[node].name;
    return name.empty() ? "node " + std::to_string(node) : "node '" + name + "'";
}

}  // namespace abut::gltf
