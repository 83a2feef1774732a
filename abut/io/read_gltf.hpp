#pragma once

// glTF 2.0 to Scene, without an importer in between: node names that are there twice, stepped and cubic animation and
// quantized positions come through as the file means them.

#include <abut/io/finish_scene.hpp>
#include <abut/io/gltf_document.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <filesystem>

namespace abut::gltf {

/// True where `read_gltf` can do it: version 2, no triangles compressed with Draco.
bool is_plain(const Document& document);

/// The scene that the document shows, for a plain document. Buffers in files are looked for in `folder`; where it is
/// empty they are a Problem. Numbers are taken as they are: what they mean is checked by `finish_scene`.
Result<Scene> read_gltf(const Document& document, const std::filesystem::path& folder, const ReadOptions& options);

}  // namespace abut::gltf
