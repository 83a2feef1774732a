#pragma once

// Meshes to files: what abut::bake makes, for whatever comes next in the pipeline.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/polyhedron.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace abut {

/// A convex part as a mesh: its corners, and its faces cut into triangles, counter-clockwise seen from outside. Of a
/// segment or a point it has no triangles, and can't be written.
Geometry mesh_of(const Polyhedron& polyhedron, std::string name = {});

/// What makes meshes impossible to write: there are none (`empty_input`), one has no triangles (`empty_input`), a
/// coordinate that isn't finite (`not_finite`), a corner that isn't there (`index_out_of_range`). The index is the
/// mesh's.
std::optional<Problem> problem_of(std::span<const Geometry> meshes);

/// Whether `write_meshes` knows the format that a name ends in: .gltf, .glb or .obj, in capitals or not.
bool can_write_meshes(const std::filesystem::path& file);

/// Writes a file in the format that its name ends in (see `write_gltf`, `write_glb`, `write_obj`), whole or not at all
/// (see `write_file`). A Problem for meshes that can't be written, for a name with another ending (`bad_argument`), and
/// where the file can't be written (`unreadable`); its message doesn't name the file.
std::optional<Problem> write_meshes(const std::filesystem::path& file, std::span<const Geometry> meshes);

}  // namespace abut
