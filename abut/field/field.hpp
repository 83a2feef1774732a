#pragma once

// A signed distance field: sampled once, evaluated anywhere.

#include <abut/field/data.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <cstddef>
#include <memory>
#include <span>

namespace abut {

/// Samples of the signed distance to a surface in a volume: negative inside, 0 on the surface. `bake_field` samples a
/// mesh, an outline or any shape; bake/combine_fields.hpp combines fields. A field is a shape: solid where the distance
/// is at most 0. Immutable: copies share the data.
///
/// Distances are interpolated between samples. The error is up to about `cell()` at edges and corners of the surface,
/// and elsewhere its curvature times the square of `cell()`: docs/fields.md has measurements.
template <int D>
class Field {
public:
    /// For bakers and loaders, not for users. `data` must be consistent.
    explicit Field(detail::FieldData<D> data);

    /// The signed distance, interpolated within the volume. Outside the volume it is a lower bound of the distance to
    /// the surface in the volume. A solid that the volume cuts ends at its border. Infinite if a coordinate isn't
    /// finite.
    float distance(const Vec<D>& point) const;

    /// The distance and the direction of its steepest increase: of unit length, always valid.
    FieldSample<D> sample(const Vec<D>& point) const;

    /// A closest point of the surface: from stored closest points if the field has them, else by descending along the
    /// gradient. For a point outside the volume, that of the nearest point of the volume.
    Vec<D> closest(const Vec<D>& point) const;

    /// Batched queries by SIMD, bit by bit equal to the single ones. `out` is as long as `points`.
    void distance(std::span<const Vec<D>> points, std::span<float> out) const;
    void sample(std::span<const Vec<D>> points, std::span<FieldSample<D>> out) const;

    /// The share of a light that arrives at a point, in [0, 1]: 0 behind an obstacle, and less than 1 if an obstacle is
    /// close to the ray. `softness` is the radius of the light divided by its distance, at least 0; 0 makes hard
    /// shadows. A larger softness never lets more light through. The result covers the outer half of the true penumbra:
    /// it starts from 0 at the boundary of the hard shadow. A thin obstacle lets as much light through as if the inner
    /// half were symmetric. The shadow is never smaller than that of a point light.
    ///
    /// A point at most one cell inside counts as on the surface; deeper points are dark, and everything is if the light
    /// is inside. Obstacles in the first cell of the ray are ignored. After Quilez (2010): "Free penumbra shadows for
    /// raymarching distance fields", with the improvement of Aaltonen (2018) and further ones: docs/fields.md has
    /// measurements.
    float shadow(const Vec<D>& point, const Vec<D>& light, float softness = 0.05f) const;

    /// Ambient occlusion at a point of the surface, in [0, 1]: the openness along its normal up to the distance
    /// `reach`; 1 if nothing is near, or if `reach` is 0. Only obstacles in the volume are certain to count. After
    /// Evans (2006): "Fast approximations for global illumination on dynamic scenes".
    float ambient_occlusion(const Vec<D>& point, const Vec<D>& normal, float reach) const;

    /// Batched queries, bit by bit equal to the single ones. All spans are equally long.
    void shadow(std::span<const Vec<D>> points, const Vec<D>& light, float softness, std::span<float> out) const;
    void ambient_occlusion(std::span<const Vec<D>> points, std::span<const Vec<D>> normals, float reach,
                           std::span<float> out) const;

    /// The box that contains the samples.
    Aabb<D> volume() const;
    /// The side of a cell: the spacing of the samples.
    float cell() const { return data_->cell; }
    /// The memory of the samples.
    std::size_t bytes() const;

    const detail::FieldData<D>& data() const { return *data_; }  ///< not for users

private:
    std::shared_ptr<const detail::FieldData<D>> data_;
};

using Field2 = Field<2>;
using Field3 = Field<3>;

/// The bounding box of the solid; empty if there is none.
template <int D>
Aabb<D> bounds(const Field<D>& field);

/// The field as a shape, for every query. The results are exact for the interpolated distance, even for thin parts
/// between samples. Refers to the field and must not outlive it.
template <int D>
DistanceFunction<D> view(const Field<D>& field);

}  // namespace abut
