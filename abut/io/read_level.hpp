#pragma once

// A level of the plane from a file: Tiled maps and SVG drawings.

#include <abut/io/level.hpp>
#include <abut/io/tiled_files.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace abut {

struct LevelOptions {
    /// SVG: how far a line may be from the curve that it stands for, in the file's units, above zero. Without it a
    /// thousandth of each curve's own extent. Circles and ellipses are exact, but for those without fill.
    std::optional<double> tolerance = {};
    /// Tiled: read tilesets and templates outside of the map's folder too, such as "../tilesets/a.tsx".
    bool allow_outside = false;
};

/// Whether the file's name ends as that of a level: .tmx .tmj .json .svg .svgz, in any case.
bool is_level(const std::filesystem::path& file);

/// Reads a level, with the tilesets and templates beside it, or below, that it refers to. Lengths stay in the file's
/// units, axes as they are: y points down. Warnings of the level name parts that are left out. A Problem, with what is
/// wrong and where in the file, for whatever can't be read or used; its message doesn't name the file.
Result<Level> read_level(const std::filesystem::path& file, const LevelOptions& options = {});

/// The same from memory. `extension` names the format as the end of a file's name would (".tmx"); `open` gives the
/// files that the level refers to, by their path from there; names that lead out of its folder by their text don't come
/// that far unless the options allow it.
Result<Level> read_level(std::span<const std::byte> bytes, std::string_view extension, tiled::OpenFile open,
                         const LevelOptions& options = {});

}  // namespace abut
