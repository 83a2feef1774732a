#include <abut/math/assert.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/detail/raycast/triangles.hpp>
#include <abut/query/detail/raycast/write_hit.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/raycast.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool first_hit(const DRay<D>& beam, const Composite<D>& composite, const QueryOptions<D>& options, PartHit<D>& first) {
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

/// Calls find(beam, first) for the first hit.
template <int D, class Shape, class Find>
void find_first_hit(const Ray<D>& ray, const Shape& shape, const Find& find, std::optional<Hit<D>>& result) {
    const bool finite = is_finite(shape) && is_valid_ray(ray);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const DRay<D> beam = to_dray(ray);
    PartHit<D> first;
    if (find(beam, first)) write_hit(beam, first, result.emplace());
}

template <int D>
void answer(const Ray<D>& ray, const Convex<D>& shape, const QueryOptions<D>& options, std::optional<Hit<D>>& result) {
    const auto find = [&](const DRay<D>& beam, PartHit<D>& first) {
        return part_hit(beam, shape, 0, options.trace, first);
    };
    find_first_hit(ray, shape, find, result);
}

/// Calls visit(hit) for each part that the ray hits; visit returns the new reach.
template <int D, class Visit>
void visit_hits(const DRay<D>& beam, const View<D>& shape, const QueryOptions<D>& options, Visit visit) {
    PartHit<D> hit;
    if (const auto* convex = std::get_if<Convex<D>>(&shape)) {
        if (part_hit(beam, *convex, 0, options.trace, hit)) visit(hit);
        return;
    }
    if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&shape)) {
        if (part_hit(beam, *half_space, hit)) visit(hit);
        return;
    }
    if (const auto* function = std::get_if<DistanceFunction<D>>(&shape)) {
        if (part_hit(beam, *function, hit)) visit(hit);
        return;
    }
    const auto& composite = std::get<Composite<D>>(shape);
    if constexpr (D == 3)
        if (each_triangle_hit(beam, composite, options, visit)) return;
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
    const bool finite = is_finite(shape) && is_valid_ray(ray);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const DRay<D> beam = to_dray(ray);
    double reach = beam.length;
    visit_hits(beam, shape, options, [&](const PartHit<D>& found) {
        Hit<D> hit;
        write_hit(beam, found, hit);
        reach = std::min(reach, static_cast<double>(visit(hit)));
        return reach;
    });
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
    std::optional<Hit<D>> result;
    answer(ray, shape, options, result);
    return result;
}

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const Composite<D>& shape, const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    const auto find = [&](const DRay<D>& beam, PartHit<D>& first) { return first_hit(beam, shape, options, first); };
    find_first_hit(ray, static_cast<const Placement<D>&>(shape), find, result);
    return result;
}

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const View<D>& shape, const QueryOptions<D>& options) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape)) return raycast(ray, *convex, options);
    if (const auto* composite = std::get_if<Composite<D>>(&shape)) return raycast(ray, *composite, options);
    std::optional<Hit<D>> result;
    const auto find = [&](const DRay<D>& beam, PartHit<D>& first) {
        const auto* function = std::get_if<DistanceFunction<D>>(&shape);
        return function != nullptr ? part_hit(beam, *function, first)
                                   : part_hit(beam, std::get<HalfSpaceView<D>>(shape), first);
    };
    find_first_hit(ray, shape, find, result);
    return result;
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const View<D>&, const QueryOptions<D>&);                    \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const Composite<D>&, const QueryOptions<D>&);               \
    template std::optional<Hit<D>> raycast(const Ray<D>&, const Convex<D>&, const QueryOptions<D>&);                  \
    template void each_hit(const Ray<D>&, const View<D>&, FunctionRef<float(const Hit<D>&)>, const QueryOptions<D>&); \
    template void raycast_all(const Ray<D>&, const View<D>&, std::vector<Hit<D>>&, const QueryOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
