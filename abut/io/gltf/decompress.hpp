#pragma once

// Decompression of glTF data by meshoptimizer and Draco.

#include <abut/io/gltf/document.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::gltf {

/// The elements of a view that EXT_meshopt_compression compresses.
Result<std::vector<std::byte>> decode_meshopt(const Compression& compression, std::span<const std::byte> bytes);

/// Decodes a mesh of KHR_draco_mesh_compression and returns its attributes with these ids: all numbers of all points,
/// `components` each, normalized integers as fractions. An attribute of the id `no_index` is empty.
struct DracoAttribute {
    std::uint32_t id;
    std::uint32_t components;
    bool is_normalized = false;
};
struct DracoMesh {
    std::vector<glm::uvec3> triangles;
    std::vector<std::vector<double>> attributes;
};
Result<DracoMesh> decode_draco(std::span<const std::byte> bytes, std::span<const DracoAttribute> attributes);

}  // namespace abut::gltf
