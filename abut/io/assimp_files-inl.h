#pragma once

// The files that Assimp opens by itself. For read_assimp.cpp.

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
    AssimpFiles(const std::filesystem::path& file, bool allow_outside)
        : file_(file.string()),
          folder_(file_.substr(0, file_.size() - file.filename().string().size())),
          files_(folder_of(file), allow_outside) {}

    bool Exists(const char* path) const override {
        const Result<std::filesystem::path> found = find(path);
        return found && DefaultIOSystem::Exists(found->string().c_str());
    }

    Assimp::IOStream* Open(const char* path, const char* mode) override {
        if (mode[0] != 'r') return nullptr;
        const Result<std::filesystem::path> found = find(path);
        if (found) return DefaultIOSystem::Open(found->string().c_str(), mode);
        const Problem& problem = found.problem();
        if (is_outside(problem) && !refused_)
            refused_ = Problem{problem.code, quoted_name(name_of(path)) + ": " + problem.message};
        return nullptr;
    }

    /// For the name that led outside, if one did.
    const std::optional<Problem>& refused() const { return refused_; }

private:
    static std::filesystem::path folder_of(const std::filesystem::path& file) {
        if (file.empty()) return {};
        return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    }
    // Some importers put the folder before the names that they find, and some don't.
    std::string name_of(const std::string& path) const {
        return path.starts_with(folder_) ? path.substr(folder_.size()) : path;
    }
    Result<std::filesystem::path> find(const std::string& path) const {
        if (path == file_) return std::filesystem::path(path);
        return files_.find(name_of(path));
    }

    std::string file_;
    std::string folder_;  ///< as the file's name has it, with the separator at its end
    ReferencedFiles files_;
    std::optional<Problem> refused_;
};

}  // namespace abut
