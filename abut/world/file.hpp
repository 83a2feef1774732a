#pragma once

// Serialization of a world with its shapes: a level's editor saves it, a game loads it.

#include <abut/world/world.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// A snapshot (see World::save) and each different shape once. The same bytes on every machine. It takes time linear in
/// the number of the shapes' parts.
///
/// Returns a Problem if a shape can't be saved: a distance function, or one of a type of your own (`bad_argument`,
/// index: that of the item's id).
template <int D>
Result<std::vector<std::byte>> save_with_shapes(World<D>& world);

/// The world that was saved, in a World with these options: the same ids, answers and later events, bit by bit. Its
/// lists of the last update are empty, as after World::restore.
///
/// Returns a Problem if the bytes are no such file, of another version or dimension, or damaged (`bad_format`), also on
/// purpose, with a right checksum: see abut/shape/file.hpp for the shapes.
template <int D>
Result<World<D>> load_world(std::span<const std::byte> bytes, const WorldOptions& options = {});

}  // namespace abut
