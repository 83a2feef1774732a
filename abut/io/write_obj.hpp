#pragma once

// Writes meshes as Wavefront OBJ.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <span>
#include <string>

namespace abut {

/// Returns OBJ text: for each mesh an `o` line, its points (`v`, with the fewest digits that parse to the same floats)
/// and its triangles (`f`, indices from 1 across all meshes). Blanks and control characters in names become '_'; an
/// unnamed mesh is "part". Returns a Problem for meshes that can't be written (see `detail::problem_of`).
Result<std::string> write_obj(std::span<const Geometry> meshes);

}  // namespace abut
