#pragma once

// Reports of `abut field`: text, JSON and a picture.

#include "tool/field/field_error.hpp"
#include "tool/shared/format.hpp"
#include "tool/verbs.hpp"
#include <abut/bake/field.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

template <int D>
struct FieldOutcome {
    Field<D> field;
    std::size_t parts = 0;  ///< count of triangles, or of objects of a level
    FieldReport report;
    FieldErrors errors;
    std::size_t file_bytes = 0;
    std::vector<std::string> warnings;
    double read_seconds = 0, bake_seconds = 0, measure_seconds = 0, write_seconds = 0;
};

/// True if signs are uncertain: the surface has gaps, or the winding number is ambiguous at more than 0.1 % of the
/// samples.
bool has_uncertain_signs(const FieldReport& report);

template <int D>
std::string text_report(const FieldRequest& request, const FieldOutcome<D>& outcome);
template <int D>
std::string json_report(const FieldRequest& request, const FieldOutcome<D>& outcome);

/// A description of a field in two lines: volume, samples and memory.
template <int D>
std::string described(const Field<D>& field);
template <int D>
Json json_of(const Field<D>& field);

/// "1.23 MB", or kB below 0.1 MB.
std::string megabytes(std::size_t bytes);

/// An SVG of contour bands, blue inside and sand outside, with contour lines, the zero line, and the surface in red.
/// One slice per coordinate given, by default the middle of each axis. Deterministic.
std::string picture(const Field3& field, std::span<const std::array<Vec3, 3>> triangles,
                    std::span<const FieldSlice> slices);
/// An SVG of a level's field, with y down as in its file.
std::string picture(const Field2& field);

}  // namespace abut::tool
