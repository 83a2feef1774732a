#pragma once

// Reads SVG drawings as levels. https://www.w3.org/TR/SVG2/

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace abut::detail {

/// Reads all drawn shapes in the user units of the outermost <svg>'s viewBox, as editors show them. Filled shapes are
/// solid; others are lines without width. Text, images and style sheets are left out with a warning. `tolerance`: see
/// `flatten_path`.
Result<Level> read_svg(std::span<const std::byte> bytes, std::optional<double> tolerance);

}  // namespace abut::detail
