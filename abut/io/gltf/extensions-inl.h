#pragma once

// Extensions of glTF that change what collides. Included by document.cpp and extensions.cpp only.

#include <abut/io/gltf/document.hpp>
#include <abut/io/gltf/json-inl.h>
#include <abut/math/result.hpp>

#include <optional>

namespace abut::gltf {

/// Adds to a document that is read otherwise: compressed buffer views, instances, and colliders by
/// KHR_physics_rigid_bodies, OMI_physics_body, OMI_collider, or the key `collision` of a node's extras.
std::optional<Problem> read_extensions(const Json& root, Document& document);

}  // namespace abut::gltf
