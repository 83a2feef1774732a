#pragma once

// The files that a Tiled map refers to: tilesets and templates.

#include <abut/io/tiled_map.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut::tiled {

/// All bytes of a file beside the map, by its path from there.
using OpenFile = FunctionRef<Result<std::vector<std::byte>>(const std::string& name)>;

/// Reads each once. The message of a Problem begins with the file's name.
class Files {
public:
    /// Names that lead out of the map's folder by their text are a Problem unless they are allowed.
    Files(OpenFile open, bool allow_outside) : open_(open), allow_outside_(allow_outside) {}

    Result<Tileset> tileset(const std::string& name);
    /// Refers to what is kept here.
    Result<const Template*> object_template(const std::string& name);

private:
    Result<std::vector<std::byte>> bytes(const std::string& name);

    OpenFile open_;
    bool allow_outside_;
    std::map<std::string, Template> templates_;
};

/// The path of a file that the file `from` calls `name`, without "." and "..", as far as that goes.
std::string beside(const std::string& from, const std::string& name);

/// Of a file's content: whether it is XML, and not JSON.
bool is_xml(std::span<const std::byte> bytes);

// The two ways to write each; messages name the place in the file.
Result<Map> map_from_xml(std::span<const std::byte> bytes, Files& files);
Result<Map> map_from_json(std::span<const std::byte> bytes, Files& files);
Result<Tileset> tileset_from_xml(std::span<const std::byte> bytes);
Result<Tileset> tileset_from_json(std::span<const std::byte> bytes);
Result<Template> template_from_xml(std::span<const std::byte> bytes);
Result<Template> template_from_json(std::span<const std::byte> bytes);

}  // namespace abut::tiled
