#pragma once

// Meshes as Wavefront OBJ.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <span>
#include <string>

namespace abut {

/// Text with an `o` line for each mesh, its points (`v`, as few digits as bring back the same floats) and triangles
/// (`f`, counted from 1 over all meshes). In names, whatever would end the line or start another word becomes '_'; one
/// without a name is "part". A Problem for meshes that can't be written (see `problem_of`).
Result<std::string> write_obj(std::span<const Geometry> meshes);

}  // namespace abut
