#pragma once

// Files that a scene or level refers to by name. Access is restricted to the folder of the referring file and its
// subfolders, unless files outside are allowed.

#include <abut/io/file/file_names.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
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

}  // namespace abut::detail
