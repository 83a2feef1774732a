#pragma once

// The triangles of zero area that a file has and no object is made of.

#include "written.hpp"
#include <abut/io/level.hpp>
#include <abut/io/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

struct LeftOutOf {
    std::string path;
    std::uint64_t triangles = 0;
    bool has_shape = true;  ///< false where the object has no others: it is none of the objects then
};

/// Of each object that has such triangles.
std::vector<LeftOutOf> left_out_of(const Scene& scene);
/// None: levels are made of other things.
std::vector<LeftOutOf> left_out_of(const Level& level);

/// "3 triangles of zero area: 2 of 'A', 1 of 'B'"; empty if there are none.
std::string text_of(const std::vector<LeftOutOf>& left_out);

/// {"triangles", "objects": [{"name", "triangles", "shape"}]}
Json json_of(const std::vector<LeftOutOf>& left_out);

}  // namespace abut::tool
