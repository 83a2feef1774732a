#pragma once

// Fills a field with samples of a surface. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/bake/field/bake_job.hpp>
#include <abut/bake/field/samples.hpp>
#include <abut/field/data.hpp>
#include <abut/math/result.hpp>

namespace abut::detail {

/// Evaluates `source` at the samples of `grid`, which has none yet, and adds their number to the report. A Problem if
/// there would be too many samples, or if the user cancels.
template <int D>
Result<Field<D>> fill_field(FieldData<D> grid, const SampleSource<D>& source, const FieldOptions<D>& options,
                            BakeJob& work, FieldReport& report);

}  // namespace abut::detail
