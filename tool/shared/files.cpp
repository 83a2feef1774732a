#include "tool/shared/files.hpp"

#include "tool/shared/import_in_child.hpp"
#include "tool/shared/name_pattern.hpp"
#include "tool/shared/printable.hpp"
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/read_level.hpp>

#include <filesystem>
#include <utility>

#include <glm/ext/matrix_transform.hpp>

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

namespace {

// Puts all nodes below a new root without a name.
void scale(Scene& scene, double factor) {
    SceneNode root;
    root.local = glm::scale(glm::dmat4(1.0), glm::dvec3(factor));
    for (SceneNode& node : scene.nodes) node.parent = node.parent == SceneNode::no_parent ? 0 : node.parent + 1;
    scene.nodes.insert(scene.nodes.begin(), std::move(root));
    for (Animation& animation : scene.animations)
        for (NodeMotion& motion : animation.motions) ++motion.node;
    for (NodeLeftOut& left_out : scene.left_out) ++left_out.node;
}

}  // namespace

template <>
Result<Scene> load<3>(const std::string& file, const FileOptions& options) {
    if (!(options.scale > 0)) return Problem{ProblemCode::bad_argument, "--scale: must be a number above 0"};
    Result<Scene> scene = import_in_child(
        file,
        {.strict = options.strict, .allow_outside = options.allow_outside, .ignore_colliders = options.all_meshes},
        limits_for(file));
    if (scene) {
        make_printable(*scene);
        if (options.scale != 1) scale(*scene, static_cast<double>(options.scale));
        return scene;
    }
    const Problem& problem = scene.problem();
    return Problem{problem.code, file + ": " + problem.message + hint(problem)};
}

// Shapes without extent are left out of levels with a warning, so --strict has no effect.
template <>
Result<Level> load<2>(const std::string& file, const FileOptions& options) {
    Result<Level> level = read_level(file, {.allow_outside = options.allow_outside});
    if (options.scale != 1)
        return Problem{ProblemCode::bad_argument, file + ": is a 2D level; --scale is for 3D scenes"};
    if (level) {
        make_printable(*level);
        return level;
    }
    const Problem& problem = level.problem();
    return Problem{problem.code, file + ": " + problem.message + hint(problem)};
}

}  // namespace abut::tool
