#pragma once

// The JSON document of a glTF file as plain structs, reduced to what collision detection needs.
// glTF 2.0 specification, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <abut/math/detail/no_index.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/vector_double3.hpp>

namespace abut::gltf {

struct Buffer {
    std::string uri;  ///< empty: the binary chunk of a .glb
    std::uint64_t length = 0;
};

struct BufferView {
    std::uint32_t buffer = detail::no_index;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::uint64_t stride = 0;                      ///< 0: tightly packed
    std::uint32_t compression = detail::no_index;  ///< index into Document::compressions
};

/// A buffer view that EXT_meshopt_compression replaces by `count` elements of `stride` bytes.
struct Compression {
    enum class Mode : std::uint8_t { attributes, triangles, indices };
    enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential };

    std::uint32_t buffer = detail::no_index;
    std::uint64_t offset = 0, length = 0;  ///< of the compressed bytes
    std::uint64_t stride = 0, count = 0;
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
};

struct Accessor {
    std::uint32_t view = detail::no_index;
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
    std::uint32_t component = 0;   ///< 5120..5126: the specification's component type
    std::uint32_t components = 0;  ///< 1 for SCALAR, 3 for VEC3, ...
    bool normalized = false;

    std::uint64_t sparse_count = 0;
    std::uint32_t sparse_indices_view = detail::no_index;
    std::uint64_t sparse_indices_offset = 0;
    std::uint32_t sparse_indices_component = 0;
    std::uint32_t sparse_values_view = detail::no_index;
    std::uint64_t sparse_values_offset = 0;
};

struct Primitive {
    std::uint32_t positions = detail::no_index;
    std::uint32_t normals = detail::no_index;
    std::uint32_t indices = detail::no_index;
    std::uint32_t joints = detail::no_index, weights = detail::no_index;  ///< the first set of four
    std::uint32_t mode = 4;
    std::vector<std::uint32_t> target_positions;  ///< per morph target; `no_index` for one without positions

    /// Compressed with KHR_draco_mesh_compression, and the ids of its attributes there.
    std::uint32_t draco_view = detail::no_index;
    std::uint32_t draco_positions = detail::no_index, draco_normals = detail::no_index;
    std::uint32_t draco_joints = detail::no_index, draco_weights = detail::no_index;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<double> weights;  ///< of the morph targets
};

struct Skin {
    std::vector<std::uint32_t> joints;              ///< nodes
    std::uint32_t inverse_bind = detail::no_index;  ///< accessor of matrices; `no_index`: identities
};

/// What a node collides by instead of its mesh: a primitive around its origin, with y as its axis, or a mesh.
struct Collider {
    enum class Form : std::uint8_t { box, sphere, capsule, cylinder, plane, mesh };

    Form form = Form::box;
    glm::dvec3 size{1.0};                          ///< of a box, and of a plane in x and z
    double radius_bottom = 0.5, radius_top = 0.5;  ///< the first one of a sphere
    double height = 1;                             ///< of a capsule between the centres of its ends
    std::uint32_t mesh = detail::no_index;         ///< of a mesh
    std::uint32_t node = detail::no_index;         ///< of a mesh: those of this node and below it
    bool convex = false;                           ///< the convex hull of the mesh
    bool fits_mesh = false;                        ///< a box or sphere around the points of the mesh
};

struct Node {
    std::string name;
    std::vector<std::uint32_t> children;
    std::uint32_t mesh = detail::no_index;
    std::uint32_t skin = detail::no_index;
    std::vector<double> weights;  ///< of the morph targets; empty: those of the mesh
    std::uint32_t collider = detail::no_index;
    bool is_body = false;       ///< a rigid body that has all nodes below it, up to other bodies
    bool no_collision = false;  ///< its mesh collides with nothing
    /// Drawn several times by EXT_mesh_gpu_instancing: the accessors of the instances.
    bool instanced = false;
    std::uint32_t instance_translations = detail::no_index, instance_rotations = detail::no_index,
                  instance_scales = detail::no_index;
    bool has_matrix = false;
    glm::dmat4 matrix{1.0};
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1.0};
};

enum class Target : std::uint8_t { translation, rotation, scale, weights };

struct Channel {
    std::uint32_t sampler = detail::no_index;
    std::uint32_t node = detail::no_index;
    Target target = Target::translation;
};

enum class Curve : std::uint8_t { linear, step, cubic };

struct Sampler {
    std::uint32_t input = detail::no_index;
    std::uint32_t output = detail::no_index;
    Curve curve = Curve::linear;
};

struct Animation {
    std::string name;
    std::vector<Channel> channels;
    std::vector<Sampler> samplers;
};

struct Document {
    int version = 2;  ///< 1 or 2; version 1 has only its node tree here
    std::vector<Buffer> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<Compression> compressions;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Collider> colliders;
    std::vector<Node> nodes;
    std::vector<std::uint32_t> roots;  ///< root nodes of the default scene
    std::vector<Animation> animations;
    std::vector<std::string> required_extensions;
    std::span<const std::byte> binary;  ///< the binary chunk of a .glb; a view into the parsed bytes
};

/// Parses the JSON of a .gltf, or the container and the JSON of a .glb, and validates the structure: container lengths,
/// types, index ranges, and that the nodes form a forest. `read_gltf` validates the contents of buffers.
Result<Document> parse(std::span<const std::byte> bytes, bool binary_container);

/// False for an extension that a file must not require here: it may change what collides, and this reader doesn't know
/// it. Extensions of materials, textures, lights, sounds and notes change nothing.
bool can_read_without_loss(const std::string& extension);

/// The node's name for a message, or its index.
std::string name_of(const Document& document, std::uint32_t node);

}  // namespace abut::gltf
