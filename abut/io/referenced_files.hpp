#pragma once

// The files that a scene or a level refers to by name: those beside it and below, and no others unless they are
// allowed.

#include <abut/math/result.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Names are taken from the folder of the file that is read. A name leads out of it if it is absolute, if it climbs
/// above the folder by "..", or if a symbolic link on its way points out; "\" counts as "/". That is decided before
/// anything is said of whether there is such a file. The messages of all Problems are without the name.
class ReferencedFiles {
public:
    /// With an empty folder there are no such files, as where a scene is read from memory.
    ReferencedFiles(const std::filesystem::path& folder, bool allow_outside);

    /// Where the file is, for opening it.
    Result<std::filesystem::path> find(const std::string& name) const;

    /// All of its bytes.
    Result<std::vector<std::byte>> bytes(const std::string& name) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path real_folder_;  ///< without symbolic links
    bool allow_outside_;
};

/// Whether a Problem is that of a name that leads out of the folder.
bool is_outside(const Problem& problem);
/// That Problem.
Problem outside();

/// What the text of a name alone has wrong with it: it is none, it leads to a network or, unless that is allowed, out
/// of the folder.
std::optional<Problem> check_name(std::string_view name, bool allow_outside);

/// A name in quotes for a message, shortened if it is very long.
std::string quoted_name(std::string_view name);

}  // namespace abut
