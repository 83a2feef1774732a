#include "tool/check/scene_list.hpp"

#include "tool/shared/name_pattern.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string_view>
#include <system_error>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

bool is_scene(const fs::path& file) {
    constexpr std::array<std::string_view, 11> extensions{".gltf", ".glb", ".tscn", ".tmx", ".tmj", ".svg",
                                                          ".obj",  ".fbx", ".dae",  ".ply", ".stl"};
    const std::string extension = lower_case(file.extension().string());
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

std::optional<Problem> add_folder(const std::string& folder, std::vector<std::string>& out) {
    std::vector<std::string> found;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
        if (std::error_code ignored; entry->is_regular_file(ignored) && is_scene(entry->path()))
            found.push_back(entry->path().string());
    if (error) return Problem{ProblemCode::unreadable, folder + ": " + error.message()};
    if (found.empty())
        return Problem{ProblemCode::empty_input, folder + ": the folder has no scene and no level in it or below it"};
    std::sort(found.begin(), found.end());
    out.insert(out.end(), found.begin(), found.end());
    return std::nullopt;
}

std::optional<Problem> add(const std::string& name, std::vector<std::string>& out) {
    std::error_code error;
    if (fs::is_directory(name, error)) return add_folder(name, out);
    out.push_back(name);
    return std::nullopt;
}

}  // namespace

Result<std::vector<std::string>> scenes_of(const std::vector<std::string>& arguments) {
    std::vector<std::string> scenes;
    for (const std::string& argument : arguments) {
        if (argument != "-") {
            if (std::optional<Problem> problem = add(argument, scenes)) return *std::move(problem);
            continue;
        }
        for (std::string line; std::getline(std::cin, line);) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            if (line.empty()) continue;
            if (std::optional<Problem> problem = add(line, scenes)) return *std::move(problem);
        }
    }
    if (scenes.empty()) return Problem{ProblemCode::empty_input, "the list on stdin names no file"};
    return scenes;
}

}  // namespace abut::tool
