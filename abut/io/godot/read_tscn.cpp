#include <abut/io/file/referenced_files.hpp>
#include <abut/io/godot/read_tscn.hpp>
#include <abut/io/godot/scene_text.hpp>
#include <abut/io/godot/shapes.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace abut::godot {
namespace {

/// Limits on scenes that have instances of one another.
constexpr int max_depth = 64;
constexpr std::size_t max_nodes = std::size_t{1} << 20;

std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_body(std::string_view type) {
    return type.ends_with("Body3D") || type == "PhysicalBone3D";
}
bool is_true(const Value* value) {
    return value != nullptr && value->text == "true";
}

/// Transform3D(xx, xy, xz, yx, ...): the rows of the matrix, then the origin. Or else, in files that are written
/// by hand, the position, the rotation about y, x and z, and the scale.
std::optional<glm::dmat4> transform(const Section& node) {
    const Value* const value = node.property("transform");
    if (value == nullptr || value->numbers.size() != 12) {
        const auto position = node.vector("position"), rotation = node.vector("rotation"), scale = node.vector("scale");
        if (!position && !rotation && !scale) return std::nullopt;
        glm::dmat4 parts = glm::translate(glm::dmat4(1.0), position.value_or(glm::dvec3(0)));
        for (const int axis : {1, 0, 2}) {
            glm::dvec3 about(0);
            about[axis] = 1;
            if (rotation) parts = glm::rotate(parts, (*rotation)[axis], about);
        }
        return glm::scale(parts, scale.value_or(glm::dvec3(1)));
    }
    glm::dmat4 result(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            result[column][row] = value->numbers[static_cast<std::size_t>(3 * row + column)];
        result[3][row] = value->numbers[static_cast<std::size_t>(9 + row)];
    }
    return result;
}

/// The folder that "res://" stands for.
std::filesystem::path project_of(const std::filesystem::path& folder) {
    std::error_code error;
    const std::filesystem::path start = std::filesystem::absolute(folder, error);
    for (std::filesystem::path at = start; !error; at = at.parent_path()) {
        if (std::filesystem::exists(at / "project.godot", error)) return at;
        if (at == at.parent_path()) break;
    }
    return start;
}

class SceneTree {
public:
    SceneTree(const std::filesystem::path& folder, const ReadOptions& options)
        : folder_(folder),
          project_(folder.empty() ? folder : project_of(folder)),
          files_(folder, options.allow_outside) {}

    Result<detail::ReadScene> read(std::span<const std::byte> bytes) {
        const Result<File*> file = parse_file("", bytes);
        if (!file) return file.problem();
        const Result<std::uint32_t> root = add_scene(**file, {});
        if (!root) return root.problem();
        for (std::size_t i = 0; i < nodes_.size(); ++i) take_shape(i);
        const auto collides = [](const SceneNode& node) { return !node.geometries.empty(); };
        if (std::none_of(read_.scene.nodes.begin(), read_.scene.nodes.end(), collides))
            return Problem{ProblemCode::empty_input, is_flat_ ? "is a 2D scene of Godot; 3D ones are read"
                                                              : "has no collision shape of a body in space"};
        add_warning(files_left_out_, "instance", "of other files than .tscn");
        add_warning(shapes_left_out_, "shape", "that abut can't read");
        add_warning(strays_, "collision shape", "below no body and no area");
        return std::move(read_);
    }

private:
    /// What a node of the scene is in Godot.
    struct Node {
        std::string type;
        std::optional<std::uint32_t> geometry;
        bool disabled = false;
    };
    /// A file, which may have many instances.
    struct File {
        std::string folder;  ///< of its name, with a '/'; names in the file are relative to it
        std::vector<Section> sections;
        std::map<std::string, const Section*, std::less<>> own, others;  ///< its resources, and those of other files
        std::map<std::string, std::optional<std::uint32_t>> shapes;      ///< indices of geometries
    };
    /// Where an instance of a file is in the scene.
    struct Place {
        std::uint32_t parent = SceneNode::no_parent;
        std::string name = {};  ///< that its root gets; empty: the root's own
        int depth = 0;
    };

    Result<File*> parse_file(const std::string& name, std::span<const std::byte> bytes) {
        Result<std::vector<Section>> sections = parse(text_of(bytes));
        if (!sections) return sections.problem();
        if (sections->empty() || sections->front().kind != "gd_scene")
            return Problem{ProblemCode::bad_format, "is no scene of Godot"};
        const auto format = sections->front().attributes.find("format");
        if (format == sections->front().attributes.end() || format->second.numbers.empty() ||
            format->second.numbers[0] < 3)
            return Problem{ProblemCode::bad_format, "is a scene of Godot 3 or earlier: save it with Godot 4"};
        File& file = files_by_name_[name];
        file.folder = name.substr(0, name.rfind('/') + 1);
        file.sections = *std::move(sections);
        for (const Section& section : file.sections) {
            if (section.kind == "sub_resource") file.own.emplace(section.attribute("id"), &section);
            if (section.kind == "ext_resource") file.others.emplace(section.attribute("id"), &section);
        }
        return &file;
    }

