#pragma once

// Parsers for SVG attributes: lengths with units, transforms and styles.
// https://www.w3.org/TR/SVG2/, https://www.w3.org/TR/css-transforms-1/#svg-syntax

#include <abut/math/affine.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <string_view>

namespace abut::svg {

/// Parses a length to user units. Percentages are relative to `whole`; font units assume 16 pixels. Returns nothing if
/// the text is no length.
std::optional<double> length(std::string_view text, double whole);

/// Parses a `transform` attribute; the last function of the list applies first. Returns a Problem with the character
/// position of the first error.
Result<detail::Affine<2>> transform(std::string_view text);

/// The value of a property in a `style` attribute: the last one if it is declared repeatedly, nothing if it isn't
/// declared.
std::optional<std::string_view> declared(std::string_view style, std::string_view property);

}  // namespace abut::svg
