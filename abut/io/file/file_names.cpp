#include <abut/io/file/file_names.hpp>
#include <abut/io/file/scanner.hpp>

#include <algorithm>
#include <cstddef>

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

std::string_view path_named(std::string_view name) {
    if (!is_file_uri(name)) return name;
    name.remove_prefix(scheme_of(name).size() + 1);
    if (name.starts_with("//")) name.remove_prefix(std::min(name.size(), name.find('/', 2)));
    return name;
}

}  // namespace abut::detail
