#include <abut/io/file/read_file.hpp>
#include <abut/io/file/referenced_files.hpp>
#include <abut/io/file/scanner.hpp>

#include <algorithm>
#include <system_error>

namespace abut::detail {
namespace {

constexpr std::size_t max_quoted_length = 200;
constexpr std::string_view outside_text = "lies outside of the file's folder";

bool is_separator(char c) {
    return c == '/' || c == '\\';
}

// The scheme of a URI, without the colon. A single letter is a Windows drive and no scheme.
std::string_view scheme_of(std::string_view name) {
    const auto end = std::find_if_not(name.begin(), name.end(), is_letter);
    const auto length = static_cast<std::size_t>(end - name.begin());
    const bool is_scheme = length >= 2 && end != name.end() && *end == ':' && name.substr(length + 1).starts_with('/');
    return is_scheme ? name.substr(0, length) : std::string_view();
}

bool is_file_uri(std::string_view name) {
    constexpr std::string_view file = "file";
    const std::string_view scheme = scheme_of(name);
    return std::equal(scheme.begin(), scheme.end(), file.begin(), file.end(),
                      [](char c, char expected) { return (c | 0x20) == expected; });
}

// The absolute path of a file URI. The host is ignored.
std::string_view path_of_file_uri(std::string_view uri) {
    uri.remove_prefix(scheme_of(uri).size() + 1);
    if (uri.starts_with("//")) uri.remove_prefix(std::min(uri.size(), uri.find('/', 2)));
    return uri;
}

// Decides from the text alone, without the file system.
bool is_textually_outside(std::string_view name) {
    const bool has_drive = name.size() >= 2 && is_letter(name[0]) && name[1] == ':';
    if (is_separator(name[0]) || has_drive || is_file_uri(name)) return true;
    std::size_t depth = 0;
    for (std::size_t begin = 0; begin < name.size();) {
        const std::size_t end = std::min(name.size(), name.find_first_of("/\\", begin));
        const std::string_view part = name.substr(begin, end - begin);
        if (part == ".." && depth == 0) return true;
        if (part == "..")
            --depth;
        else if (!part.empty() && part != ".")
            ++depth;
        begin = end + 1;
    }
    return false;
}

}  // namespace

std::string quoted_name(std::string_view name) {
    if (name.size() <= max_quoted_length) return "'" + std::string(name) + "'";
    return "'" + std::string(name.substr(0, max_quoted_length)) + "...'";
}

Problem outside_problem() {
    return {ProblemCode::not_found, std::string(outside_text)};
}

bool is_outside(const Problem& problem) {
    return problem.code == ProblemCode::not_found && problem.message.ends_with(outside_text);
}

std::optional<Problem> check_name(std::string_view name, bool allow_outside) {
    if (name.empty() || name.find('\0') != std::string_view::npos)
        return Problem{ProblemCode::bad_format, "isn't the name of a file"};
    if (!scheme_of(name).empty() && !is_file_uri(name))
        return Problem{ProblemCode::not_found, "isn't a file beside this one"};
    if (!allow_outside && is_textually_outside(name)) return outside_problem();
    return std::nullopt;
}

ReferencedFiles::ReferencedFiles(const std::filesystem::path& folder, bool allow_outside)
    : folder_(folder), allow_outside_(allow_outside) {
    std::error_code error;
    if (!folder_.empty()) real_folder_ = std::filesystem::canonical(folder_, error);
    if (error) real_folder_.clear();
}

Result<std::filesystem::path> ReferencedFiles::find(const std::string& name) const {
    if (std::optional<Problem> problem = check_name(name, allow_outside_)) return *std::move(problem);
    if (folder_.empty()) return Problem{ProblemCode::not_found, "isn't a file beside this one"};
    if (allow_outside_) return folder_ / (is_file_uri(name) ? path_of_file_uri(name) : std::string_view(name));
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
