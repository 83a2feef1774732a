#pragma once

// Fields made of fields: together, in common, one without the other, blended, grown. And distances made exact again.

#include <abut/bake/field.hpp>
#include <abut/field/field.hpp>
#include <abut/math/result.hpp>

namespace abut {

/// The operations on solids, sample by sample: the least or the largest of two distances, one of them with its sign
/// turned. Every sign is right, as a look-up in the two fields has it. But what comes out is not always a distance: of
/// the union it is one outside of it, and inside a lower bound of how far the surface is; of the intersection and the
/// difference it is one deep inside, and outside a lower bound (Quilez: "SDF boolean operations are bounds"). Lower
/// bounds are safe for rays, shadows and sphere casts, which only take more steps; where they are not good enough
/// `field_redistance` makes them distances.
///
/// Of the options the cell is by default the finer one of the two fields', the samples then falling together with that
/// field's, so that where it decides nothing is rounded: work on a field again and again and it doesn't blur. The
/// volume is by default one that covers both. Where only one field has samples, the other is known by a lower bound.
///
/// A Problem as `bake_field` has it, and where closest points are asked for (`bad_argument`): only `field_redistance`
/// knows them.
template <int D>
Result<Field<D>> field_union(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});
template <int D>
Result<Field<D>> field_intersection(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});
/// What is of `a` and not of `b`.
template <int D>
Result<Field<D>> field_difference(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {});

/// The union with its inner edges filled: where the two distances differ by less than `radius` the surface leaves both,
/// by at most a quarter of it. A lower bound everywhere. Quilez (2008): "Smooth minimum", the quadratic one. The radius
/// is finite and at least 0.
template <int D>
Result<Field<D>> field_smooth_union(const Field<D>& a, const Field<D>& b, float radius,
                                    const FieldOptions<D>& options = {});

/// Grown by a distance, its edges rounded, or shrunk where that is below zero. Exact on the side that the surface comes
/// from; on the other side a lower bound. The volume grows with it. Where the surface gets beyond the samples of the
/// field it follows what is known there, lower bounds outside of the volume and, of a sparse field, distances at every
/// fourth sample (in the plane every eighth): bake with as much padding and band as is to be added, or redistance with
/// a larger volume before.
template <int D>
Result<Field<D>> field_offset(const Field<D>& field, float distance, const FieldOptions<D>& options = {});

/// The distances from the surface that the field shows: where it is linear between the corners of the simplices that
/// its cells are cut into (Kuhn 1960), told exactly for each sample, with the signs of the field. By default with its
/// cell, its volume and its samples. Edges are cut off, by up to three quarters of a cell.
///
/// A Problem as above (closest points are fine), and where there is no surface within the volume (`empty_input`).
template <int D>
Result<Field<D>> field_redistance(const Field<D>& field, const FieldOptions<D>& options = {});

}  // namespace abut
