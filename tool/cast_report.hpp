#pragma once

// What `abut cast` has to say: as text, as JSON, and as a picture.

#include "cast.hpp"

#include <string>
#include <vector>

namespace abut::tool {

struct CastReport {
    const Objects& objects;
    const CastOptions& options;
    double time = 0;  ///< the moment at which the objects are, in seconds
    CastResult result;
    std::vector<std::string> notes;
    double read_seconds = 0, build_seconds = 0, cast_seconds = 0;
};

/// For a person: the hits in order, and a verdict in the last line.
std::string text_report(const CastReport& report, const std::string& scene_name);

/// One object; numbers unrounded.
std::string json_report(const CastReport& report);

/// As SVG: the ray from the side and somewhat from above (y is up), with what of the scene is about it.
std::string picture(const CastReport& report);

}  // namespace abut::tool
