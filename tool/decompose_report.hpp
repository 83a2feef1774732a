#pragma once

// What `abut decompose` found, as text, JSON and a picture.

#include "verbs.hpp"
#include <abut/bake/decompose.hpp>
#include <abut/bake/fit.hpp>
#include <abut/bake/repair.hpp>
#include <abut/shape/polyhedron.hpp>

#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

struct PartReport {
    std::string name;
    Polyhedron part;
    double concavity = 0;
    std::optional<Fit> fit;  ///< what it nearly is
};

struct DecomposeOutcome {
    std::vector<PartReport> parts;
    std::size_t triangles = 0;  ///< of the mesh as it was read
    Repairs repairs;
    DecomposeReport whole;
    std::vector<std::string> warnings;
    double read_seconds = 0, repair_seconds = 0, decompose_seconds = 0, write_seconds = 0;
};

std::string text_report(const DecomposeRequest& request, const DecomposeOutcome& outcome);
std::string json_report(const DecomposeRequest& request, const DecomposeOutcome& outcome);

/// The parts from above and the side, each in a colour of its own, those in front over those behind. The same bytes for
/// the same parts.
std::string picture(const std::vector<PartReport>& parts);

}  // namespace abut::tool
