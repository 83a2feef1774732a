#include "tool/bake/inputs.hpp"

#include "tool/bake/sha256.hpp"
#include <abut/io/file/read_file.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_name = 1000;
// More than any scene has; they end a search in files that are no text.
constexpr std::size_t max_files = 10'000;

// True for texts that end like a file's name: a dot, and an extension that begins with a letter.
bool may_be_name(std::string_view text) {
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos || dot + 1 >= text.size() || text.size() > max_name) return false;
    const std::string_view extension = text.substr(dot + 1);
    return extension.size() <= 10 && std::isalpha(static_cast<unsigned char>(extension.front())) != 0 &&
           std::all_of(extension.begin(), extension.end(),
                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }) &&
           std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= ' '; });
}

// Without percent-encoding, the escapes "\/" and "&amp;", and the scheme of Godot.
std::string decoded(std::string_view text) {
    for (const std::string_view scheme : {"res://", "file://"})
        if (text.starts_with(scheme)) text.remove_prefix(scheme.size());
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto digit = [&](std::size_t at) {
            return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at])) != 0;
        };
        if (text[i] == '%' && digit(i + 1) && digit(i + 2)) {
            result += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else if (text[i] == '\\') {
            result += '/';
            if (i + 1 < text.size() && (text[i + 1] == '/' || text[i + 1] == '\\')) ++i;
        } else if (text.substr(i).starts_with("&amp;")) {
            result += '&';
            i += 4;
        } else {
            result += text[i];
        }
    }
    return result;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\0';
}

// Adds the texts between separators.
void add_names(std::string_view text, bool (*separates)(char), std::set<std::string>& names) {
    for (std::size_t first = 0; first < text.size();) {
        std::size_t end = first;
        while (end < text.size() && !separates(text[end])) ++end;
        const std::string_view word = text.substr(first, end - first);
        if (may_be_name(word)) names.insert(decoded(word));
        first = end + 1;
    }
}

std::set<std::string> names_in(std::string_view text) {
    std::set<std::string> names;
    add_names(
        text, [](char c) { return c == '"' || c == '\'' || c == '<' || c == '>' || c == '\n'; }, names);
    add_names(
        text, [](char c) { return c == '"' || c == '\'' || c == '<' || c == '>' || is_blank(c); }, names);
    // The rest of a line: "mtllib two words.mtl".
    for (std::size_t first = 0; first < text.size();) {
        const std::size_t end = std::min(text.find('\n', first), text.size());
        std::string_view line = text.substr(first, std::min(end - first, max_name + 1));
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        const std::size_t blank = line.find(' ');
        if (blank != std::string_view::npos && may_be_name(line.substr(blank + 1)))
            names.insert(decoded(line.substr(blank + 1)));
        first = end + 1;
    }
    return names;
}

}  // namespace

Result<std::vector<InputFile>> input_files(const fs::path& file) {
    std::map<std::string, InputFile> found;
    std::vector<fs::path> open{file.filename()};
    const fs::path folder = file.parent_path();
    std::vector<InputFile> result;
    while (!open.empty() && found.size() < max_files) {
        const fs::path name = std::move(open.back());
        open.pop_back();
        Result<std::vector<std::byte>> bytes = detail::read_file(folder / name);
        if (!bytes) {
            if (result.empty()) return bytes.problem();
            continue;
        }
        const InputFile entry{name.generic_string(), sha256(*bytes)};
        if (result.empty()) result.push_back(entry);
        found[entry.name] = entry;
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        for (const std::string& referred : names_in(text)) {
            const fs::path there = (name.parent_path() / referred).lexically_normal();
            std::error_code error;
            if (found.contains(there.generic_string()) || !fs::is_regular_file(folder / there, error)) continue;
            if (std::find(open.begin(), open.end(), there) == open.end()) open.push_back(there);
        }
    }
    found.erase(result.front().name);
    for (auto& [name, entry] : found) result.push_back(std::move(entry));
    return result;
}

}  // namespace abut::tool
