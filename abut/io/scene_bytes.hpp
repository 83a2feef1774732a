#pragma once

// A scene, or what is wrong with it, as bytes: for sending it from one process to another on the same machine.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

std::vector<std::byte> to_bytes(const Result<Scene>& scene);

/// The scene or the Problem that was sent; a Problem of its own (code `bad_format`) for bytes that `to_bytes` can't
/// have made. Checks lengths and that indices name something, so that a scene that comes through is safe to walk.
Result<Scene> scene_from_bytes(std::span<const std::byte> bytes);

}  // namespace abut
