#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>

namespace abut::detail {
namespace {

/// The limit on steps of conservative advancement. Each step covers the whole known gap, so a few suffice mostly.
constexpr int max_steps = 64;

/// A point as a shape, in double.
template <int D>
Convex<D> point_shape(const DVec<D>& position) {
    Convex<D> result;
    result.place.offset = position;
    return result;
}

/// Whether the part has no interior: a point, a segment in the plane, a triangle in space.
template <int D>
bool is_thin(const Convex<D>& part) {
    return part.core == Core::points && part.count <= static_cast<std::uint32_t>(D) && part.radius == 0 &&
           part.inner_radius == 0;
}

/// Rounding may put the start of a ray on either side of a thin part within this distance. The ray counts as the
/// smaller shape, of size 0.
template <int D>
double start_tolerance(const Convex<D>& part, const DVec<D>& start) {
    double farthest = 0;
    for (std::uint32_t i = 0; i < part.count; ++i)
        farthest = std::max(farthest, largest(part.place.point(DVec<D>(part.vertices()[i])) - start));
    return tolerance_for(0, farthest);
}

}  // namespace

/// Each step ends at the separating plane, which is never behind the surface, so the ray passes nothing (conservative
/// advancement; Mirtich, "Impulse-based dynamic simulation", 1996). The plane goes through the support point: stepping
/// by the computed distance, whose error may exceed the thickness of a nearly flat part, could pass through it.
template <int D>
bool part_hit_by_advance(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace,
                         PartHit<D>& hit) {
    const double tolerance = 1e-7 * size(part);
    double along = 0, last_approach = 0;
    Cache cache;
    DVec<D> last_normal(0.0);
    for (int step = 0; step < max_steps; ++step) {
        const SignedDistance<D> distance =
            part_distance(part, point_shape<D>(beam.at(along)), SearchOptions<D>{&cache, trace});
        const double approach = -dot(beam.direction, distance.normal);
        const double gap = dot(distance.normal, beam.at(along) - support(part, distance.normal));
        const bool is_near = distance.distance <= tolerance || gap <= 0;
        // Every direction leads out of a thin part: a ray that starts on one leaves it, on whichever side rounding put
        // it.
        if (along == 0 && is_thin(part) && distance.distance <= start_tolerance(part, beam.origin)) return false;
        if ((along == 0 || !is_near) && !(approach > 0) && !(is_near && beam.rests())) return false;
        if (is_near || step + 1 == max_steps) {
            // An edge has several normals, and the one found may be perpendicular to the ray.
            const bool across = approach < 0.5 * last_approach;
            hit = {along, across ? last_normal : distance.normal, along == 0 && distance.distance < -tolerance,
                   Feature()};
            name_feature(part, distance.corners.a, distance.corners.count, distance.normal, index, hit.feature);
            return true;
        }
        along += gap / approach;
        if (!(along <= beam.length)) return false;
        last_approach = approach;
        last_normal = distance.normal;
    }
    return false;
}

template <int D>
bool part_hit(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit) {
    if (beam.rests()) return part_hit_by_advance(beam, part, index, trace, hit);
    if (!approaches_front(part, beam.direction)) return false;
    const RayEntry<D> entry = ray_entry(part, beam);
    if (entry.answer == RayAnswer::undecided) return part_hit_by_advance(beam, part, index, trace, hit);
    if (entry.answer == RayAnswer::misses) return false;
    hit.along = entry.along;
    hit.normal = entry.normal;
    hit.started_inside = false;
    hit.feature.part = index;
    hit.feature.index = entry.index;
    hit.feature.kind = entry.kind;
    return true;
}

template <int D>
bool part_hit(const DRay<D>& beam, const detail::Part<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit) {
    if (part.is_convex()) return part_hit(beam, part.convex(), index, trace, hit);
    if (part.is_function()) return part_hit(beam, part.function(), hit);
    const DVec<D>& normal = part.half_space().normal;
    const double height = dot(normal, beam.origin) - part.half_space().offset, approach = -dot(beam.direction, normal);
    if (!(approach > 0) && !(beam.rests() && height <= 0)) return false;
    const double along = beam.rests() ? 0 : std::max(height / approach, 0.0);
    hit = {along, normal, height < 0, Feature()};
    return along <= beam.length;
}

#define ABUT_INSTANTIATE(D)                                                                                     \
    template bool part_hit_by_advance(const DRay<D>&, const Convex<D>&, std::uint32_t, Trace<D>*, PartHit<D>&); \
    template bool part_hit(const DRay<D>&, const Convex<D>&, std::uint32_t, Trace<D>*, PartHit<D>&);            \
    template bool part_hit(const DRay<D>&, const detail::Part<D>&, std::uint32_t, Trace<D>*, PartHit<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
