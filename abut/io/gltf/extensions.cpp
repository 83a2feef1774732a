#include <abut/io/gltf/extensions-inl.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string_view>

namespace abut::gltf {
namespace {

using detail::no_index;

constexpr const char *khr_shapes = "KHR_implicit_shapes", *khr_bodies = "KHR_physics_rigid_bodies",
                     *omi_shapes = "OMI_physics_shape", *omi_bodies = "OMI_physics_body",
                     *omi_colliders = "OMI_collider";
constexpr std::array meshopt_names = {"EXT_meshopt_compression", "KHR_meshopt_compression", "MESHOPT_compression"};

bool is_true(const Json* value) {
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

class ExtensionReader : FieldReader {
public:
    ExtensionReader(const Json& root, Document& document) : FieldReader(root), document_(document) {}

    std::optional<Problem> read();

private:
    void read_compressions();
    void read_compression(const Json& json, std::uint32_t view, const Where& where);
    std::vector<Collider> read_shapes(const char* name, const char* array, bool has_total_height);
    Collider read_shape(const Json& json, const Where& where, bool has_total_height);
    void read_node(const Json& json, const Where& where);
    void read_body(const Json& json, const std::vector<Collider>& shapes, Node& node, const Where& where);
    void read_instances(const Json& json, Node& node, const Where& where);
    /// Of an existing collider of OMI_collider.
    bool is_trigger(std::uint32_t number) const {
        return is_true(member((*member(*extension(root_, omi_colliders), "colliders"))[number], "isTrigger"));
    }
    void read_extras(const Json& json, Node& node, const Where& where);
    void add_collider(Node& node, const Collider& collider) {
        node.collider = static_cast<std::uint32_t>(document_.colliders.size());
        document_.colliders.push_back(collider);
    }

    Document& document_;
    std::vector<Collider> khr_, omi_, old_omi_;
};

void ExtensionReader::read_compressions() {
    std::uint32_t view = 0;
    each("bufferViews", [&](const Json& json, const Where& where) {
        for (const char* name : meshopt_names)
            if (const Json* found = extension(json, name)) read_compression(*found, view, where);
        ++view;
    });
}

void ExtensionReader::read_compression(const Json& json, std::uint32_t view, const Where& where) {
    Compression compression;
    compression.buffer = index(json, "buffer", "buffers", where);
    compression.offset = unsigned_integer(json, "byteOffset", 0, where);
    compression.length = unsigned_integer(json, "byteLength", 0, where);
    compression.stride = unsigned_integer(json, "byteStride", 0, where);
    compression.count = unsigned_integer(json, "count", 0, where);
    const Json* mode = member(json, "mode");
    if (mode != nullptr && *mode == "TRIANGLES")
        compression.mode = Compression::Mode::triangles;
    else if (mode != nullptr && *mode == "INDICES")
        compression.mode = Compression::Mode::indices;
    else if (mode == nullptr || *mode != "ATTRIBUTES")
        fail(where, "mode", "ATTRIBUTES, TRIANGLES or INDICES was expected");
    const Json* filter = member(json, "filter");
    if (filter != nullptr && *filter == "OCTAHEDRAL")
        compression.filter = Compression::Filter::octahedral;
    else if (filter != nullptr && *filter == "QUATERNION")
        compression.filter = Compression::Filter::quaternion;
    else if (filter != nullptr && *filter == "EXPONENTIAL")
        compression.filter = Compression::Filter::exponential;
    else if (filter != nullptr && *filter != "NONE")
        fail(where, "filter", "NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL was expected");
    document_.views[view].compression = static_cast<std::uint32_t>(document_.compressions.size());
    document_.compressions.push_back(compression);
}

// The shapes of an extension of the root. The height of an old capsule includes its ends.
std::vector<Collider> ExtensionReader::read_shapes(const char* name, const char* array, bool has_total_height) {
    std::vector<Collider> result;
    if (const Json* found = extension(root_, name))
        each_of(*found, array, [&](const Json& json, const Where& where) {
            result.push_back(read_shape(json, where, has_total_height));
        });
    return result;
}

Collider ExtensionReader::read_shape(const Json& json, const Where& where, bool has_total_height) {
    static const std::map<std::string, Collider::Form, std::less<>> forms{
        {"box", Collider::Form::box},         {"sphere", Collider::Form::sphere},
        {"capsule", Collider::Form::capsule}, {"cylinder", Collider::Form::cylinder},
        {"plane", Collider::Form::plane},     {"convex", Collider::Form::mesh},
        {"hull", Collider::Form::mesh},       {"trimesh", Collider::Form::mesh},
        {"mesh", Collider::Form::mesh},
    };
    Collider result;
    const Json* type = member(json, "type");
    const auto form =
        type != nullptr && type->is_string() ? forms.find(type->get_ref<const std::string&>()) : forms.end();
    if (form == forms.end()) {
        fail(where, "type", "a known shape was expected");
        return result;
    }
    result.form = form->second;
    result.convex = form->first == "convex" || form->first == "hull";
    // In all but the oldest extension the numbers are in an object of the type's name.
    const Json* own = member(json, form->first.c_str());
    const Json& from = own != nullptr && own->is_object() ? *own : json;
    double size[3] = {1, 1, 1};
    numbers(from, "size", size, where);
    result.size = {size[0], size[1], size[2]};
    if (result.form == Collider::Form::plane)
        result.size = {number(from, "sizeX", std::numeric_limits<double>::infinity(), where), 0,
                       number(from, "sizeZ", std::numeric_limits<double>::infinity(), where)};
    const double radius = number(from, "radius", 0.5, where);
    result.radius_bottom = number(from, "radiusBottom", radius, where);
    result.radius_top = number(from, "radiusTop", radius, where);
    const bool is_capsule = result.form == Collider::Form::capsule;
    has_total_height = has_total_height || member(from, "radius") != nullptr;
    result.height = number(from, "height", is_capsule && !has_total_height ? 1 : 2, where);
    if (is_capsule && has_total_height) result.height -= result.radius_bottom + result.radius_top;
    result.mesh = index(from, "mesh", "meshes", where);
    const bool is_positive = result.size.x > 0 && result.size.z > 0 && result.radius_bottom >= 0 &&
                             result.radius_top >= 0 && result.radius_bottom + result.radius_top > 0 &&
                             (result.height > 0 || is_capsule);
    if (!is_positive) fail(where, form->first.c_str(), "a size above zero was expected");
    if (result.form == Collider::Form::mesh && result.mesh == no_index)
        fail(where, form->first.c_str(), "a mesh was expected");
    result.height = std::max(result.height, 0.0);
    return result;
}

// KHR_physics_rigid_bodies, or OMI_physics_body, which has the shape in the collider itself.
void ExtensionReader::read_body(const Json& json, const std::vector<Collider>& shapes, Node& node, const Where& where) {
    if (member(json, "motion") != nullptr) node.is_body = true;
    const Json* collider = member(json, "collider");
    if (collider == nullptr) {
        // A trigger reports what is in it, and nothing collides with it.
        node.no_collision = node.no_collision || member(json, "trigger") != nullptr;
        return;
    }
    const Json* geometry = member(*collider, "geometry");
    const Json& from = geometry != nullptr ? *geometry : *collider;
    const Json* shape = member(from, "shape");
    const bool has_shape = shape != nullptr && !(shape->is_number_integer() && *shape == -1);
    Collider result;
    result.form = Collider::Form::mesh;
    result.convex = is_true(member(from, "convexHull"));
    if (has_shape) {
        const std::uint32_t number = index(*shape, shapes.size(), where, "shape");
        if (number == no_index) return;
        result = shapes[number];
    } else {
        result.mesh = index(from, "mesh", "meshes", where);
        result.node = index(from, "node", "nodes", where);
        if (result.mesh == no_index && result.node == no_index) return;
    }
    add_collider(node, result);
}

void ExtensionReader::read_instances(const Json& json, Node& node, const Where& where) {
    const Json* attributes = member(json, "attributes");
    if (attributes == nullptr) return;
    node.instanced = true;
    node.instance_translations = index(*attributes, "TRANSLATION", "accessors", where);
    node.instance_rotations = index(*attributes, "ROTATION", "accessors", where);
    node.instance_scales = index(*attributes, "SCALE", "accessors", where);
}

// A node's own word on how its mesh collides, as exporters write custom properties.
void ExtensionReader::read_extras(const Json& json, Node& node, const Where& where) {
    const Json* extras = member(json, "extras");
    const Json* collision = extras == nullptr ? nullptr : member(*extras, "collision");
    if (collision == nullptr || node.mesh == no_index || node.collider != no_index) return;
    if (collision->is_boolean()) {
        node.no_collision = node.no_collision || !collision->get<bool>();
        return;
    }
    Collider result;
    result.form = Collider::Form::mesh;
    result.mesh = node.mesh;
    if (*collision == "none") {
        node.no_collision = true;
        return;
    }
    if (*collision == "convex")
        result.convex = true;
    else if (*collision == "box" || *collision == "sphere") {
        result.form = *collision == "box" ? Collider::Form::box : Collider::Form::sphere;
        result.fits_mesh = true;
    } else if (*collision != "mesh")
        return fail(where, "extras.collision", "none, mesh, convex, box or sphere was expected");
    add_collider(node, result);
}

void ExtensionReader::read_node(const Json& json, const Where& where) {
    Node& node = document_.nodes[where.index];
    if (const Json* found = extension(json, "EXT_mesh_gpu_instancing")) read_instances(*found, node, where);
    if (const Json* found = extension(json, khr_bodies)) read_body(*found, khr_, node, where);
    if (const Json* found = extension(json, omi_bodies)) read_body(*found, omi_, node, where);
    if (const Json* found = extension(json, omi_colliders)) {
        const std::uint32_t number = index(*found, "collider", old_omi_.size(), where);
        if (number != no_index && is_trigger(number))
            node.no_collision = true;
        else if (number != no_index)
            add_collider(node, old_omi_[number]);
    }
    read_extras(json, node, where);
}

std::optional<Problem> ExtensionReader::read() {
    read_compressions();
    khr_ = read_shapes(khr_shapes, "shapes", false);
    omi_ = read_shapes(omi_shapes, "shapes", false);
    old_omi_ = read_shapes(omi_colliders, "colliders", true);
    if (!problem_) each("nodes", [&](const Json& json, const Where& where) { read_node(json, where); });
    return std::move(problem_);
}

}  // namespace

std::optional<Problem> read_extensions(const Json& root, Document& document) {
    return ExtensionReader(root, document).read();
}

bool can_read_without_loss(const std::string& name) {
    static constexpr std::array known = {"KHR_draco_mesh_compression",
                                         "KHR_mesh_quantization",
                                         "EXT_mesh_gpu_instancing",
                                         khr_shapes,
                                         khr_bodies,
                                         omi_shapes,
                                         omi_bodies,
                                         omi_colliders};
    const auto is_name = [&](const char* other) { return name == other; };
    if (std::any_of(known.begin(), known.end(), is_name) ||
        std::any_of(meshopt_names.begin(), meshopt_names.end(), is_name))
        return true;
    // What follows the vendor says what the extension is about.
    const std::string_view about = std::string_view(name).substr(std::min(name.size(), name.find('_') + 1));
    constexpr std::array<std::string_view, 18> harmless = {"materials",     "texture_",      "light",
                                                           "audio",         "emitter",       "xmp",
                                                           "technique",     "physics_joint", "physics_gravity",
                                                           "interactivity", "mesh_features", "structural_metadata",
                                                           "spawn_point",   "seat",          "link",
                                                           "personality",   "environment",   "node_selectability"};
    return name == "VRMC_vrm" || std::any_of(harmless.begin(), harmless.end(),
                                             [&](std::string_view word) { return about.starts_with(word); });
}

}  // namespace abut::gltf
