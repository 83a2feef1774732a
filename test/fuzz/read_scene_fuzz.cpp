// The scene reader on any bytes: a Scene that is safe to walk or a Problem with a message, and nothing else.
// glTF is read by this library's own code. The other formats of the corpus go through Assimp, which isn't instrumented
// and does crash on some bytes (the tool gives it a process of its own), so they are read only where they are whole.

#include <abut/io/gltf_container.hpp>
#include <abut/io/gltf_document.hpp>
#include <abut/io/read_gltf.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/scene_bytes.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

namespace {

using namespace abut;

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool looks_for_new = true;
#else
constexpr bool looks_for_new = false;
#endif

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const Result<Scene>& scene) {
    // What is sent comes through.
    const std::vector<std::byte> bytes = to_bytes(scene);
    const Result<Scene> received = scene_from_bytes(bytes);
    require(static_cast<bool>(received) == static_cast<bool>(scene));
    require(to_bytes(received) == bytes);
    if (!scene) {
        require(!scene.problem().message.empty());
        return;
    }
    // Every index names something, every number is one, and each node has its path.
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

// By the first bytes, as the corpus has them.
std::string_view extension_of(std::string_view text) {
    if (text.starts_with("glTF")) return ".glb";
    if (text.starts_with("{")) return ".gltf";
    if (text.starts_with("ply\n")) return ".ply";
    if (text.starts_with("solid ")) return ".stl";
    if (text.starts_with("# obj")) return ".obj";
    return {};
}

bool is_for_assimp(std::span<const std::byte> bytes, std::string_view extension) {
    if (extension != ".glb" && extension != ".gltf") return true;
    const Result<gltf::Document> document = gltf::parse(bytes, gltf::is_container(bytes));
    return document && !gltf::is_plain(*document);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
    const Result<Scene> sent = scene_from_bytes(bytes);
    if (sent) require(to_bytes(sent) == std::vector<std::byte>(bytes.begin(), bytes.end()));

    const std::string_view extension = extension_of({reinterpret_cast<const char*>(data), size});
    if (extension.empty() || (looks_for_new && is_for_assimp(bytes, extension))) return 0;
    check(read_scene(bytes, extension));
    return 0;
}
