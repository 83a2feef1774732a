#pragma once

// Fills a field with the samples that a surface tells. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/bake/field_samples.hpp>
#include <abut/bake/field_work.hpp>
#include <abut/field/field_data.hpp>
#include <abut/math/result.hpp>

namespace abut {

/// `grid` is a field without samples, `source` tells them. Adds to the report how many there are. A Problem where too
/// many would be kept, or where the user cancels.
template <int D>
Result<Field<D>> fill_field(FieldData<D> grid, const SampleSource<D>& source, const FieldOptions<D>& options,
                            FieldWork& work, FieldReport& report);

}  // namespace abut
