#pragma once

// Reports of `abut cast`: text, JSON and a picture.

#include "tool/cast/cast.hpp"
#include "tool/shared/left_out.hpp"

#include <string>
#include <vector>

namespace abut::tool {

template <int D>
struct CastReport {
    const Objects<D>& objects;
    const CastOptions<D>& options;
    double time = 0;  ///< time of the objects' poses, in seconds
    CastResult<D> result;
    std::vector<std::string> notes;
    std::vector<LeftOutOf> left_out;
    double read_seconds = 0, build_seconds = 0, cast_seconds = 0;
};

/// Text for people: hits in order, and a verdict in the last line.
template <int D>
std::string text_report(const CastReport<D>& report, const std::string& scene_name);

/// One JSON object; numbers unrounded.
template <int D>
std::string json_report(const CastReport<D>& report);

/// An SVG of the ray and the objects around it. Scenes are seen from the side and slightly from above (y up), levels as
/// in their editor (y down).
std::string picture(const CastReport<3>& report);
std::string picture(const CastReport<2>& report);

}  // namespace abut::tool
