#pragma once

// The hits of a ray, in double, and their conversion to the public answer. A convex part takes a closed form if there
// is one, else conservative advancement; the triangles of a mesh are searched by its tree. For .cpp files.

#include <abut/convex/gjk/trace.hpp>
#include <abut/convex/ray/ray_entry.hpp>
#include <abut/query/hit.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/part.hpp>

namespace abut::detail {

/// Like `Hit`, with a normal of any length.
template <int D>
struct PartHit {
    double along = 0;
    DVec<D> normal{0.0};  ///< out of the part, of any length
    bool started_inside = false;
    Feature feature;
};

/// Returns false, and leaves `hit` unspecified, if the ray misses.
template <int D>
bool part_hit(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit);
template <int D>
bool part_hit(const DRay<D>& beam, const detail::Part<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit);

/// Conservative advancement alone: the ray advances to the plane that separates its point from the part, and repeats
/// from there.
template <int D>
bool part_hit_by_advance(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace,
                         PartHit<D>& hit);

/// The first triangle that the ray hits within reach, the lowest of those at one distance; `found` is whether there is
/// one. Returns false, and sets nothing, if the shape isn't known by its triangles.
bool first_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                        PartHit<3>& first, bool& found);

/// Whether the ray hits a triangle within reach. Returns false, and sets nothing, if the shape isn't known by its
/// triangles.
bool any_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options, bool& found);

/// Receives one part that the ray hits; returns the new, shorter reach.
using HitVisitor = FunctionRef<double(const PartHit<3>& hit)>;

/// Visits all triangles that the ray hits within reach, roughly front to back. Returns false, and visits none, if the
/// shape isn't known by its triangles.
bool each_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                       HitVisitor visit);

/// A ray without direction has length 0.
template <int D>
[[gnu::always_inline]] inline DRay<D> to_dray(const Ray<D>& ray) {
    const DVec<D> direction(ray.direction);
    if (direction == DVec<D>(0.0)) return {DVec<D>(ray.origin), direction, 0};
    return {DVec<D>(ray.origin), unit(direction), static_cast<double>(ray.length)};
}

template <int D>
inline void write_hit(const DRay<D>& beam, double along, const DVec<D>& normal, Hit<D>& hit) {
    hit.distance = static_cast<float>(along);
    hit.fraction = beam.length > 0 && beam.length <= static_cast<double>(std::numeric_limits<float>::max())
                       ? std::min(1.0f, static_cast<float>(along / beam.length))
                       : 0.0f;
    hit.point = to_float(beam.at(along));
    hit.normal = to_float(unit(normal));
}
template <int D>
void write_hit(const DRay<D>& beam, const PartHit<D>& first, Hit<D>& hit) {
    write_hit(beam, first.along, first.normal, hit);
    hit.started_inside = first.started_inside;
    hit.feature = first.feature;
}

}  // namespace abut::detail
