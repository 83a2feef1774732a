#pragma once

// Triangles of zero area that a file has and that are left out of its objects.

#include "tool/shared/format.hpp"
#include <abut/io/level.hpp>
#include <abut/io/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

struct LeftOutOf {
    std::string path;
    std::uint64_t triangles = 0;
    bool has_shape = true;  ///< false if the object has no other triangles and so isn't among the objects
};

/// One entry per node with such triangles.
std::vector<LeftOutOf> left_out_of(const Scene& scene);
/// Empty: levels have no triangles.
std::vector<LeftOutOf> left_out_of(const Level& level);

/// "3 triangles of zero area: 2 of 'A', 1 of 'B'"; empty if there are none.
std::string text_of(const std::vector<LeftOutOf>& left_out);

/// {"triangles", "objects": [{"name", "triangles", "shape"}]}
Json json_of(const std::vector<LeftOutOf>& left_out);

}  // namespace abut::tool
