#pragma once

// What `abut walk` found, as text, JSON and a picture.

#include "verbs.hpp"
#include <abut/walk/walk_mesh.hpp>
#include <abut/walk/walk_survey.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// A point that was asked for, and the nearest place on the mesh.
struct WalkEnd {
    Vec3 asked{};
    WalkPoint place;
    Vec3 point{};    ///< where the place is
    double off = 0;  ///< how far that is from what was asked
};

struct WalkOutcome {
    WalkMesh mesh;
    std::vector<std::string> objects;  ///< what it is made of; none for one that was baked
    std::vector<std::string> warnings;
    WalkSurvey survey = {};
    std::optional<WalkEnd> from = std::nullopt, to = std::nullopt;
    std::optional<WalkPath> way = std::nullopt;
    std::size_t file_bytes = 0;
    double read_seconds = 0, survey_seconds = 0, find_seconds = 0, write_seconds = 0;
};

/// Whether an end is farther from the mesh than is allowed.
bool is_beyond(const WalkRequest& request, const WalkEnd& end);

/// For a person; a verdict in the last line where a way was asked for.
std::string text_report(const WalkRequest& request, const WalkOutcome& outcome);
/// One object; numbers unrounded.
std::string json_report(const WalkRequest& request, const WalkOutcome& outcome);

/// As SVG: the mesh as it is seen from above, the axis and the side to which it faces most, and from the side where it
/// isn't flat. Islands in colours, their borders, what is wrong in red, and the way.
std::string picture(const WalkOutcome& outcome);

}  // namespace abut::tool
