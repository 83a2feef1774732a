#pragma once

// Reads glTF 2.0 natively: duplicate node names, step and cubic interpolation and quantized positions are read exactly.

#include <abut/io/gltf/document.hpp>
#include <abut/io/mesh/finish_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <filesystem>

namespace abut::gltf {

/// True if `read_gltf` supports the document: version 2 without Draco compression.
bool is_supported(const Document& document);

/// Reads the default scene of a supported document. External buffers are read from `folder`; an empty folder makes them
/// a Problem. Values are not validated: `finish_scene` does that.
Result<Scene> read_gltf(const Document& document, const std::filesystem::path& folder, const ReadOptions& options);

}  // namespace abut::gltf
