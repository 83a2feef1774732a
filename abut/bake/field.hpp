#pragma once

// Signed distance fields of meshes, outlines and shapes.

#include <abut/field/field.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// What became of a surface. The same on every machine.
struct FieldReport {
    bool closed = false;       ///< the surface bounds a volume: every sign is certain
    std::size_t gaps = 0;      ///< edges, or ends of segments in 2D, that the surface stops at
    std::size_t rewound = 0;   ///< triangles that were turned round to go with their neighbours
    std::size_t samples = 0;   ///< that are kept
    std::size_t doubtful = 0;  ///< of these: the winding number is within 0.25 of the 0.5 that parts in from out
    std::size_t bytes = 0;     ///< of what is kept
};

template <int D>
struct FieldOptions {
    /// The side of a cell; 0: a 64th of the longest side of the surface's box.
    float cell = 0;

    /// How far the volume goes beyond the surface, in cells; at least 1.
    float padding = 3;

    /// Where wanted, the box that the volume covers, instead of one by `padding`; the surface may reach out of it.
    std::optional<Aabb<D>> volume = std::nullopt;

    FieldStore store = FieldStore::sparse;

    /// Sparse: how far from the surface samples are kept at least, in cells; from 1 on.
    float band = 3;

    FieldLookup lookup = FieldLookup::linear;

    /// Samples of 16 bits instead of 32: right to a 65534th of the farthest distance that is kept.
    bool quantised = false;

    /// Keeps the closest point of each sample too: three times as much memory again in space.
    bool closest_points = false;

    /// Several threads, where given. No bit of the field depends on it.
    Executor* executor = nullptr;

    /// Is told now and then which share of the work is done, in [0, 1], never less than before; false cancels. From the
    /// thread that bakes.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    FieldReport* report = nullptr;  ///< where wanted
};

/// The signed distance to the surface of a mesh at the samples, exact but for rounding to float.
///
/// A sample is inside where the winding number of the surface, without its sign, is at least 0.5. Triangles that go
/// round against their neighbours are turned before. Where each edge is run along as often one way as the other it is a
/// whole number, whatever crosses, overlaps or is inside out. Else it is that of Jacobson, Kavan and Sorkine-Hornung
/// (2013): "Robust inside-outside segmentation using generalized winding numbers", which closes holes smoothly; a sheet
/// alone encloses nothing but what it bends round. Points in exactly the same place are one.
///
/// A Problem where no triangle with an area is left (`empty_input`), an index names no point (`index_out_of_range`,
/// with the triangle's number), a point is NaN or infinite (`not_finite`), an option is outside of its limits, a cell
/// isn't between 2^-100 and 2^100, a coordinate or a distance reaches 2^100, or a distance 2^60 cells (`bad_argument`),
/// the volume would have more than 2^31 samples kept or 2^24 cells along an axis (`too_large`), or progress said so
/// (`cancelled`). All that is baked can be loaded again.
Result<Field<3>> bake_field(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                            const FieldOptions<3>& options = {});
Result<Field<3>> bake_field(const Mesh& mesh, const FieldOptions<3>& options = {});

/// The field of a mesh that has changed, from the one of how it was: the same samples, bit by bit, as baking all of it
/// at the same places gives, in a time that depends on how far the change is felt. `changed` holds all triangles that
/// were taken away, moved or added, as they were and as they are; the others are still in the same order. `options` are
/// those that the field was baked with, but for `padding` and `volume`, which stay as they were (else `bad_argument`).
/// Where the mesh has gaps, or the field 16 bits, all of it is baked; the mesh as it was had no gaps either.
Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, std::span<const Vec3> points,
                              std::span<const glm::uvec3> triangles, const FieldOptions<3>& options = {});
Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const Mesh& mesh,
                              const FieldOptions<3>& options = {});

/// The same of the inside of closed outlines in the plane: an outline and its holes, each without its first point
/// again, in either direction, crossing or not. A place is inside where it is inside of the outline and of no hole; and
/// inside of a ring where the winding number isn't zero.
Result<Field<2>> bake_field(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes = {},
                            const FieldOptions<2>& options = {});

/// The signed distance of any shape with a finite box, as `closest` tells it.
template <int D>
Result<Field<D>> bake_field(const AnyShape<D>& shape, const FieldOptions<D>& options = {});
template <Ownable S>
requires(!std::same_as<S, Mesh> && !std::same_as<S, AnyShape<dimension<S>>>) Result<Field<dimension<S>>> bake_field(
    const S& shape, const FieldOptions<dimension<S>>& options = {}) {
    return bake_field(AnyShape<dimension<S>>(shape), options);
}

}  // namespace abut
