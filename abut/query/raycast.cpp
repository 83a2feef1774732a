#include <abut/math/simd/library_entry.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/detail/solid/solid_motion.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/reflect.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool first_surface_hit(const DRay<D>& beam, const Composite<D>& composite, const QueryOptions<D>& options,
                       PartHit<D>& first) {
    bool any = false;
    if constexpr (D == 3)
        if (first_triangle_hit(beam, composite, options, first, any)) return any;
    DRay<D> rest = beam;
    each_part_along<D>(composite, beam.origin, beam.direction, beam.length,
                       [&](const Convex<D>& part, std::uint32_t index) -> float {
                           PartHit<D> hit;
                           // Among hits at one distance the lowest part wins, whatever the order of the visits.
                           if (part_hit(rest, part, index, options.trace, hit) &&
                               (!any || hit.along < first.along || index < first.feature.part)) {
                               any = true;
                               first = hit;
                               rest.length = hit.along;
                           }
                           return static_cast<float>(rest.length);
                       });
    return any;
}

template <int D>
bool first_hit(const DRay<D>& beam, const Composite<D>& composite, const QueryOptions<D>& options, PartHit<D>& first) {
    if constexpr (D == 3)
        if (composite.solid != nullptr) {
            QueryOptions<3> of_both_sides = options;
            of_both_sides.back_faces = true;
            const auto surface_hit = [&](const DRay<3>& rest, PartHit<3>& hit) {
                return first_surface_hit(rest, composite, of_both_sides, hit);
            };
            return enter_solid(beam, composite, surface_hit, first);
        }
    return first_surface_hit(beam, composite, options, first);
}

template <int D>
bool first_hit(const DRay<D>& beam, const View<D>& shape, const QueryOptions<D>& options, PartHit<D>& first) {
    return detail::with_part(
        shape, [&](const Part<D>& part) { return part_hit(beam, part, 0, options.trace, first); },
        [&](const Composite<D>& composite) { return first_hit(beam, composite, options, first); });
}
template <int D>
bool first_hit(const DRay<D>& beam, const Convex<D>& shape, const QueryOptions<D>& options, PartHit<D>& first) {
    return part_hit(beam, shape, 0, options.trace, first);
}

template <int D, class Shape>
std::optional<Hit<D>> answer(const Ray<D>& ray, const Shape& shape, const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    if (!detail::is_valid_query(shape, ray)) return result;
    const DRay<D> beam = to_dray(ray);
    PartHit<D> first;
    if (first_hit(beam, shape, options, first)) write_hit(beam, first, result.emplace());
    return result;
}

template <int D>
bool any_hit(const DRay<D>& beam, const Composite<D>& composite, const QueryOptions<D>& options) {
    PartHit<D> hit;
    bool any = false;
    if constexpr (D == 3) {
        if (composite.solid != nullptr) return first_hit(beam, composite, options, hit);
        if (any_triangle_hit(beam, composite, options, any)) return any;
    }
    each_part_along<D>(composite, beam.origin, beam.direction, beam.length,
                       [&](const Convex<D>& part, std::uint32_t index) -> float {
                           any = any || part_hit(beam, part, index, options.trace, hit);
                           return any ? -1.0f : static_cast<float>(beam.length);
                       });
    return any;
}

/// Calls visit(hit) for each part of a composite shape that the ray hits; visit returns the new reach.
template <int D>
void visit_hits(const DRay<D>& beam, const Composite<D>& composite, const QueryOptions<D>& options,
                FunctionRef<double(const PartHit<D>&)> visit) {
    if constexpr (D == 3)
        if (each_triangle_hit(beam, composite, options, visit)) return;
    PartHit<D> hit;
    DRay<D> rest = beam;
    each_part_along<D>(composite, beam.origin, beam.direction, beam.length,
                       [&](const Convex<D>& part, std::uint32_t index) -> float {
                           if (part_hit(rest, part, index, options.trace, hit)) rest.length = visit(hit);
                           return static_cast<float>(rest.length);
                       });
}

}  // namespace

template <int D>
void each_hit(const Ray<D>& ray, const View<D>& shape, FunctionRef<float(const Hit<D>&)> visit,
              const QueryOptions<D>& options) {
    if (!detail::is_valid_query(shape, ray)) return;
    const DRay<D> beam = to_dray(ray);
    double reach = beam.length;
    const auto report = [&](const PartHit<D>& found) {
        Hit<D> hit;
        write_hit(beam, found, hit);
        return reach = std::min(reach, static_cast<double>(visit(hit)));
    };
    detail::with_part(
        shape,
        [&](const Part<D>& part) {
            PartHit<D> hit;
            if (part_hit(beam, part, 0, options.trace, hit)) report(hit);
        },
        [&](const Composite<D>& composite) { visit_hits<D>(beam, composite, options, report); });
}

