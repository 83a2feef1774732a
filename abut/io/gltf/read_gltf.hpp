#pragma once

// Reads glTF 2.0 natively: duplicate node names, step and cubic interpolation and quantized positions are read exactly.

#include <abut/io/gltf/document.hpp>
#include <abut/io/mesh/finish_scene.hpp>
#include <abut/math/result.hpp>

#include <filesystem>

namespace abut::gltf {

/// Reads the default scene of a document of version 2. External buffers are read from `folder`; an empty folder makes
/// them a Problem. Values are not validated: `finish_scene` does that.
Result<detail::ReadScene> read_gltf(const Document& document, const std::filesystem::path& folder,
                                    const ReadOptions& options);

}  // namespace abut::gltf
