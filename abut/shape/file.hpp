#pragma once

// Serialization of shapes: a pipeline saves them, a game loads them.

#include <abut/math/result.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

// Saving gives the same bytes on every machine. Loading restores the shape bit by bit, with the same tree, so that
// every answer is the same, in the same order. It is a check and a copy: nothing is searched or sorted.
//
// Loading returns a Problem (`bad_format`) if the bytes are too few or too many, if they are another shape or another
// file, have another version or a wrong checksum, or contradict themselves; and the Problems of `build` for points and
// indices. A file that was changed on purpose, with a valid checksum, may give another shape, but never one whose
// queries leave the data, don't end, or take longer than those of all its parts. docs/files.md lists what is checked.
// The memory is at most a few times the number of bytes.

/// About 64 bytes a triangle.
std::vector<std::byte> save(const Mesh& mesh);
Result<Mesh> load_mesh(std::span<const std::byte> bytes);

std::vector<std::byte> save(const Polyhedron& polyhedron);
Result<Polyhedron> load_polyhedron(std::span<const std::byte> bytes);

std::vector<std::byte> save(const Polygon& polygon);
Result<Polygon> load_polygon(std::span<const std::byte> bytes);

std::vector<std::byte> save(const HeightField& field);
Result<HeightField> load_height_field(std::span<const std::byte> bytes);

std::vector<std::byte> save(const TileMap& map);
Result<TileMap> load_tile_map(std::span<const std::byte> bytes);

/// One bit a voxel.
std::vector<std::byte> save(const VoxelMap& map);
Result<VoxelMap> load_voxel_map(std::span<const std::byte> bytes);

std::vector<std::byte> save(const Chain& chain);
Result<Chain> load_chain(std::span<const std::byte> bytes);

template <int D>
std::vector<std::byte> save(const SolidBsp<D>& level);
template <int D>
Result<SolidBsp<D>> load_solid_bsp(std::span<const std::byte> bytes);

/// With the children, of which those that share their data share it after loading too. Returns a Problem if a child is
/// a user's shape, which no file can hold (`bad_argument`, index: the child), or if compounds are nested more than 16
/// deep or have more than 2^20 children in all (`too_large`).
template <int D>
Result<std::vector<std::byte>> save(const Compound<D>& compound);
template <int D>
Result<Compound<D>> load_compound(std::span<const std::byte> bytes);

}  // namespace abut
