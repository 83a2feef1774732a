#pragma once

// Files that a scene or level refers to by name. Access is restricted to the folder of the referring file and its
// subfolders, unless files outside are allowed.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut::detail {

/// Resolves names relative to the folder of the referring file. A name is outside if it is absolute, if ".." climbs
/// above the folder, or if a symbolic link on its path points outside. "\" counts as "/". The check precedes any test
/// for the file's existence. The messages of all Problems are without the name.
class ReferencedFiles {
public:
    /// An empty folder means that no file can be referred to: the scene is read from memory.
    ReferencedFiles(const std::filesystem::path& folder, bool allow_outside);

    /// The path to open for `name`, or a Problem.
    Result<std::filesystem::path> find(const std::string& name) const;

    /// All bytes of the file `name`, or a Problem.
    Result<std::vector<std::byte>> bytes(const std::string& name) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path real_folder_;  ///< canonical: without symbolic links
    bool allow_outside_;
};

/// True if the Problem reports a name outside of the folder.
bool is_outside(const Problem& problem);
/// The Problem for a name outside of the folder.
Problem outside_problem();

/// Checks the text of a name only, without the file system. Returns a Problem if the name is empty, has a scheme other
/// than "file", or is outside of the folder and that is not allowed.
std::optional<Problem> check_name(std::string_view name, bool allow_outside);

/// The name in single quotes for a message, cut after 200 characters.
std::string quoted_name(std::string_view name);

}  // namespace abut::detail
