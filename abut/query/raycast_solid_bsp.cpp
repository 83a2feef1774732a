#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/query/raycast_solid_bsp.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>&) {
    detail::enter_library();
    const bool finite = is_finite(ray.origin) && is_finite(ray.direction) && !std::isnan(ray.length);
    ABUT_ASSERT(finite);
    if (!finite) return std::nullopt;
    // A ray that ends on a face hits it although its length is rounded.
    constexpr double more = 1 + 1e-7;
    const bool rests = ray.direction == Vec<D>(0.0f);
    const double length = rests ? 0 : static_cast<double>(ray.length);
    const DVec<D> direction = unit(DVec<D>(ray.direction));
    SolidEntry<D> entry;
    if (!level.enter(ray.origin, direction, length * more, entry)) return std::nullopt;
    const double along = std::min(entry.along, length);
    Hit<D> hit;
    hit.distance = static_cast<float>(along);
    hit.fraction = length > 0 && std::isfinite(length) ? std::min(1.0f, static_cast<float>(along / length)) : 0.0f;
    hit.point = to_float(DVec<D>(ray.origin) + direction * along);
    hit.normal = to_float(unit(entry.normal));
    hit.started_inside = entry.started_inside;
    if (entry.has_face) {
        hit.feature.part = entry.face;
        hit.feature.kind = D == 2 ? FeatureKind::edge : FeatureKind::face;
        hit.feature.index = D == 2 ? edge_index(0, 1) : 0;
    }
    return hit;
}

template std::optional<Hit<2>> raycast(const Ray<2>&, const SolidBsp<2>&, const QueryOptions<2>&);
template std::optional<Hit<3>> raycast(const Ray<3>&, const SolidBsp<3>&, const QueryOptions<3>&);

}  // namespace abut
