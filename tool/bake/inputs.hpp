#pragma once

// The files that one input consists of.

#include <abut/math/result.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace abut::tool {

struct InputFile {
    std::string name;    ///< as the referring file spells it
    std::string sha256;  ///< of all its bytes
};

/// The file itself first, then each file that it names, directly or through another one, in the order of names. A name
/// is a text in quotes, a word, or the rest of a line, that is the path of a file from the folder of the one that has
/// it: buffers and textures of glTF, tilesets of Tiled, materials of OBJ. Names may be percent-encoded. The message of
/// a Problem doesn't name the file.
Result<std::vector<InputFile>> input_files(const std::filesystem::path& file);

}  // namespace abut::tool
