#pragma once

// Reads and writes the meshes of the verbs.

#include "tool/shared/files.hpp"
#include <abut/io/mesh/placed_meshes.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::tool {

/// The objects of a scene at its first time as triangle meshes in world space, with all warnings.
using Meshes = detail::PlacedMeshes;

/// Loads a scene as meshes. Returns a Problem, whose message begins with the file, if it can't be read, is a 2D level,
/// or has no triangles left. Triangles of zero area and objects scaled to a point are left out with a warning.
Result<Meshes> load_meshes(const std::string& file, const FileOptions& options);

/// The file's name without folder and extension, for meshes without a name.
std::string name_of(const std::string& file);

/// Checks the name of an output file before any work is done.
std::optional<Problem> check_output(const std::string& output, const std::string& input);

/// Writes the meshes. The message of a Problem begins with the file.
std::optional<Problem> write_output(const std::string& output, std::span<const Geometry> meshes);

}  // namespace abut::tool
