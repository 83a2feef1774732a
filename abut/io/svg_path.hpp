#pragma once

// The path data of SVG as lines.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <optional>
#include <string_view>
#include <vector>

namespace abut::svg {

struct Subpath {
    std::vector<DVec<2>> points;  ///< at least one
    bool closed = false;          ///< by its author: Z
};

/// All of the path grammar: M L H V C S Q T A Z, absolute and relative
/// (https://www.w3.org/TR/SVG2/paths.html#PathDataBNF). Curves become lines that are no more than `tolerance` off them;
/// without one, a thousandth of a curve's own extent, that of its control points, or of the radius of an arc. A Problem
/// with the place of the first character that is none of it, and for curves of more than 4096 pieces.
Result<std::vector<Subpath>> flatten_path(std::string_view data, std::optional<double> tolerance = {});

}  // namespace abut::svg
