#pragma once

// The collision shapes of Godot as meshes.

#include <abut/io/godot/scene_text.hpp>
#include <abut/io/scene.hpp>

#include <optional>

namespace abut::godot {

/// The mesh of a resource of this type, such as BoxShape3D; nothing if it has none or its numbers don't make one.
std::optional<Geometry> mesh_of_shape(std::string_view type, const Section& resource);

}  // namespace abut::godot
