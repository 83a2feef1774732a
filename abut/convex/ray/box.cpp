#include <abut/convex/ray/closed_forms.hpp>

namespace abut::detail {
namespace {

template <int D>
void name_side(RayEntry<D>& entry, std::uint32_t axis, bool low) {
    if constexpr (D == 3) {
        entry.kind = FeatureKind::face;
        entry.index = 2 * axis + (low ? 1u : 0u);
    } else {
        const std::uint32_t corner = low ? 1u << axis : 0u;
        entry.kind = FeatureKind::edge;
        entry.index = edge_index(corner, corner | 1u << (1 - axis));
    }
}

}  // namespace

template <int D>
RayEntry<D> enter_box(const DRay<D>& ray, const DVec<D>& half, double radius) {
    double lower = -std::numeric_limits<double>::infinity(), upper = ray.length;
    int side = 0;
    for (int i = 0; i < D; ++i) {
        const double reach = half[i] + radius, from = ray.origin[i], step = ray.direction[i];
        if (std::abs(step) < std::numeric_limits<double>::min()) {
            if (std::abs(from) > reach) return ray_misses<D>();
            continue;
        }
        const double inverse = 1 / step, far = std::copysign(reach, step);
        const double in = (-far - from) * inverse;
        if (in > lower) {
            lower = in;
            side = i;
        }
        upper = std::min(upper, (far - from) * inverse);
    }
    // The slab test is exact to the last digits, so that rays don't pass through boxes of no thickness.
    if (lower > upper || upper < 0) return ray_misses<D>();
    const double tolerance = ray_tolerance * (largest(ray.origin) + largest(half) + radius);
    if (!(lower * std::abs(ray.direction[side]) > tolerance)) return {};
    if (radius > 0)
        for (int i = 0; i < D; ++i)
            if (i != side && std::abs(ray.origin[i] + ray.direction[i] * lower) > half[i]) return {};
    RayEntry<D> result;
    result.answer = RayAnswer::enters;
    result.along = lower;
    const bool low = ray.direction[side] > 0;
    result.normal = axis<D>(side, low ? -1 : 1);
    name_side(result, static_cast<std::uint32_t>(side), low);
    return result;
}

template RayEntry<2> enter_box(const DRay<2>&, const DVec<2>&, double);
template RayEntry<3> enter_box(const DRay<3>&, const DVec<3>&, double);

}  // namespace abut::detail
