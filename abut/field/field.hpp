#pragma once

// A signed distance field: how far inside or outside is every point of a volume? Measured once, looked up anywhere.

#include <abut/field/field_data.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/distance_function.hpp>

#include <cstddef>
#include <memory>
#include <span>

namespace abut {

/// A volume of samples of the signed distance to a surface: below zero inside, 0 on it. `bake_field` makes one of a
/// mesh, an outline or any shape; what bake/combine_fields.hpp holds makes one of others. A shape: solid where the
/// distance is at most 0. Immutable: copies share the data.
///
/// Between samples the distance is interpolated, so that it is off by up to about `cell()` at edges and corners of the
/// surface and by its curvature times the square of `cell()` elsewhere: docs/fields.md measures it.
template <int D>
class Field {
public:
    /// Not for users, who bake or load one. What `data` says of itself must be true.
    explicit Field(FieldData<D> data);

    /// Signed; within the volume interpolated. Outside of it a lower bound: what is in the volume of the surface is at
    /// least as far. Where the volume cuts the solid, the solid ends with it. Infinite for what is no point.
    float distance(const Vec<D>& point) const;

    /// The distance, and the direction in which it grows most: of length 1, always valid.
    FieldSample<D> sample(const Vec<D>& point) const;

    /// A point of the surface closest to this one: where the field was baked with closest points from those, else by
    /// walking down the distance. Outside of the volume that of the nearest point of the volume.
    Vec<D> closest(const Vec<D>& point) const;

    /// The same for many points at once, by vectors; bit by bit what the ones above give. `out` is as long as `points`.
    void distance(std::span<const Vec<D>> points, std::span<float> out) const;
    void sample(std::span<const Vec<D>> points, std::span<FieldSample<D>> out) const;

    /// How much of a light arrives at a point, in [0, 1]: 0 behind something, and less than 1 where something is close
    /// to the way. `softness` is the radius of the light as a share of its distance, at least 0; 0 makes hard shadows.
    /// A larger one never lets more light through. The half of a true penumbra that lies in the light is told, and from
    /// 0 on, as what is thin would let light through if the other half were: the shadow is never smaller than that of a
    /// light without extent.
    ///
    /// A point less than a cell within counts as on the surface, deeper ones are dark, and so is all where the light is
    /// within. Of the first cell of the way nothing is said. After Quilez (2010): "Free penumbra shadows for
    /// raymarching distance fields", as Aaltonen (2018) improved them, and a little more: docs/fields.md measures it.
    float shadow(const Vec<D>& point, const Vec<D>& light, float softness = 0.05f) const;

    /// How much of the light from all around arrives at a point of the surface, in [0, 1]: told by how open it is along
    /// its normal as far as `reach`; 1 where nothing is near, and for a reach of 0. Only what is in the volume is sure
    /// to be seen. After Evans (2006): "Fast approximations for global illumination on dynamic scenes".
    float ambient_occlusion(const Vec<D>& point, const Vec<D>& normal, float reach) const;

    /// The same for many points at once; bit by bit. All spans are equally long.
    void shadow(std::span<const Vec<D>> points, const Vec<D>& light, float softness, std::span<float> out) const;
    void ambient_occlusion(std::span<const Vec<D>> points, std::span<const Vec<D>> normals, float reach,
                           std::span<float> out) const;

    /// The box in which there are samples.
    Aabb<D> volume() const;
    /// The side of a cell: how far samples are apart.
    float cell() const { return data_->cell; }
    /// What its samples take, in memory.
    std::size_t bytes() const;

    const FieldData<D>& data() const { return *data_; }  ///< not for users

private:
    std::shared_ptr<const FieldData<D>> data_;
};

using Field2 = Field<2>;
using Field3 = Field<3>;

/// Around all that is solid; empty where nothing is.
template <int D>
Aabb<D> bounds(const Field<D>& field);

/// As a shape, for every question: what is thin but in the samples is met, and the answers are right for the distance
/// as it is interpolated. Refers to the field, and must not outlive it.
template <int D>
DistanceFunction<D> view(const Field<D>& field);

}  // namespace abut
