#pragma once

// Constructive solid geometry on fields: union, intersection, difference, smooth union, offset. And redistancing.

#include <abut/bake/field.hpp>
#include <abut/field/field.hpp>
#include <abut/math/result.hpp>

namespace abut {

/// Boolean operations on solids, sample by sample: the minimum or maximum of two distances, one of them negated for the
/// difference. Every sign is that of the two fields' look-ups. The result is not always a distance. The union is exact
/// outside, and inside it is a lower bound of the distance to the surface. The intersection and the difference are
/// exact deep inside, and outside they are lower bounds (Quilez: "SDF boolean operations are bounds"). Lower bounds are
/// safe for sphere tracing, shadows and sphere casts, which only take more steps; `field_redistance` makes them
/// distances.
///
/// By default the cell is the finer one of the two fields', and the samples coincide with that field's. Where that
/// field decides, nothing is resampled, so repeated operations don't blur it. By default the volume covers both fields.
/// Outside the samples of a field, a lower bound stands in for its distance.
///
/// The Problems are those of `bake_field`, and `bad_argument` if closest points are requested: only `field_redistance`
/// can compute them.
template <int D>
Result<Field<D>> field_union(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});
template <int D>
Result<Field<D>> field_intersection(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});
/// The points of `a` that are not in `b`.
template <int D>
Result<Field<D>> field_difference(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});

/// The union with a fillet: if the two distances differ by less than `radius`, the surface moves outwards by at most a
/// quarter of it. The result is a lower bound everywhere. Quilez (2008): "Smooth minimum", the quadratic one. The
/// radius is finite and at least 0.
template <int D>
Result<Field<D>> field_smooth_union(const Field<D>& a, const Field<D>& b, float radius,
                                    const FieldOptions<D>& options = {});

/// Grows the solid by a distance, with rounded edges, or shrinks it if the distance is negative. A grown solid's
/// distances are exact outside and lower bounds inside; a shrunk solid's are exact inside and lower bounds outside. The
/// volume grows with it.
///
/// Beyond the stored samples the surface follows the available values: lower bounds outside the volume and, in a sparse
/// field, distances at every fourth sample (every eighth in 2D). Bake with a padding and a band of at least the offset,
/// or call `field_redistance` with a larger volume first.
template <int D>
Result<Field<D>> field_offset(const Field<D>& field, float distance, const FieldOptions<D>& options = {});

/// Computes exact distances from the zero level set of a field, with the signs of the field. The level set is linear in
/// the simplices that the cells are cut into (Kuhn 1960); sharp edges are cut off by up to three quarters of a cell. By
/// default the cell, the volume and the samples are those of the field.
///
/// The Problems are those above (closest points are allowed), and `empty_input` if there is no surface within the
/// volume.
template <int D>
Result<Field<D>> field_redistance(const Field<D>& field, const FieldOptions<D>& options = {});

}  // namespace abut
