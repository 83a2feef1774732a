#include <abut/io/file/read_file.hpp>
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/file/scanner.hpp>
#include <abut/io/gltf/container.hpp>
#include <abut/io/gltf/document.hpp>
#include <abut/io/gltf/read_gltf.hpp>
#include <abut/io/godot/read_tscn.hpp>
#include <abut/io/mesh/read_assimp.hpp>
#include <abut/io/read_scene.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut {
namespace {

using detail::ReadScene;

constexpr std::string_view godot_extension = ".tscn";

// Refuses what a file requires and this reader doesn't know.
std::optional<Problem> check_extensions(const gltf::Document& document) {
    for (const std::string& extension : document.required_extensions)
        if (!gltf::can_read_without_loss(extension))
            return Problem{ProblemCode::bad_format, "requires the extension " + detail::quoted_name(extension) +
                                                        ", which abut doesn't know: export without it"};
    return std::nullopt;
}

// Returns nothing for other formats, which Assimp reads.
std::optional<Result<ReadScene>> read_natively(std::span<const std::byte> bytes, const std::string& extension,
                                               const std::filesystem::path& folder, const ReadOptions& options) {
    if (extension == godot_extension && options.ignore_colliders)
        return Problem{ProblemCode::bad_argument, "of a scene of Godot only its colliders are read"};
    if (extension == godot_extension) return godot::read_tscn(bytes, folder, options);
    if (extension != ".gltf" && extension != ".glb") return std::nullopt;
    const bool binary = extension == ".glb" || gltf::is_container(bytes);
    const Result<gltf::Document> document = gltf::parse(bytes, binary);
    if (!document) return document.problem();
    if (document->version == 1)
        return Problem{ProblemCode::bad_format,
                       "is glTF 1.0, which was replaced in 2017 and is not read: export it as glTF 2.0"};
    if (const std::optional<Problem> problem = check_extensions(*document)) return *problem;
    return gltf::read_gltf(*document, folder, options);
}

std::optional<Problem> check_format(std::span<const std::byte> bytes, const std::string& extension) {
    if (bytes.empty()) return Problem{ProblemCode::empty_input, "is empty"};
    if (extension == ".usd" || extension == ".usda" || extension == ".usdc" || extension == ".usdz")
        return Problem{ProblemCode::bad_format, "is USD, which abut doesn't read: export it as glTF (.glb)"};
    if (extension != godot_extension && !detail::assimp_knows(extension))
        return Problem{ProblemCode::bad_format, extension.empty() ? "has no ending that names a format"
                                                                  : "'" + extension + "' is not a known scene format"};
    return std::nullopt;
}

Result<Scene> finished(Result<ReadScene> scene, const ReadOptions& options) {
    if (!scene) return scene.problem();
    return detail::finish_scene(*std::move(scene), options);
}

}  // namespace

Result<Scene> read_scene(const std::filesystem::path& file, const ReadOptions& options) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(file);
    if (!bytes) return bytes.problem();
    const std::string extension = detail::lower_case(file.extension().string());
    if (const std::optional<Problem> problem = check_format(*bytes, extension)) return *problem;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    std::optional<Result<ReadScene>> scene = read_natively(*bytes, extension, folder, options);
    return finished(scene ? *std::move(scene) : detail::read_assimp(file, options), options);
}

Result<Scene> read_scene(std::span<const std::byte> bytes, std::string_view extension, const ReadOptions& options) {
    const std::string ending = detail::lower_case(std::string(extension));
    if (const std::optional<Problem> problem = check_format(bytes, ending)) return *problem;
    std::optional<Result<ReadScene>> scene = read_natively(bytes, ending, {}, options);
    return finished(scene ? *std::move(scene) : detail::read_assimp(bytes, ending, options), options);
}

}  // namespace abut
