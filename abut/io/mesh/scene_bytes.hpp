#pragma once

// Serialization of a scene or a Problem to bytes, for processes on one machine.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut::detail {

/// Serializes the scene, or the Problem in its place, in the byte order of this machine.
std::vector<std::byte> to_bytes(const Result<Scene>& scene);

/// The scene or Problem that `to_bytes` serialized. Returns a Problem of its own (`bad_format`) for bytes that
/// `to_bytes` can't have produced. All lengths and indices are checked, so that a scene returned is safe to traverse.
Result<Scene> scene_from_bytes(std::span<const std::byte> bytes);

}  // namespace abut::detail
