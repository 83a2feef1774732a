#pragma once

// Reports of `abut decompose`: text, JSON and a picture.

#include "tool/verbs.hpp"
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
    std::optional<Fit> fit;  ///< the primitive that approximates it
};

struct DecomposeOutcome {
    std::vector<PartReport> parts;
    std::size_t triangles = 0;  ///< count of the mesh's triangles before repair
    Repairs repairs;
    DecomposeReport whole;
    std::vector<std::string> warnings;
    double read_seconds = 0, repair_seconds = 0, decompose_seconds = 0, write_seconds = 0;
};

std::string text_report(const DecomposeRequest& request, const DecomposeOutcome& outcome);
std::string json_report(const DecomposeRequest& request, const DecomposeOutcome& outcome);

/// An SVG of the parts from above and from the side, each in its own colour, drawn back to front. Deterministic.
std::string picture(const std::vector<PartReport>& parts);

}  // namespace abut::tool
