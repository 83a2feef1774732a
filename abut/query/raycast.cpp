#include <abut/query/part_pairs.hpp>
#include <abut/query/raycast.hpp>

namespace abut {
namespace {

/// Steps of the advance; each comes nearer by the whole known gap, so a handful is usual.
constexpr int most_steps = 64;

/// The ray in double, with a length that a step can be subtracted from.
template <int D>
struct Beam {
    DVec<D> origin;
    DVec<D> direction;
    double length;

    DVec<D> at(double along) const { return origin + direction * along; }
};

template <int D>
struct BeamHit {
    double along;
    DVec<D> normal;  ///< out of the shape
    bool started_inside;
    Feature feature;
};

/// A point as a shape in its own right, in double.
template <int D>
Convex<D> point_shape(const DVec<D>& position) {
    Convex<D> result;
    result.place.offset = position;
    return result;
}

/// Without inside: a point, a segment in the plane, a triangle in space.
template <int D>
bool thin(const Convex<D>& part) {
    return part.core == Core::points && part.count <= static_cast<std::uint32_t>(D) && part.radius == 0 &&
           part.inner_radius == 0;
}
template <int D>
bool thin(const Solid<D>&) {
    return false;
}

/// The ray runs up to the plane that parts its point from the shape, and again from there: the plane is never behind
/// the surface, so nothing is passed (conservative advancement; Mirtich, "Impulse-based dynamic simulation", 1996).
template <int D, class Part>
std::optional<BeamHit<D>> cast(const Beam<D>& beam, const Part& part, std::uint32_t index, double doubt,
                               Trace<D>* trace) {
    double along = 0, last_approach = 0;
    Cache cache;
    DVec<D> last_normal(0.0);
    for (int step = 0; step < most_steps; ++step) {
        const SignedDistance<D> distance =
            part_distance(part, point_shape<D>(beam.at(along)), SearchOptions<D>{&cache, trace});
        const double approach = -dot(beam.direction, distance.normal);
        const bool there = distance.distance <= doubt;
        // Every way is a way out of a thin part: what starts on one leaves it, whichever side rounding put it on.
        if (along == 0 && thin(part) && distance.distance <= 100 * doubt) return std::nullopt;
        if ((along == 0 || !there) && !(approach > 0)) return std::nullopt;
        if (there || step + 1 == most_steps) {
            // At an edge there are several ways out, and the one found may lie across the ray.
            const bool across = approach < 0.5 * last_approach;
            return BeamHit<D>{along, across ? last_normal : distance.normal, along == 0 && distance.distance < -doubt,
                              feature_on(part, distance.corners.a, distance.corners.count, distance.normal, index)};
        }
        along += distance.distance / approach;
        if (!(along <= beam.length)) return std::nullopt;
        last_approach = approach;
        last_normal = distance.normal;
    }
    return std::nullopt;
}

}  // namespace

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options) {
    const bool finite =
        is_finite(shape) && is_finite(ray.origin) && is_finite(ray.direction) && !std::isnan(ray.length);
    ABUT_ASSERT(finite);
    if (!finite) return std::nullopt;
    const Beam<D> beam{DVec<D>(ray.origin), normalized(DVec<D>(ray.direction)), static_cast<double>(ray.length)};
    std::optional<BeamHit<D>> first;
    const auto consider = [&](const auto& part, std::uint32_t index) -> bool {
        Beam<D> shorter = beam;
        if (first) shorter.length = first->along;
        const double part_size = size(View<D>(part));
        const double doubt = std::isfinite(part_size) ? 1e-7 * part_size : 0;
        const auto hit = cast(shorter, part, index, doubt, options.trace);
        if (hit && (!first || hit->along < first->along)) first = hit;
        return true;
    };
    if (const auto* composite = std::get_if<Composite<D>>(&shape)) {
        const Aabb<D> box = bounds(*composite);
        const double reach = std::min(
            beam.length, length(DVec<D>(center(box)) - beam.origin) + length(DVec<D>(box.max) - DVec<D>(box.min)));
        const Vec<D> far_end = to_float(beam.at(reach));
        each_part<D>(*composite, grown(merged(Aabb<D>{ray.origin, ray.origin}, Aabb<D>{far_end, far_end}), 0),
                     consider);
    } else if (const auto* convex = std::get_if<Convex<D>>(&shape)) {
        consider(*convex, 0);
    } else {
        consider(std::get<Solid<D>>(shape), 0);
    }
    if (!first) return std::nullopt;
    Hit<D> hit;
    hit.distance = static_cast<float>(first->along);
    hit.fraction = ray.length > 0 && std::isfinite(ray.length)
                       ? std::min(1.0f, static_cast<float>(first->along / beam.length))
                       : 0.0f;
    hit.point = to_float(beam.at(first->along));
    hit.normal = to_float(first->normal);
    hit.started_inside = first->started_inside;
    hit.feature = first->feature;
    return hit;
}

template std::optional<Hit<2>> raycast(const Ray<2>&, const View<2>&, const QueryOptions<2>&);
template std::optional<Hit<3>> raycast(const Ray<3>&, const View<3>&, const QueryOptions<3>&);

}  // namespace abut
