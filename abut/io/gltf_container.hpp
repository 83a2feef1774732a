#pragma once

// The .glb container: a JSON chunk and a binary chunk behind a header of lengths.

#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace abut::gltf {

struct Container {
    std::string_view json;
    std::span<const std::byte> binary;
};

/// True for bytes that begin like a .glb.
bool is_container(std::span<const std::byte> bytes);

/// Views into the bytes given. Takes version 2 and the binary extension of version 1.
Result<Container> open_container(std::span<const std::byte> bytes);

}  // namespace abut::gltf
