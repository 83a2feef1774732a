#pragma once

// Parsers for the values of command line options.

#include "tool/check/settings.hpp"
#include "tool/verbs.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace abut::tool {

/// A finite length of at least 0.
Result<float> parse_length(const std::string& text);

inline constexpr std::size_t max_frames = 1'000'000;

/// A number of frames, 1 to `max_frames`.
Result<std::size_t> parse_frames(const std::string& text);

inline constexpr std::size_t max_threads = 1024;

/// A number of threads, 1 to `max_threads`.
Result<std::size_t> parse_threads(const std::string& text);

/// X,Y or X,Y,Z: finite numbers, one per dimension.
template <int D>
Result<Vec<D>> parse_point(const std::string& text);

/// Number of reflections of a ray, or of differences to report, 1 to 100000.
Result<std::size_t> parse_bounces(const std::string& text);

/// Maximum number of vertices of a convex part, 4 to a million.
Result<std::uint32_t> parse_vertices(const std::string& text);

/// Maximum number of parts of a mesh, 1 to 100000.
Result<std::uint32_t> parse_parts(const std::string& text);

/// The side of a cell: finite, above 0.
Result<float> parse_cell(const std::string& text);

/// A number of cells, 1 to a million.
Result<float> parse_cells(const std::string& text);

/// AXIS=N: x, y or z, and a finite number.
Result<FieldSlice> parse_slice(const std::string& text);

/// A fraction, from 0 to 1.
Result<double> parse_share(const std::string& text);

/// A time in seconds, finite.
Result<double> parse_time(const std::string& text);

/// RADIUS,HEIGHT: a radius above 0, and a height of at least twice the radius.
Result<Character> parse_character(const std::string& text);

/// WIDTH, or LEAST,WIDTH with 0 <= LEAST < WIDTH. LEAST defaults to a tenth of WIDTH.
Result<GapRange> parse_gap(const std::string& text);

/// x, y or z with an optional sign, or none.
Result<UpDirection> parse_up(const std::string& text);

/// Two glob patterns separated by one ':'.
Result<PairPattern> parse_pair(const std::string& text);

/// [CODE ]A[:B]: one glob pattern or two with one ':' between them, and before them a code such as ABUT101 and a blank.
Result<IgnorePattern> parse_ignore(const std::string& text);

}  // namespace abut::tool
