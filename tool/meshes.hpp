#pragma once

// The meshes that verbs read and write.

#include "files.hpp"
#include <abut/io/placed_meshes.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::tool {

/// The objects of a scene at its first moment, as triangles in the world; with all that was warned of.
using Meshes = PlacedMeshes;

/// A Problem, its message beginning with the file, for what can't be read, levels of the plane, and where nothing is
/// left. Triangles without area and objects that are scaled to nothing are left out, with a warning.
Result<Meshes> load_meshes(const std::string& file, const FileOptions& options);

/// The file's name without its folder and ending: for what has no name of its own.
std::string name_of(const std::string& file);

/// What is wrong with a file that meshes shall be written to, before any work is done.
std::optional<Problem> check_output(const std::string& output, const std::string& input);

/// Writes them; the message of a Problem begins with the file.
std::optional<Problem> write_output(const std::string& output, std::span<const Geometry> meshes);

}  // namespace abut::tool
