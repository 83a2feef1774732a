#pragma once

// Writes meshes to files, for the next step of an asset pipeline.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/polyhedron.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace abut {

/// Converts a polyhedron to a mesh: its vertices, and its faces triangulated, counter-clockwise seen from outside. A
/// segment or a point gives a mesh without triangles, which can't be written.
Geometry mesh_of(const Polyhedron& polyhedron, std::string name = {});

/// True if `write_meshes` supports the file's extension, in any case: .gltf, .glb or .obj.
bool can_write_meshes(const std::filesystem::path& file);

/// Writes meshes in the format of the file's extension (see `write_gltf`, `write_glb`, `write_obj`), atomically as
/// `write_file` does. Returns a Problem for meshes that can't be written, for another extension (`bad_argument`), and
/// if the file can't be written (`unreadable`). The message doesn't name the file.
std::optional<Problem> write_meshes(const std::filesystem::path& file, std::span<const Geometry> meshes);

}  // namespace abut

namespace abut::detail {

/// Checks that meshes can be written. The Problem is `empty_input` for no meshes or a mesh without triangles,
/// `not_finite` for a coordinate, and `index_out_of_range` for a triangle. Its index is that of the mesh.
std::optional<Problem> problem_of(std::span<const Geometry> meshes);

}  // namespace abut::detail
