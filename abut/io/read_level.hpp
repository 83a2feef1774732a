#pragma once

// Reads 2D levels from files: Tiled maps and SVG drawings.

#include <abut/io/level.hpp>
#include <abut/io/tiled/files.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace abut {

struct LevelOptions {
    /// SVG: maximum distance of a polyline from the curve that it approximates, in the file's units, above 0. Default:
    /// 1e-3 of each curve's extent. Circles and ellipses are exact, except those without fill.
    std::optional<double> tolerance = {};
    /// Tiled: allow tilesets and templates outside of the map's folder, such as "../tilesets/a.tsx".
    bool allow_outside = false;
};

/// True if the file's extension is that of a level, in any case: .tmx .tmj .json .svg .svgz.
bool is_level(const std::filesystem::path& file);

/// Reads a level, including the tilesets and templates in its folder and below that it refers to. Units and axes are
/// those of the file: y points down. Warnings list whatever is left out. Returns a Problem, with the location in the
/// file, for input that can't be read or used. The message doesn't name the file.
Result<Level> read_level(const std::filesystem::path& file, const LevelOptions& options = {});

/// Reads a level from memory. `extension` names the format as a file's extension would (".tmx"). `open` returns the
/// bytes of files that the level refers to, by their path relative to the level. Names outside of its folder are
/// rejected before `open` is called, unless the options allow them.
Result<Level> read_level(std::span<const std::byte> bytes, std::string_view extension, tiled::OpenFile open,
                         const LevelOptions& options = {});

}  // namespace abut
