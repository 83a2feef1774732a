#pragma once

// Every other format, through Assimp.

#include <abut/io/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace abut {

/// True where Assimp has a reader for files that end in this (".obj", with the dot).
bool assimp_knows(const std::string& extension);

/// As Assimp reads it, polygons cut into triangles. Numbers are taken as they are: what they mean is checked by
/// `finish_scene`; except triangles and polygons without area, which are looked for before polygons are cut.
/// Assimp has been seen to crash on mangled files: where that matters, call this in a process of its own.
Result<Scene> read_assimp(const std::filesystem::path& file, const ReadOptions& options);

/// The same from memory. `extension` names the format; files beside the scene can't be reached.
Result<Scene> read_assimp(std::span<const std::byte> bytes, const std::string& extension, const ReadOptions& options);

}  // namespace abut
