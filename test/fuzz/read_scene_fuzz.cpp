// The scene reader on any bytes: a Scene that is safe to traverse, or a Problem with a message.
// Formats read by Assimp run only when the corpus is replayed, not when libFuzzer searches for new inputs: Assimp isn't
// ours, and its leaks and crashes (the tool runs it in a separate process) would be the only findings.

#include "bytes.hpp"
#include <abut/io/mesh/scene_bytes.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// Defined by libFuzzer; null in a program without it.
extern "C" __attribute__((weak)) int LLVMFuzzerRunDriver(int*, char***, int (*)(const std::uint8_t*, std::size_t));

namespace {

using namespace abut;
using namespace abut::detail;
using fuzz::require;

void check(const Result<Scene>& scene) {
    // Sent bytes arrive unchanged.
    const std::vector<std::byte> bytes = to_bytes(scene);
    const Result<Scene> received = scene_from_bytes(bytes);
    require(static_cast<bool>(received) == static_cast<bool>(scene));
    require(to_bytes(received) == bytes);
    if (!scene) {
        require(!scene.problem().message.empty());
        return;
    }
    // Every index is in range, every number is finite, and each node has its path.
    for (const Geometry& geometry : scene->geometries) {
        for (const Vec3& point : geometry.points) require(is_finite(point));
        for (const glm::uvec3& t : geometry.triangles)
            require(t.x < geometry.points.size() && t.y < geometry.points.size() && t.z < geometry.points.size());
    }
    std::vector<glm::dmat4> matrices;
    for (const double time : frame_times(*scene, 3)) world_matrices(*scene, time, matrices);
    require(!key_times(*scene).empty() && matrices.size() == scene->nodes.size());
    for (std::size_t i = 0; i < scene->nodes.size(); ++i)
        require(scene->nodes[i].geometries.empty() || !path(*scene, i).empty());
}

// The format is chosen by the first bytes, as in the corpus.
std::string_view extension_of(std::string_view text) {
    if (text.starts_with("glTF")) return ".glb";
    if (text.starts_with("{")) return ".gltf";
    if (text.starts_with("[gd_")) return ".tscn";
    if (text.starts_with("ply\n")) return ".ply";
    if (text.starts_with("solid ")) return ".stl";
    if (text.starts_with("# obj")) return ".obj";
    return {};
}

bool is_for_assimp(std::string_view extension) {
    return extension != ".glb" && extension != ".gltf" && extension != ".tscn";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
    const Result<Scene> sent = scene_from_bytes(bytes);
    if (sent) require(to_bytes(sent) == std::vector<std::byte>(bytes.begin(), bytes.end()));

    const std::string_view extension = extension_of({reinterpret_cast<const char*>(data), size});
    const bool is_fuzzing = LLVMFuzzerRunDriver != nullptr;
    if (extension.empty() || (is_fuzzing && is_for_assimp(extension))) return 0;
    check(read_scene(bytes, extension));
    return 0;
}
