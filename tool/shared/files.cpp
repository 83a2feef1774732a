#include "tool/shared/files.hpp"

#include "tool/shared/import_in_child.hpp"
#include "tool/shared/name_pattern.hpp"
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/read_level.hpp>

#include <filesystem>

namespace abut::tool {

int dimension_of(const std::string& file) {
    return is_level(file) ? 2 : 3;
}

std::string units_of(const std::string& file) {
    if (is_level(file)) return "px";
    const std::string extension = lower_case(std::filesystem::path(file).extension().string());
    return extension == ".gltf" || extension == ".glb" ? "m" : "file";
}

std::string hint(const Problem& problem) {
    if (problem.code == ProblemCode::degenerate) return " (without --strict such triangles are left out)";
    return detail::is_outside(problem) ? " (--allow-outside permits that)" : "";
}

template <>
Result<Scene> load<3>(const std::string& file, const FileOptions& options) {
    Result<Scene> scene =
        import_in_child(file, {.strict = options.strict, .allow_outside = options.allow_outside}, limits_for(file));
    if (scene) return scene;
    const Problem& problem = scene.problem();
    return Problem{problem.code, file + ": " + problem.message + hint(problem)};
}

// Shapes without extent are left out of levels with a warning, so --strict has no effect.
template <>
Result<Level> load<2>(const std::string& file, const FileOptions& options) {
    Result<Level> level = read_level(file, {.allow_outside = options.allow_outside});
    if (level) return level;
    const Problem& problem = level.problem();
    return Problem{problem.code, file + ": " + problem.message + hint(problem)};
}

}  // namespace abut::tool
