#pragma once

// SVG drawings as levels. https://www.w3.org/TR/SVG2/

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace abut {

/// What is drawn, in the user units of the outermost <svg>, those of its viewBox: what editors show. Areas are solid
/// (fill other than none), everything else is a line without width. Left out, with a warning: text, pictures, style
/// sheets. `tolerance` as `flatten_path` has it.
Result<Level> read_svg(std::span<const std::byte> bytes, std::optional<double> tolerance);

}  // namespace abut
