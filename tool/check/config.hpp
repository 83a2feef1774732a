#pragma once

// The file `abut.toml`: options of `abut check` for the levels of a folder and the folders in it.
//
//     character = [0.3, 1.8]
//     ignore = ["Tree*:Ground"]
//
//     [severity]
//     leak = "error"
//
//     [level."cave*.glb"]
//     ignore = ["ABUT101 Lamp:Ceiling"]

#include "tool/check/settings.hpp"
#include <abut/math/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace abut::tool {

inline constexpr const char* config_name = "abut.toml";

/// The abut.toml in the folder of a file, or else in the nearest folder above it.
std::optional<std::filesystem::path> find_config(const std::filesystem::path& scene);

/// The settings that the file has for a scene: those at its top, then those of each `[level."PATTERN"]` that matches
/// the scene's file name; of one option the last counts, and `ignore` has all. The message of a Problem begins with
/// the file and the line.
Result<Settings> read_config(const std::filesystem::path& config, const std::filesystem::path& scene);

/// Parses the text of such a file.
Result<Settings> settings_of_config(const std::string& text, const std::filesystem::path& config,
                                    const std::string& scene_name);

/// A section for a level, as text.
std::string config_section(const std::string& scene_name, const Settings& settings);

}  // namespace abut::tool
