#pragma once

// What `abut cast` has to say: as text, as JSON, and as a picture.

#include "cast.hpp"
#include "left_out.hpp"

#include <string>
#include <vector>

namespace abut::tool {

template <int D>
struct CastReport {
    const Objects<D>& objects;
    const CastOptions<D>& options;
    double time = 0;  ///< the moment at which the objects are, in seconds
    CastResult<D> result;
    std::vector<std::string> notes;
    std::vector<LeftOutOf> left_out;
    double read_seconds = 0, build_seconds = 0, cast_seconds = 0;
};

/// For a person: the hits in order, and a verdict in the last line.
template <int D>
std::string text_report(const CastReport<D>& report, const std::string& scene_name);

/// One object; numbers unrounded.
template <int D>
std::string json_report(const CastReport<D>& report);

/// As SVG, the ray with what is about it: of a scene from the side and somewhat from above (y is up), of a level as its
/// editor shows it (y is down).
std::string picture(const CastReport<3>& report);
std::string picture(const CastReport<2>& report);

}  // namespace abut::tool
