#pragma once

// What `abut field` made, as text, JSON and a picture.

#include "field_error.hpp"
#include "verbs.hpp"
#include "written.hpp"
#include <abut/bake/field.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

template <int D>
struct FieldOutcome {
    Field<D> field;
    std::size_t parts = 0;  ///< triangles, or objects of a level
    FieldReport report;
    FieldErrors errors;
    std::size_t file_bytes = 0;
    std::vector<std::string> warnings;
    double read_seconds = 0, bake_seconds = 0, measure_seconds = 0, write_seconds = 0;
};

/// Whether some signs are a matter of judgement: the surface stops somewhere, or more than a thousandth of the samples
/// is in doubt.
bool has_doubts(const FieldReport& report);

template <int D>
std::string text_report(const FieldRequest& request, const FieldOutcome<D>& outcome);
template <int D>
std::string json_report(const FieldRequest& request, const FieldOutcome<D>& outcome);

/// What a field is, in two lines: its volume, samples and memory.
template <int D>
std::string described(const Field<D>& field);
template <int D>
Json json_of(const Field<D>& field);

/// "1.23 MB"; less than a tenth of that in kB.
std::string megabytes(std::size_t bytes);

/// Bands of equal distance, blue inside and sand outside, with the lines between them; the line where the distance is
/// 0; and the surface in red. One slice at each place asked for, at the middle of each axis without. The same bytes for
/// the same field.
std::string picture(const Field3& field, std::span<const std::array<Vec3, 3>> triangles,
                    std::span<const FieldSlice> slices);
/// Of a level, with y pointing down as in its file.
std::string picture(const Field2& field);

}  // namespace abut::tool
