#pragma once

// File access for Assimp, restricted to the scene's folder. Included by read_assimp.cpp only.

#include <abut/io/file/referenced_files.hpp>
#include <abut/math/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include <assimp/DefaultIOSystem.h>

namespace abut::detail {

/// An Assimp IO system that opens the scene's file and, read-only, files that `ReferencedFiles` permits. Other files
/// don't exist for Assimp. The first refused name is recorded.
class AssimpFiles final : public Assimp::DefaultIOSystem {
public:
    /// An empty path refuses every file: the scene is read from memory.
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

    /// The Problem of the first name that was refused for being outside of the folder.
    const std::optional<Problem>& refused() const { return refused_; }

private:
    static std::filesystem::path folder_of(const std::filesystem::path& file) {
        if (file.empty()) return {};
        return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    }
    // Some importers prepend the folder to names, and some don't.
    std::string name_of(const std::string& path) const {
        return path.starts_with(folder_) ? path.substr(folder_.size()) : path;
    }
    Result<std::filesystem::path> find(const std::string& path) const {
        if (path == file_) return std::filesystem::path(path);
        return files_.find(name_of(path));
    }

    std::string file_;
    std::string folder_;  ///< the folder part of the file's name, with the separator at its end
    ReferencedFiles files_;
    std::optional<Problem> refused_;
};

}  // namespace abut::detail
