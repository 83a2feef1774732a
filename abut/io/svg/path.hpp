#pragma once

// Flattens SVG path data to polylines.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <optional>
#include <string_view>
#include <vector>

namespace abut::svg {

struct Subpath {
    std::vector<detail::DVec<2>> points;  ///< at least one
    bool closed = false;                  ///< by the command Z
};

/// Flattens path data: M L H V C S Q T A Z, absolute and relative
/// (https://www.w3.org/TR/SVG2/paths.html#PathDataBNF). `tolerance` is the maximum distance of a polyline from its
/// curve, in user units. The default is 1e-3 of the extent of the curve's control points, or of an arc's radius.
/// Returns a Problem with the character position of the first syntax error, and for curves of more than 4096 segments.
Result<std::vector<Subpath>> flatten_path(std::string_view data, std::optional<double> tolerance = {});

}  // namespace abut::svg
