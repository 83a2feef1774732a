#include "files.hpp"

#include "import_in_child.hpp"
#include <abut/io/read_level.hpp>

namespace abut::tool {

int dimension_of(const std::string& file) {
    return is_level(file) ? 2 : 3;
}

template <>
Result<Scene> load<3>(const std::string& file, bool skip_degenerate) {
    Result<Scene> scene = import_in_child(file, {.skip_degenerate = skip_degenerate}, limits_for(file));
    if (scene) return scene;
    Problem problem = scene.problem();
    problem.message = file + ": " + problem.message;
    if (problem.code == ProblemCode::degenerate) problem.message += " (--skip-degenerate leaves such triangles out)";
    return problem;
}

// What has no extent is left out of levels in any case, and told.
template <>
Result<Level> load<2>(const std::string& file, bool) {
    Result<Level> level = read_level(file);
    if (level) return level;
    return Problem{level.problem().code, file + ": " + level.problem().message};
}

}  // namespace abut::tool
