#pragma once

// What the files of all shapes have in common: "abutshp\n", the kind, the version of the kind, the data of the shape,
// and a checksum of everything before it. For .cpp files.

#include <abut/math/detail/blob.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut::detail {

/// The numbers are part of the files.
enum class SavedKind : std::uint32_t {
    mesh = 1,
    polyhedron,
    polygon,
    height_field,
    tile_map,
    chain,
    compound_2d,
    compound_3d,
    solid_bsp_2d,
    solid_bsp_3d,
    voxel_map,
};

/// With its article, as in "a mesh".
std::string_view name_of(SavedKind kind);

/// The kind that the beginning of a file names; 0 if it names none.
SavedKind kind_of_shape(std::span<const std::byte> bytes);

/// Begins a file; the data follow. `size` is about the number of bytes that they will take.
BlobWriter begin_shape(SavedKind kind, std::size_t size);
/// Appends the checksum.
std::vector<std::byte> end_shape(BlobWriter&& writer);

/// Checks the beginning and the checksum of a file, and moves the reader to the data. A Problem says what the file is
/// instead, or what is wrong with it.
std::optional<Problem> open_shape(BlobReader& reader, std::span<const std::byte> bytes, SavedKind kind);

/// The Problems of data that passed the checksum: too few, too many, or contradictory.
Problem truncated_shape(SavedKind kind);
Problem overlong_shape(SavedKind kind);
Problem bad_shape(SavedKind kind, std::string_view what, std::size_t index = 0);
/// The same by the name of what the file holds, with its article.
Problem bad_file_of(std::string_view name, std::string_view what, std::size_t index = 0);

/// Reads a whole file: read(reader) reads the data, and returns false if there are too few.
template <class Read>
std::optional<Problem> read_shape(std::span<const std::byte> bytes, SavedKind kind, const Read& read) {
    BlobReader reader(bytes);
    if (std::optional<Problem> wrong = open_shape(reader, bytes, kind)) return wrong;
    if (!read(reader)) return truncated_shape(kind);
    if (reader.left() != 0) return overlong_shape(kind);
    return std::nullopt;
}

}  // namespace abut::detail
