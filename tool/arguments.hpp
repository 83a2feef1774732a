#pragma once

// Arguments as they are typed, and what they mean.

#include "check.hpp"
#include "faults.hpp"
#include "verbs.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace abut::tool {

/// A finite length, not below zero.
Result<float> parse_length(const std::string& text);

inline constexpr std::size_t max_frames = 1'000'000;

/// A number of frames, 1 to `max_frames`.
Result<std::size_t> parse_frames(const std::string& text);

/// X,Y or X,Y,Z: as many finite numbers as there are dimensions.
template <int D>
Result<Vec<D>> parse_point(const std::string& text);

/// How often a ray is thrown back, 1 to a hundred thousand.
Result<std::size_t> parse_bounces(const std::string& text);

/// The most corners of a convex part, 4 to a million.
Result<std::uint32_t> parse_vertices(const std::string& text);

/// The most parts of a mesh, 1 to a hundred thousand.
Result<std::uint32_t> parse_parts(const std::string& text);

/// The side of a cell: finite, above 0.
Result<float> parse_cell(const std::string& text);

/// A number of cells, 1 to a million.
Result<float> parse_cells(const std::string& text);

/// AXIS=N: x, y or z, and a finite number.
Result<FieldSlice> parse_slice(const std::string& text);

/// A share, from 0 to 1.
Result<double> parse_share(const std::string& text);

/// A moment in seconds, finite.
Result<double> parse_time(const std::string& text);

/// RADIUS,HEIGHT: a radius above 0, and a height of at least twice as much.
Result<Character> parse_character(const std::string& text);

/// WIDTH, or LEAST,WIDTH: from 0 up, and the width above the least. Without LEAST it is a tenth of the width.
Result<GapRange> parse_gap(const std::string& text);

/// x, y or z, with or without a sign before it, or none.
Result<UpDirection> parse_up(const std::string& text);

/// Two patterns with one ':' between them.
Result<PairPattern> parse_pair(const std::string& text);

}  // namespace abut::tool
