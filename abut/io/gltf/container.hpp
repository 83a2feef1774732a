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

/// True if the bytes begin with the magic number of a .glb.
bool is_container(std::span<const std::byte> bytes);

/// Splits a container into views of its chunks. Supports version 2 and the binary extension of version 1.
Result<Container> open_container(std::span<const std::byte> bytes);

}  // namespace abut::gltf
