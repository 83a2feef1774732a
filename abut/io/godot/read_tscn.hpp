#pragma once

// Reads what collides in 3D scenes of Godot 4.

#include <abut/io/mesh/finish_scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <span>

namespace abut::godot {

/// Reads the collision shapes of bodies in a scene and in the scenes that it has instances of. Those are in the folder
/// of the file or below it, unless files outside are allowed; "res://" is the folder that has project.godot, or else
/// that of the file. Areas don't collide. What isn't read is named by a warning.
Result<detail::ReadScene> read_tscn(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                                    const ReadOptions& options);

}  // namespace abut::godot
