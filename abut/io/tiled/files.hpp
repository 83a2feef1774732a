#pragma once

// Loads the tilesets and templates that a Tiled map refers to.

#include <abut/io/tiled/map.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut::tiled {

/// Returns all bytes of a file, by its path relative to the map.
using OpenFile = FunctionRef<Result<std::vector<std::byte>>(const std::string& name)>;

/// Caches each template. The message of a Problem begins with the file's name.
class Files {
public:
    /// Names that are outside of the map's folder by their text are a Problem unless they are allowed.
    Files(OpenFile open, bool allow_outside) : open_(open), allow_outside_(allow_outside) {}

    Result<Tileset> tileset(const std::string& name);
    /// The template is owned by this object.
    Result<const Template*> object_template(const std::string& name);

private:
    Result<std::vector<std::byte>> bytes(const std::string& name);

    OpenFile open_;
    bool allow_outside_;
    std::map<std::string, Template> templates_;
};

/// The path of a file `name` that the file `from` refers to, lexically normalized.
std::string resolved_path(const std::string& from, const std::string& name);

/// True if the content is XML, false if it is JSON.
bool is_xml(std::span<const std::byte> bytes);

// Parsers of the two formats. Messages name the location in the file.
Result<Map> map_from_xml(std::span<const std::byte> bytes, Files& files);
Result<Map> map_from_json(std::span<const std::byte> bytes, Files& files);
Result<Tileset> tileset_from_xml(std::span<const std::byte> bytes);
Result<Tileset> tileset_from_json(std::span<const std::byte> bytes);
Result<Template> template_from_xml(std::span<const std::byte> bytes);
Result<Template> template_from_json(std::span<const std::byte> bytes);

}  // namespace abut::tiled
