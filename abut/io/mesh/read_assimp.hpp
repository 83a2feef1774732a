#pragma once

// Reads scenes in any format that Assimp supports.

#include <abut/io/mesh/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace abut::detail {

/// True if Assimp supports the extension (".obj", with the dot).
bool assimp_knows(const std::string& extension);

/// Reads a scene with polygons triangulated. Values are not validated: `finish_scene` does that. Only triangles and
/// polygons without area are checked here, before polygons are triangulated. Assimp has been seen to crash on damaged
/// files: read untrusted ones in a separate process.
Result<ReadScene> read_assimp(const std::filesystem::path& file, const ReadOptions& options);

/// Reads a scene from memory. `extension` names the format. Files that the scene refers to are not read.
Result<ReadScene> read_assimp(std::span<const std::byte> bytes, const std::string& extension,
                              const ReadOptions& options);

}  // namespace abut::detail
