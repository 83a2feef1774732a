#pragma once

// Bakes signed distance fields of meshes, outlines and shapes.

#include <abut/field/field.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Properties of the baked surface and field. They are the same on every machine.
struct FieldReport {
    bool closed = false;      ///< the surface bounds a volume: every sign is certain
    std::size_t gaps = 0;     ///< boundary edges of the surface, or boundary points of an outline
    std::size_t rewound = 0;  ///< triangles flipped so that neighbours are oriented consistently
    std::size_t samples = 0;  ///< samples stored
    /// samples with an uncertain sign: the winding number is within 0.25 of the threshold 0.5
    std::size_t uncertain = 0;
    std::size_t bytes = 0;  ///< memory of the stored samples
};

template <int D>
struct FieldOptions {
    /// The side of a cell; 0: a 64th of the longest side of the surface's bounding box.
    float cell = 0;

    /// Distance from the surface's bounding box to the border of the volume, in cells; at least 1.
    float padding = 3;

    /// The box that the volume covers, instead of one made from `padding`. The surface may extend beyond it.
    std::optional<Aabb<D>> volume = std::nullopt;

    FieldStore store = FieldStore::sparse;

    /// Half the width of the narrow band that a sparse field stores around the surface, in cells; at least 1.
    float band = 3;

    FieldLookup lookup = FieldLookup::linear;

    /// Stores samples in 16 bits instead of 32, with an error of at most a 65534th of the largest stored distance.
    bool quantised = false;

    /// Stores the closest point of each sample as well. In 3D this takes three times as much memory in addition.
    bool closest_points = false;

    /// Runs the work on several threads. The field does not depend on their number, bit by bit.
    Executor* executor = nullptr;

    /// Receives the share of the work that is done, in [0, 1], never decreasing; returning false cancels. The baking
    /// thread calls it.
    std::optional<FunctionRef<bool(double done)>> progress = std::nullopt;

    FieldReport* report = nullptr;  ///< optional output
};

/// Bakes the signed distance to the surface of a mesh, exact at the samples but for rounding to float.
///
/// A sample is inside if the absolute winding number of the surface is at least 0.5. Triangles are first oriented
/// consistently. If every edge is traversed equally often in both directions, the winding number is an integer, even if
/// the surface intersects itself, overlaps or is inverted. Otherwise it is the generalized winding number of Jacobson,
/// Kavan and Sorkine-Hornung (2013): "Robust inside-outside segmentation using generalized winding numbers". It closes
/// holes smoothly; an open sheet encloses only the region that it bends around. Points with equal coordinates are
/// welded.
///
/// A Problem if no triangle has an area (`empty_input`), an index names no point (`index_out_of_range`, with the
/// triangle's number), a point is NaN or infinite (`not_finite`), an option is outside its limits, a cell isn't between
/// 2^-100 and 2^100, a coordinate or a distance reaches 2^100, or a distance 2^60 cells (`bad_argument`), the volume
/// would have more than 2^31 stored samples or 2^24 cells along an axis (`too_large`), or `progress` returned false
/// (`cancelled`). Every baked field can be saved and loaded again.
Result<Field<3>> bake_field(const PointSpan<3>& points, std::span<const glm::uvec3> triangles,
                            const FieldOptions<3>& options = {});
Result<Field<3>> bake_field(const Mesh& mesh, const FieldOptions<3>& options = {});

/// Bakes the field of a changed mesh and reuses the samples of its previous field. The result equals that of baking
/// everything anew, bit by bit; the time grows with the region that the change affects.
///
/// `changed` is a box around all triangles that were removed, moved or added, both before and after; the others keep
/// their order. `options` are those of the previous bake; `padding` and `volume` are ignored, other differences are a
/// Problem (`bad_argument`). A mesh with gaps or a quantised field is baked completely. The previous mesh must not have
/// had gaps.
Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const PointSpan<3>& points,
                              std::span<const glm::uvec3> triangles, const FieldOptions<3>& options = {});
Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const Mesh& mesh,
                              const FieldOptions<3>& options = {});

/// Bakes the signed distance of a region in the plane: an outline and its holes, each without its first point repeated,
/// in either direction, possibly self-intersecting. A point is inside if it is in the outline and in no hole. A point
/// is in a ring if the ring's winding number around it isn't zero.
Result<Field<2>> bake_field(const PointSpan<2>& outline, std::span<const std::vector<Vec2>> holes = {},
                            const FieldOptions<2>& options = {});

/// Bakes the signed distance that `closest` reports, for any shape with a finite bounding box.
template <int D>
Result<Field<D>> bake_field(const AnyShape<D>& shape, const FieldOptions<D>& options = {});
template <Ownable S>
requires(!std::same_as<S, Mesh> && !std::same_as<S, AnyShape<dimension<S>>>) Result<Field<dimension<S>>> bake_field(
    const S& shape, const FieldOptions<dimension<S>>& options = {}) {
    return bake_field(AnyShape<dimension<S>>(shape), options);
}

}  // namespace abut
