#include <abut/io/file/base64.hpp>
#include <abut/io/write_gltf.hpp>
#include <abut/io/write_mesh.hpp>
#include <abut/math/aabb.hpp>

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace abut {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the specification.
enum Number : std::uint32_t {
    float_component = 5126,
    index_component = 5125,
    array_buffer = 34962,
    element_array_buffer = 34963,
    triangle_list = 4
};

void append_uint32(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(word >> shift & 0xff));
}

void append_padded(std::vector<std::byte>& bytes, std::span<const std::byte> more, char padding) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    while (bytes.size() % 4 != 0) bytes.push_back(static_cast<std::byte>(padding));
}

Json as_json(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

/// A glTF document, and the bytes of its buffer.
struct GltfBuilder {
    Json json;
    std::vector<std::byte> buffer;

    /// Adds a buffer view of the bytes appended since `begin`, and returns its index.
    std::size_t add_view(std::size_t begin, Number target) {
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", buffer.size() - begin}, {"target", target}});
        return json["bufferViews"].size() - 1;
    }

    std::size_t add_accessor(Json accessor) {
        json["accessors"].push_back(std::move(accessor));
        return json["accessors"].size() - 1;
    }

    std::size_t add_points(const Geometry& mesh) {
        const std::size_t begin = buffer.size();
        Aabb3 box = Aabb3::empty();
        for (const Vec3& point : mesh.points) {
            box = merged(box, Aabb3{point, point});
            for (int i = 0; i < 3; ++i) append_uint32(buffer, std::bit_cast<std::uint32_t>(point[i]));
        }
        return add_accessor({{"bufferView", add_view(begin, array_buffer)},
                             {"componentType", float_component},
                             {"count", mesh.points.size()},
                             {"type", "VEC3"},
                             {"min", as_json(box.min)},
                             {"max", as_json(box.max)}});
    }

    std::size_t add_indices(const Geometry& mesh) {
        const std::size_t begin = buffer.size();
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int i = 0; i < 3; ++i) append_uint32(buffer, triangle[i]);
        return add_accessor({{"bufferView", add_view(begin, element_array_buffer)},
                             {"componentType", index_component},
                             {"count", 3 * mesh.triangles.size()},
                             {"type", "SCALAR"}});
    }

    void add_mesh(const Geometry& mesh) {
        const std::size_t points = add_points(mesh), indices = add_indices(mesh);
        const std::size_t number = json["meshes"].size();
        json["scenes"][0]["nodes"].push_back(number);
        json["nodes"].push_back({{"name", mesh.name}, {"mesh", number}});
        const Json primitive = {{"attributes", {{"POSITION", points}}}, {"indices", indices}, {"mode", triangle_list}};
        json["meshes"].push_back({{"name", mesh.name}, {"primitives", Json::array({primitive})}});
    }
};

Result<GltfBuilder> build(std::span<const Geometry> meshes) {
    if (std::optional<Problem> problem = detail::problem_of(meshes)) return *std::move(problem);
    std::size_t size = 0;
    for (const Geometry& mesh : meshes) size += 12 * (mesh.points.size() + mesh.triangles.size());
    // Leaves room for the JSON beside the buffer.
    if (size > std::numeric_limits<std::uint32_t>::max() / 2)
        return Problem{ProblemCode::too_large, "the meshes are larger than 2 GiB, the limit of this glTF writer"};
    GltfBuilder builder;
    builder.json["asset"] = {{"version", "2.0"}, {"generator", "abut"}};
    builder.json["scene"] = 0;
    builder.json["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews"}) builder.json[list] = Json::array();
    builder.buffer.reserve(size);
    for (const Geometry& mesh : meshes) builder.add_mesh(mesh);
    builder.json["buffers"] = Json::array({{{"byteLength", builder.buffer.size()}}});
    return builder;
}

std::string to_text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Result<std::string> write_gltf(std::span<const Geometry> meshes) {
    Result<GltfBuilder> builder = build(meshes);
    if (!builder) return builder.problem();
    builder->json["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + detail::encode_base64(builder->buffer);
    return to_text(builder->json) + "\n";
}

Result<std::vector<std::byte>> write_glb(std::span<const Geometry> meshes) {
    const Result<GltfBuilder> builder = build(meshes);
    if (!builder) return builder.problem();
    constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    std::vector<std::byte> json;
    const std::string text = to_text(builder->json);
    append_padded(json, std::as_bytes(std::span(text)), ' ');
    std::vector<std::byte> bytes;
    const auto size_of = [](std::span<const std::byte> chunk) { return static_cast<std::uint32_t>(chunk.size()); };
    for (const std::uint32_t word :
         {magic, version, 28 + size_of(json) + size_of(builder->buffer), size_of(json), json_chunk})
        append_uint32(bytes, word);
    append_padded(bytes, json, ' ');
    append_uint32(bytes, size_of(builder->buffer));
    append_uint32(bytes, binary_chunk);
    append_padded(bytes, builder->buffer, '\0');
    return bytes;
}

}  // namespace abut
