#pragma once

// A scene from a file: the front door of abut::io.

#include <abut/io/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace abut {

/// Reads a scene: glTF 2.0 by this library itself, anything else by Assimp. Lengths stay in the file's units, axes as
/// they are. Points and lines are left out, skinned meshes taken in bind pose, both with a warning in the scene.
/// A Problem, with what is wrong and where in the file, for whatever can't be read or used (see `finish_scene`); its
/// message doesn't name the file.
Result<Scene> read_scene(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same from memory. `extension` names the format as the end of a file's name would (".glb"); files that a scene
/// refers to can't be reached.
Result<Scene> read_scene(std::span<const std::byte> bytes, std::string_view extension, const ReadOptions& options = {});

}  // namespace abut