    /// Adds an instance of a file, and returns its root.
    Result<std::uint32_t> add_scene(File& file, const Place& place) {
        std::optional<std::uint32_t> root;
        for (const Section& section : file.sections) {
            if (section.kind != "node") continue;
            std::optional<Problem> problem = add_node(section, place, file, root);
            if (problem && !is_located_)
                problem->message = "line " + std::to_string(section.line) + ": " + problem->message;
            if (problem) return *std::move(problem);
        }
        if (!root) return Problem{ProblemCode::empty_input, "has no node"};
        return *root;
    }

    /// The node at a path from a root, "." or names joined by '/'.
    std::optional<std::uint32_t> find(std::uint32_t root, std::string_view path) const {
        for (std::size_t begin = 0; path != "." && begin <= path.size();) {
            const std::size_t end = std::min(path.size(), path.find('/', begin));
            const auto child = children_.find({root, std::string(path.substr(begin, end - begin))});
            if (child == children_.end()) return std::nullopt;
            root = child->second;
            begin = end + 1;
        }
        return root;
    }

    std::optional<Problem> add_node(const Section& section, const Place& place, File& file,
                                    std::optional<std::uint32_t>& root) {
        const bool is_root = !root;
        Place own{place.parent, std::string(section.attribute("name")), place.depth + 1};
        if (is_root && !place.name.empty()) own.name = place.name;
        if (!is_root) {
            const std::optional<std::uint32_t> parent = find(*root, section.attribute("parent"));
            if (!parent) return std::nullopt;  // it is in a file that isn't read
            own.parent = *parent;
        }
        const auto known = children_.find({own.parent, own.name});
        std::optional<std::uint32_t> node;
        if (!is_root && known != children_.end()) node = known->second;
        const auto instance = section.attributes.find("instance");
        if (instance != section.attributes.end()) {
            const Result<std::optional<std::uint32_t>> added = add_instance(instance->second.text, own, file);
            if (!added) return added.problem();
            node = *added;
        }
        if (!node) {
            if (instance == section.attributes.end() && section.attribute("type").empty()) return std::nullopt;
            if (nodes_.size() == max_nodes)
                return Problem{ProblemCode::too_large, "more than " + std::to_string(max_nodes) + " nodes"};
            node = static_cast<std::uint32_t>(nodes_.size());
            SceneNode& added = read_.scene.nodes.emplace_back();
            added.name = own.name;
            added.parent = own.parent;
            nodes_.emplace_back();
            children_.emplace(std::pair(own.parent, own.name), *node);
        }
        if (is_root) root = node;
        set(section, file, *node);
        return std::nullopt;
    }

    /// Adds an instance of a scene, and returns its root; nothing if the file is of another kind.
    Result<std::optional<std::uint32_t>> add_instance(const std::string& id, const Place& place, const File& of) {
        const auto found = of.others.find(id);
        if (found == of.others.end()) return Problem{ProblemCode::bad_format, "has an instance of no resource"};
        const std::string name = name_of(*found->second, of);
        if (!name.ends_with(".tscn")) {
            files_left_out_.push_back(name);
            return std::optional<std::uint32_t>();
        }
        if (place.depth > max_depth)
            return Problem{ProblemCode::too_large,
                           "instances in one another, more than " + std::to_string(max_depth) + " deep"};
        auto file = files_by_name_.find(name);
        if (file == files_by_name_.end()) {
            const Result<std::vector<std::byte>> bytes = bytes_of(name);
            if (!bytes) return Problem{bytes.problem().code, detail::quoted_name(name) + " " + bytes.problem().message};
            if (const Result<File*> parsed = parse_file(name, *bytes); !parsed)
                return Problem{parsed.problem().code, detail::quoted_name(name) + ": " + parsed.problem().message};
            file = files_by_name_.find(name);
        }
        const Result<std::uint32_t> root = add_scene(file->second, place);
        if (root) return std::optional(*root);
        const bool was_located = std::exchange(is_located_, true);
        return was_located ? root.problem()
                           : Problem{root.problem().code, detail::quoted_name(name) + ": " + root.problem().message};
    }