template <int D>
void raycast_all(const Ray<D>& ray, const View<D>& shape, std::vector<Hit<D>>& out, const QueryOptions<D>& options) {
    out.clear();
    const auto collect = [&out](const Hit<D>& hit) -> float {
        out.push_back(hit);
        return std::numeric_limits<float>::infinity();
    };
    each_hit<D>(ray, shape, collect, options);
    std::sort(out.begin(), out.end(), [](const Hit<D>& a, const Hit<D>& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.feature.part < b.feature.part;
    });
}

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Convex<D>& shape, const QueryOptions<D>& options) {
    return answer(ray, shape, options);
}
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Composite<D>& shape, const QueryOptions<D>& options) {
    return answer(ray, shape, options);
}
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options) {
    return answer(ray, shape, options);
}

template <int D>
bool raycast_any(const Ray<D>& ray, const Composite<D>& shape, const QueryOptions<D>& options) {
    return detail::is_valid_query(shape, ray) && any_hit(to_dray(ray), shape, options);
}
template <int D>
bool raycast_any(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options) {
    if (const auto* const composite = std::get_if<Composite<D>>(&shape)) return raycast_any(ray, *composite, options);
    return raycast(ray, shape, options).has_value();
}

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>&) {
    detail::enter_library();
    if (!detail::is_valid_query(ray)) return std::nullopt;
    // A ray that ends on a face hits it although its length is rounded.
    constexpr double more = 1 + 1e-7;
    const DRay<D> beam = to_dray(ray);
    SolidEntry<D> entry;
    if (!level.enter(ray.origin, beam.rests() ? axis<D>(0) : beam.direction, beam.length * more, entry))
        return std::nullopt;
    Hit<D> hit;
    write_hit(beam, std::min(entry.along, beam.length), entry.normal, hit);
    hit.started_inside = entry.started_inside;
    if (entry.has_face) {
        hit.feature.part = entry.face;
        hit.feature.kind = D == 2 ? FeatureKind::edge : FeatureKind::face;
        hit.feature.index = D == 2 ? edge_index(0, 1) : 0;
    }
    return hit;
}

/// With d the direction, n the normal and s = -dot(d, n) the sine of the angle of incidence, the ray leaves along d + 2
/// s n.
///
/// The hit's point is rounded to floats, so it may lie behind the mirror. A step back along the ray by lift / s lies
/// `lift` above the mirror. It lies in free space even in a corner, where a step along the normal could go through
/// another mirror. The step displaces the reflected ray by at most twice the lift, as sin(2 a) / sin(a) <= 2.
template <int D>
Ray<D> reflect(const Ray<D>& ray, const Hit<D>& hit) {
    detail::enter_library();
    if (!detail::is_valid_query(ray, hit)) return {ray.origin, to_float(axis<D>(0)), 0};

    // More than the rounding of a direction and a normal together, and of two points.
    constexpr double min_rise = 4e-7, rounding = 4e-7;
    const DVec<D> direction = unit(DVec<D>(ray.direction)), normal = unit(DVec<D>(hit.normal)), point(hit.point);
    const double sinks = std::max(-dot(direction, normal), 0.0);
    const double lift = rounding * std::max(largest(point), largest(DVec<D>(ray.origin)));
    const double travelled = static_cast<double>(hit.distance);
    const double back = lift < sinks * travelled ? lift / sinks : travelled;

    DVec<D> away = direction + normal * (2 * sinks);
    away += normal * std::max(min_rise - dot(away, normal), 0.0);
    const double left = std::max(static_cast<double>(ray.length) - (travelled - back), 0.0);
    return {to_float(point - direction * back), to_float(normalized(away)), static_cast<float>(left)};
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const View<D>&, const QueryOptions<D>&);                    \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const Composite<D>&, const QueryOptions<D>&);               \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const Convex<D>&, const QueryOptions<D>&);                  \
    template bool raycast_any(const Ray<D>&, const View<D>&, const QueryOptions<D>&);                                 \
    template bool raycast_any(const Ray<D>&, const Composite<D>&, const QueryOptions<D>&);                            \
    template void each_hit(const Ray<D>&, const View<D>&, FunctionRef<float(const Hit<D>&)>, const QueryOptions<D>&); \
    template void raycast_all(const Ray<D>&, const View<D>&, std::vector<Hit<D>>&, const QueryOptions<D>&);           \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const SolidBsp<D>&, const QueryOptions<D>&);                \
    template Ray<D> reflect(const Ray<D>&, const Hit<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
