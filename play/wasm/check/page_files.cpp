// Stands for abut/io/file/read_file.cpp and referenced_files.cpp where there is no file system.

#include "page_files.hpp"

#include <abut/io/file/read_file.hpp>
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/file/size_limit.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut {
namespace {

using Files = std::map<std::string, std::vector<std::byte>, std::less<>>;

Files& files() {
    static Files all;
    return all;
}

}  // namespace

void play::add_file(std::string_view name, std::span<const std::byte> bytes) {
    files()[std::string(name)].assign(bytes.begin(), bytes.end());
}

namespace detail {

Result<std::vector<std::byte>> read_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
    const auto found = files().find(file.filename().string());
    if (found == files().end())
        return Problem{ProblemCode::not_found, "is not among the files given: choose it together with this one"};
    if (std::optional<Problem> problem = check_size(found->second.size(), max_bytes)) return *std::move(problem);
    return found->second;
}

ReferencedFiles::ReferencedFiles(const std::filesystem::path& folder, bool allow_outside)
    : folder_(folder), allow_outside_(allow_outside) {}

Result<std::filesystem::path> ReferencedFiles::find(const std::string& name) const {
    if (std::optional<Problem> problem = check_name(name, allow_outside_)) return *std::move(problem);
    return folder_ / path_named(name);
}

Result<std::vector<std::byte>> ReferencedFiles::bytes(const std::string& name) const {
    const Result<std::filesystem::path> path = find(name);
    if (!path) return path.problem();
    return read_file(*path);
}

}  // namespace detail
}  // namespace abut
