#include <abut/io/assimp_files.hpp>

namespace abut {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
    if (file.empty()) return {};
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

AssimpFiles::AssimpFiles(const std::filesystem::path& file, bool allow_outside)
    : file_(file.string()),
      folder_(file_.substr(0, file_.size() - file.filename().string().size())),
      files_(folder_of(file), allow_outside) {}

// Some importers put the folder before the names that they find, and some don't.
std::string AssimpFiles::name_of(const std::string& path) const {
    return path.starts_with(folder_) ? path.substr(folder_.size()) : path;
}

Result<std::filesystem::path> AssimpFiles::find(const std::string& path) const {
    if (path == file_) return std::filesystem::path(path);
    return files_.find(name_of(path));
}

bool AssimpFiles::Exists(const char* path) const {
    const Result<std::filesystem::path> found = find(path);
    return found && DefaultIOSystem::Exists(found->string().c_str());
}

Assimp::IOStream* AssimpFiles::Open(const char* path, const char* mode) {
    if (mode[0] != 'r') return nullptr;
    const Result<std::filesystem::path> found = find(path);
    if (found) return DefaultIOSystem::Open(found->string().c_str(), mode);
    const Problem& problem = found.problem();
    if (is_outside(problem) && !refused_)
        refused_ = Problem{problem.code, quoted_name(name_of(path)) + ": " + problem.message};
    return nullptr;
}

}  // namespace abut
