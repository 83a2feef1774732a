#pragma once

// Levels of real games from Debian packages; none is part of this repository.

#include "../../scenes/neverball.hpp"
#include "../../scenes/wad.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::test {

/// The level files, in a deterministic order; none if the package neverball-data isn't installed.
inline std::vector<std::string> neverball_files() {
    std::vector<std::string> result;
    const std::filesystem::path folder("/usr/share/games/neverball");
    std::error_code none;
    for (const auto& maps : std::filesystem::directory_iterator(folder, none)) {
        const std::string name = maps.path().filename().string();
        // Background scenery is no level.
        if (!name.starts_with("map-") || name == "map-back") continue;
        for (const auto& file : std::filesystem::directory_iterator(maps.path()))
            if (file.path().extension() == ".sol") result.push_back(file.path().string());
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Both files of the package freedoom, or none if it isn't installed.
inline std::vector<std::string> freedoom_files() {
    std::vector<std::string> result;
    for (const char* name : {"freedoom1.wad", "freedoom2.wad"}) {
        const std::filesystem::path path = std::filesystem::path("/usr/share/games/doom") / name;
        if (!std::filesystem::exists(path)) return {};
        result.push_back(path.string());
    }
    return result;
}

inline constexpr const char* no_neverball = "the Debian package neverball-data isn't here";
inline constexpr const char* no_freedoom = "the Debian package freedoom isn't here";

}  // namespace abut::test
