#pragma once

// Reports of `abut walk`: text, JSON and a picture.

#include "tool/verbs.hpp"
#include <abut/walk/survey.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// A requested point, and the nearest point on the mesh.
struct WalkEnd {
    Vec3 requested{};
    WalkPoint place;
    Vec3 point{};         ///< position of `place`
    double distance = 0;  ///< distance from the requested point
};

struct WalkOutcome {
    WalkMesh mesh;
    std::vector<std::string> objects;  ///< paths of its objects; empty for a baked mesh
    std::vector<std::string> warnings;
    WalkSurvey survey = {};
    std::optional<WalkEnd> from = std::nullopt, to = std::nullopt;
    std::optional<WalkPath> path = std::nullopt;
    std::size_t file_bytes = 0;
    double read_seconds = 0, survey_seconds = 0, find_seconds = 0, write_seconds = 0;
};

/// True if an end is farther from the mesh than --reach allows.
bool is_beyond(const WalkRequest& request, const WalkEnd& end);

/// Text for people, with a verdict in the last line if a path was requested.
std::string text_report(const WalkRequest& request, const WalkOutcome& outcome);
/// One JSON object; numbers unrounded.
std::string json_report(const WalkRequest& request, const WalkOutcome& outcome);

/// An SVG of the mesh from above, along the axis that most of it faces, and from the side unless it is flat. Connected
/// components in different colours, boundaries, faults in red, and the path.
std::string picture(const WalkOutcome& outcome);

}  // namespace abut::tool
