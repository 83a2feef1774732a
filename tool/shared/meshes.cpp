#include "tool/shared/meshes.hpp"

#include <abut/io/write_mesh.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

namespace abut::tool {

Result<Meshes> load_meshes(const std::string& file, const FileOptions& options) {
    if (dimension_of(file) == 2) return Problem{ProblemCode::bad_argument, file + ": is a 2D level, and has no meshes"};
    Result<Scene> scene = load<3>(file, options);
    if (!scene) return scene.problem();
    Result<detail::PlacedMeshes> placed = detail::placed_meshes(*scene);
    if (!placed) return Problem{placed.problem().code, file + ": " + placed.problem().message};
    Meshes result{std::move(placed->objects), std::move(scene->warnings)};
    for (std::string& warning : placed->warnings) result.warnings.push_back(std::move(warning));
    return result;
}

std::string name_of(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

std::optional<Problem> check_output(const std::string& output, const std::string& input) {
    if (!can_write_meshes(output))
        return Problem{ProblemCode::bad_argument, output + ": doesn't end in .gltf, .glb or .obj"};
    std::error_code ignored;
    if (std::filesystem::equivalent(output, input, ignored))
        return Problem{ProblemCode::bad_argument, output + ": is the mesh itself, and would be overwritten"};
    return std::nullopt;
}

std::optional<Problem> write_output(const std::string& output, std::span<const Geometry> meshes) {
    std::optional<Problem> problem = write_meshes(output, meshes);
    if (problem) problem->message = output + ": " + problem->message;
    return problem;
}

}  // namespace abut::tool
