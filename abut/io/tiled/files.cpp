#include <abut/io/file/referenced_files.hpp>
#include <abut/io/tiled/files.hpp>

#include <filesystem>
#include <utility>

namespace abut::tiled {
namespace {

template <class T>
Result<T> named(const std::string& file, Result<T> result) {
    if (result) return result;
    return Problem{result.problem().code, detail::quoted_name(file) + ": " + result.problem().message};
}

}  // namespace

bool is_xml(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
        const char c = static_cast<char>(byte);
        if (c == '{' || c == '[') return false;
        if (c == '<') return true;
    }
    return false;
}

std::string resolved_path(const std::string& from, const std::string& name) {
    return (std::filesystem::path(from).parent_path() / name).lexically_normal().generic_string();
}

Result<std::vector<std::byte>> Files::bytes(const std::string& name) {
    if (std::optional<Problem> problem = detail::check_name(name, allow_outside_)) return *std::move(problem);
    return open_(name);
}

Result<Tileset> Files::tileset(const std::string& name) {
    const Result<std::vector<std::byte>> content = bytes(name);
    if (!content) return named<Tileset>(name, content.problem());
    Result<Tileset> result = named(name, is_xml(*content) ? tileset_from_xml(*content) : tileset_from_json(*content));
    if (result) result->file = name;
    return result;
}

Result<const Template*> Files::object_template(const std::string& name) {
    const auto known = templates_.find(name);
    if (known != templates_.end()) return &known->second;
    const Result<std::vector<std::byte>> content = bytes(name);
    if (!content) return named<const Template*>(name, content.problem());
    Result<Template> result =
        named(name, is_xml(*content) ? template_from_xml(*content) : template_from_json(*content));
    if (!result) return result.problem();
    if (!result->tileset_file.empty()) result->tileset_file = resolved_path(name, result->tileset_file);
    return &templates_.emplace(name, *std::move(result)).first->second;
}

}  // namespace abut::tiled
