#include <abut/io/file/read_file.hpp>
#include <abut/io/file/referenced_files.hpp>

#include <algorithm>
#include <system_error>

namespace abut::detail {

ReferencedFiles::ReferencedFiles(const std::filesystem::path& folder, bool allow_outside)
    : folder_(folder), allow_outside_(allow_outside) {
    std::error_code error;
    if (!folder_.empty()) real_folder_ = std::filesystem::canonical(folder_, error);
    if (error) real_folder_.clear();
}

Result<std::filesystem::path> ReferencedFiles::find(const std::string& name) const {
    if (std::optional<Problem> problem = check_name(name, allow_outside_)) return *std::move(problem);
    if (folder_.empty()) return Problem{ProblemCode::not_found, "isn't a file beside this one"};
    if (allow_outside_) return folder_ / path_named(name);
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(folder_ / name, error);
    if (error) return Problem{ProblemCode::unreadable, "can't be read: " + error.message()};
    const bool is_inside =
        !real_folder_.empty() &&
        std::mismatch(real_folder_.begin(), real_folder_.end(), real.begin(), real.end()).first == real_folder_.end();
    if (!is_inside) return outside_problem();
    return real;
}

Result<std::vector<std::byte>> ReferencedFiles::bytes(const std::string& name) const {
    const Result<std::filesystem::path> path = find(name);
    if (!path) return path.problem();
    return read_file(*path);
}

}  // namespace abut::detail
