#pragma once

// Loads the input files of the verbs: scenes in 3D, levels in 2D.

#include "tool/objects/level_objects.hpp"
#include "tool/objects/scene_objects.hpp"
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

/// Options for reading a file.
struct FileOptions {
    bool strict = false;         ///< reject a file with a triangle of zero area
    bool allow_outside = false;  ///< allow references to files outside of its folder
    bool all_meshes = false;     ///< take the meshes that are drawn even where a file has colliders
    float scale = 1;             ///< of all lengths of a 3D scene
};

/// The dimension, 2 or 3, by the file's extension.
int dimension_of(const std::string& file);

/// The unit of a file's lengths: "m" for glTF, "px" for Tiled and SVG, else "file".
std::string units_of(const std::string& file);

/// Loads a scene or a level. The message of a Problem begins with the file.
template <int D>
Result<File<D>> load(const std::string& file, const FileOptions& options);

/// A hint for the message of a Problem: the option that permits the file; empty if there is none.
std::string hint(const Problem& problem);

/// Moves the objects to their first time, with a progress bar.
template <int D>
std::optional<Problem> build(Objects<D>& objects, double time) {
    Progress progress("building");
    return objects.go_to(time, progress);
}

/// Calls `run` with the file's dimension as an integral constant, for verbs that exist in 2D and 3D.
template <class Run>
auto in_dimension_of(const std::string& file, Run run) {
    if (dimension_of(file) == 2) return run(std::integral_constant<int, 2>());
    return run(std::integral_constant<int, 3>());
}

}  // namespace abut::tool
