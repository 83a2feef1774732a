#include "verbs.hpp"

#include "import_in_child.hpp"

#include <cstdio>

namespace abut::tool {

Result<Scene> load(const std::string& file, bool skip_degenerate) {
    Result<Scene> scene = import_in_child(file, {.skip_degenerate = skip_degenerate}, limits_for(file));
    if (scene) return scene;
    Problem problem = scene.problem();
    problem.message = file + ": " + problem.message;
    if (problem.code == ProblemCode::degenerate) problem.message += " (--skip-degenerate leaves such triangles out)";
    return problem;
}

std::optional<Problem> build(Objects& objects, double time) {
    Progress progress("building");
    return objects.go_to(time, progress);
}

Result<ExitCode> print(const std::string& text, ExitCode code) {
    const bool done = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!done) return Problem{ProblemCode::unreadable, "the report can't be written"};
    return code;
}

}  // namespace abut::tool
