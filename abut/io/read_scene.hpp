#pragma once

// Reads 3D scenes from files.

#include <abut/io/mesh/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace abut {

/// Reads a scene: glTF 2.0 and Godot's .tscn natively, any other format through Assimp. Units and axes are those of the
/// file. Points and lines are left out and skinned meshes read in bind pose, both with a warning. Returns a Problem,
/// with the location in the file, for input that can't be read or used (see `detail::finish_scene`). The message
/// doesn't name the file.
Result<Scene> read_scene(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a scene from memory. `extension` names the format as a file's extension would (".glb"). Files that the scene
/// refers to are not read.
Result<Scene> read_scene(std::span<const std::byte> bytes, std::string_view extension, const ReadOptions& options = {});

}  // namespace abut
