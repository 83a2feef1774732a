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

/// An absent index.
struct Buffer {
    std::string uri;  ///< empty: the binary chunk of a .glb
    std::uint64_t length = 0;
};

struct BufferView {
    std::uint32_t buffer = detail::no_index;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::uint64_t stride = 0;  ///< 0: tightly packed
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
    std::uint32_t mode = 4;
    bool draco = false;  ///< compressed with KHR_draco_mesh_compression
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    bool morphs = false;
};

struct Node {
    std::string name;
    std::vector<std::uint32_t> children;
    std::uint32_t mesh = detail::no_index;
    bool skinned = false;
    bool instanced = false;  ///< drawn several times by EXT_mesh_gpu_instancing
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
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<std::uint32_t> roots;  ///< root nodes of the default scene
    std::vector<Animation> animations;
    std::vector<std::string> required_extensions;
    std::span<const std::byte> binary;  ///< the binary chunk of a .glb; a view into the parsed bytes
};

/// Parses the JSON of a .gltf, or the container and the JSON of a .glb, and validates the structure: container lengths,
/// types, index ranges, and that the nodes form a forest. `read_gltf` validates the contents of buffers.
Result<Document> parse(std::span<const std::byte> bytes, bool binary_container);

/// The node's name for a message, or its index.
std::string name_of(const Document& document, std::uint32_t node);

}  // namespace abut::gltf