    /// Sets what a section says of a node, which may be one of an instance.
    void set(const Section& section, File& file, std::uint32_t index) {
        SceneNode& node = read_.scene.nodes[index];
        Node& own = nodes_[index];
        if (const std::string_view type = section.attribute("type"); !type.empty()) {
            own.type = type;
            node.is_body = is_body(type);
            is_flat_ = is_flat_ || type.ends_with("2D");
            if (type == "CollisionPolygon3D" || type == "GridMap" || type.starts_with("CSG"))
                shapes_left_out_.push_back(node.name);
        }
        if (const std::optional<glm::dmat4> local = transform(section)) node.local = *local;
        if (const Value* const disabled = section.property("disabled")) own.disabled = is_true(disabled);
        if (const Value* const shape = section.property("shape")) own.geometry = geometry(*shape, file);
    }

    /// The mesh of SubResource("id") or ExtResource("id").
    std::optional<std::uint32_t> geometry(const Value& reference, File& file) {
        if (reference.name != "SubResource" && reference.name != "ExtResource") return std::nullopt;
        const auto [known, is_new] = file.shapes.try_emplace(reference.name + reference.text);
        if (!is_new) return known->second;
        std::optional<Geometry> mesh =
            reference.name == "SubResource" ? own_mesh(reference.text, file) : mesh_of_file(reference.text, file);
        if (!mesh) {
            shapes_left_out_.push_back(reference.text);
            return std::nullopt;
        }
        mesh->name = reference.text;
        known->second = static_cast<std::uint32_t>(read_.scene.geometries.size());
        read_.scene.geometries.push_back(*std::move(mesh));
        return known->second;
    }
    static std::optional<Geometry> own_mesh(const std::string& id, const File& file) {
        const auto found = file.own.find(id);
        if (found == file.own.end()) return std::nullopt;
        return mesh_of_shape(found->second->attribute("type"), *found->second);
    }
    std::optional<Geometry> mesh_of_file(const std::string& id, const File& file) const {
        const auto found = file.others.find(id);
        if (found == file.others.end()) return std::nullopt;
        const Result<std::vector<std::byte>> bytes = bytes_of(name_of(*found->second, file));
        if (!bytes) return std::nullopt;
        const Result<std::vector<Section>> sections = parse(text_of(*bytes));
        if (!sections || sections->empty() || sections->back().kind != "resource") return std::nullopt;
        return mesh_of_shape(sections->front().attribute("type"), sections->back());
    }

    /// The name of a resource of another file, from the folder of the scene that is read.
    static std::string name_of(const Section& resource, const File& file) {
        const std::string_view name = resource.attribute("path");
        const bool is_absolute = name.starts_with('/') || name.find("://") != std::string_view::npos;
        return (is_absolute ? std::string() : file.folder) + std::string(name);
    }

    Result<std::vector<std::byte>> bytes_of(const std::string& name) const {
        constexpr std::string_view scheme = "res://";
        if (!name.starts_with(scheme) || folder_.empty()) return files_.bytes(name);
        std::error_code error;
        const std::filesystem::path here = std::filesystem::absolute(folder_, error);
        return files_.bytes((project_ / name.substr(scheme.size())).lexically_relative(here).generic_string());
    }

    /// Gives a collision shape's node its mesh, if it is one of a body.
    void take_shape(std::size_t index) {
        SceneNode& node = read_.scene.nodes[index];
        const Node& own = nodes_[index];
        if (own.type != "CollisionShape3D" || own.disabled || !own.geometry) return;
        const std::string_view above =
            node.parent == SceneNode::no_parent ? std::string_view() : std::string_view(nodes_[node.parent].type);
        if (is_body(above))
            node.geometries = {*own.geometry};
        else if (above != "Area3D")
            strays_.push_back(node.name);
    }

    void add_warning(const std::vector<std::string>& names, const std::string& what, const char* which) {
        if (names.empty()) return;
        const bool is_one = names.size() == 1;
        read_.scene.warnings.push_back(std::to_string(names.size()) + " " + what + (is_one ? " " : "s ") + which +
                                       (is_one ? " is" : " are") + " left out, such as " +
                                       detail::quoted_name(names.front()));
    }

    std::filesystem::path folder_, project_;
    detail::ReferencedFiles files_;
    detail::ReadScene read_{.scene = {}, .skins = {}, .has_colliders = true};
    std::vector<Node> nodes_;                                                  ///< of the scene's nodes
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> children_;  ///< by parent and name
    std::map<std::string, File> files_by_name_;
    std::vector<std::string> files_left_out_, shapes_left_out_, strays_;
    bool is_flat_ = false;     ///< it has nodes of 2D
    bool is_located_ = false;  ///< a problem names its file
};

}  // namespace

Result<detail::ReadScene> read_tscn(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                                    const ReadOptions& options) {
    return SceneTree(folder, options).read(bytes);
}

}  // namespace abut::godot
