#include <abut/shape/half_space.hpp>

namespace abut {
template <int D>
Solid<D> solid(const HalfSpace<D>& half_space) {
    const DVec<D> normal(half_space.normal);
    const double norm = length(normal);
    if (norm == 0) return {axis<D>(0), static_cast<double>(half_space.offset)};
    return {normal / norm, static_cast<double>(half_space.offset) / norm};
}

template <int D>
Solid<D> mapped(const Solid<D>& solid, const Affine<D>& map) {
    const DVec<D> normal = normalized(mapped_normal(map, solid.normal), solid.normal);
    return {normal, dot(normal, map.point(solid.normal * solid.offset))};
}

template <int D>
Solid<D> rounded(const Solid<D>& solid, double radius) {
    return {solid.normal, solid.offset + radius};
}

template <int D>
Aabb<D> bounds(const Solid<D>& solid) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Aabb<D> result{Vec<D>(-infinity), Vec<D>(infinity)};
    for (int i = 0; i < D; ++i) {
        if (std::abs(solid.normal[i]) != 1) continue;
        const float border = static_cast<float>(solid.normal[i] * solid.offset);
        if (solid.normal[i] > 0)
            result.max[i] = std::nextafter(border, infinity);
        else
            result.min[i] = std::nextafter(border, -infinity);
    }
    return result;
}

#define ABUT_INSTANTIATE(D)                                      \
    template Solid<D> solid(const HalfSpace<D>&);                \
    template Solid<D> mapped(const Solid<D>&, const Affine<D>&); \
    template Solid<D> rounded(const Solid<D>&, double);          \
    template Aabb<D> bounds(const Solid<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
