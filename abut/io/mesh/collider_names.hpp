#pragma once

// Names by which exporters and engines say that a node is there to collide and not to be drawn.

#include <abut/io/scene.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace abut::detail {

/// What the name of a node means: a convex shape, or the mesh as it is.
enum class ColliderName : unsigned char { convex, mesh };

/// By Unreal's prefixes UCX_ UBX_ USP_ UCP_ (convex), or Godot's suffixes -col -colonly (mesh), -convcol and
/// -convcolonly (convex). Digits that a program adds to the end (".001", "_01") don't count.
std::optional<ColliderName> collider_name(std::string_view name);

/// The name of the object that a collider is a part of: "Crate" of "UCX_Crate_01" and "Crate-col".
std::string_view body_name(std::string_view name);

/// If any node with geometry has such a name, only those keep their geometry, convex ones as their hulls, with a
/// warning. Requires indices that are checked.
void select_colliders(Scene& scene);

}  // namespace abut::detail
