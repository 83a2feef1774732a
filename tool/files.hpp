#pragma once

// The files that verbs are about: scenes in 3D, levels in 2D.

#include "level_objects.hpp"
#include "scene_objects.hpp"
#include <abut/io/level.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <string>
#include <type_traits>

namespace abut::tool {

template <int D>
using File = std::conditional_t<D == 2, Level, Scene>;
template <int D>
using ObjectsOf = std::conditional_t<D == 2, LevelObjects, SceneObjects>;

/// How a file is read, by what was typed.
struct FileOptions {
    bool strict = false;         ///< a triangle of zero area refuses the file
    bool allow_outside = false;  ///< files that it refers to may be outside of its folder
};

/// 2 or 3, by the file's name.
int dimension_of(const std::string& file);

/// A scene or a level as the verbs want it; the message of a Problem begins with the file.
template <int D>
Result<File<D>> load(const std::string& file, const FileOptions& options);

/// What has to be said of a Problem of reading a file: what permits it.
std::string hint(const Problem& problem);

/// Takes the objects to the first moment that is asked about, with a bar where that takes long.
template <int D>
std::optional<Problem> build(Objects<D>& objects, double time) {
    Progress progress("building");
    return objects.go_to(time, progress);
}

/// For a verb that is the same in 2D and 3D: calls run with the dimension, as an integral constant.
template <class Run>
auto in_dimension_of(const std::string& file, Run run) {
    if (dimension_of(file) == 2) return run(std::integral_constant<int, 2>());
    return run(std::integral_constant<int, 3>());
}

}  // namespace abut::tool
