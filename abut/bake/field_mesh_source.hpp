#pragma once

// The samples that the surface of a mesh tells. For .cpp files.

#include <abut/bake/field_samples.hpp>
#include <abut/bake/field_surface.hpp>
#include <abut/field/field_data.hpp>

#include <memory>

namespace abut {

/// At the samples of a grid. Doesn't refer to the surface afterwards.
std::unique_ptr<const SampleSource<3>> mesh_source(const FieldSurface& surface, const FieldData<3>& grid);

}  // namespace abut
