#pragma once

// The small grammars of SVG's attributes: lengths with units, transforms, styles.
// https://www.w3.org/TR/SVG2/, https://www.w3.org/TR/css-transforms-1/#svg-syntax

#include <abut/math/linear.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <string_view>

namespace abut::svg {

/// A length in user units; a percentage is one of `whole`. The units of fonts count as of 16 pixels. Nothing where the
/// text is none.
std::optional<double> length(std::string_view text, double whole);

/// The map that a `transform` attribute writes, the last of its list first. A Problem with the place of what isn't one.
Result<Affine<2>> transform(std::string_view text);

/// The value of a property in a `style` attribute; nothing where it has none. Of several the last.
std::optional<std::string_view> declared(std::string_view style, std::string_view property);

}  // namespace abut::svg
