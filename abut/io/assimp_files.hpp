#pragma once

// The files that Assimp opens by itself.

#include <abut/io/referenced_files.hpp>
#include <abut/math/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include <assimp/DefaultIOSystem.h>

namespace abut {

/// Opens one file, and for reading what lies beside it or below, as `ReferencedFiles` has it. Anything else isn't there
/// for Assimp; the first of those that it tried to open is remembered.
class AssimpFiles final : public Assimp::DefaultIOSystem {
public:
    /// Without a file, where a scene is read from memory, none is there.
    AssimpFiles(const std::filesystem::path& file, bool allow_outside);

    bool Exists(const char* path) const override;
    Assimp::IOStream* Open(const char* path, const char* mode) override;

    /// For the name that led outside, if one did.
    const std::optional<Problem>& refused() const { return refused_; }

private:
    std::string name_of(const std::string& path) const;
    Result<std::filesystem::path> find(const std::string& path) const;

    std::string file_;
    std::string folder_;  ///< as the file's name has it, with the separator at its end
    ReferencedFiles files_;
    std::optional<Problem> refused_;
};

}  // namespace abut
