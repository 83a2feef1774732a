#include <abut/io/base64.hpp>
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

// Numbers of the specification.
enum Number : std::uint32_t {
    float_component = 5126,
    index_component = 5125,
    array_buffer = 34962,
    element_array_buffer = 34963,
    triangle_list = 4
};

void add_word(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(word >> shift & 0xff));
}

void add_padded(std::vector<std::byte>& bytes, std::span<const std::byte> more, char padding) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    while (bytes.size() % 4 != 0) bytes.push_back(static_cast<std::byte>(padding));
}

Json as_json(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

/// The document without its buffer's bytes, and those.
struct Parts {
    Json json;
    std::vector<std::byte> buffer;

    /// The number of a new view of what was added to the buffer since `begin`.
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
            for (int i = 0; i < 3; ++i) add_word(buffer, std::bit_cast<std::uint32_t>(point[i]));
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
            for (int i = 0; i < 3; ++i) add_word(buffer, triangle[i]);
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

Result<Parts> parts_of(std::span<const Geometry> meshes) {
    if (std::optional<Problem> problem = problem_of(meshes)) return *std::move(problem);
    std::size_t size = 0;
    for (const Geometry& mesh : meshes) size += 12 * (mesh.points.size() + mesh.triangles.size());
    // With room for what is said about it.
    if (size > std::numeric_limits<std::uint32_t>::max() / 2)
        return Problem{ProblemCode::too_large, "glTF has room for 2 GiB of meshes"};
    Parts parts;
    parts.json["asset"] = {{"version", "2.0"}, {"generator", "abut"}};
    parts.json["scene"] = 0;
    parts.json["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews"}) parts.json[list] = Json::array();
    parts.buffer.reserve(size);
    for (const Geometry& mesh : meshes) parts.add_mesh(mesh);
    parts.json["buffers"] = Json::array({{{"byteLength", parts.buffer.size()}}});
    return parts;
}

std::string dumped(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Result<std::string> write_gltf(std::span<const Geometry> meshes) {
    Result<Parts> parts = parts_of(meshes);
    if (!parts) return parts.problem();
    parts->json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + encode_base64(parts->buffer);
    return dumped(parts->json) + "\n";
}

Result<std::vector<std::byte>> write_glb(std::span<const Geometry> meshes) {
    const Result<Parts> parts = parts_of(meshes);
    if (!parts) return parts.problem();
    constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    std::vector<std::byte> json;
    const std::string text = dumped(parts->json);
    add_padded(json, std::as_bytes(std::span(text)), ' ');
    std::vector<std::byte> bytes;
    const auto size_of = [](std::span<const std::byte> chunk) { return static_cast<std::uint32_t>(chunk.size()); };
    for (const std::uint32_t word :
         {magic, version, 28 + size_of(json) + size_of(parts->buffer), size_of(json), json_chunk})
        add_word(bytes, word);
    add_padded(bytes, json, ' ');
    add_word(bytes, size_of(parts->buffer));
    add_word(bytes, binary_chunk);
    add_padded(bytes, parts->buffer, '\0');
    return bytes;
}

}  // namespace abut
