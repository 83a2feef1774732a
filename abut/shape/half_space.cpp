#include <abut/shape/half_space.hpp>

namespace abut::detail {
template <int D>
HalfSpaceView<D> half_space_view(const HalfSpace<D>& half_space) {
    const DVec<D> normal(half_space.normal);
    const double norm = length(normal);
    if (norm == 0) return {axis<D>(0), static_cast<double>(half_space.offset)};
    return {normal / norm, static_cast<double>(half_space.offset) / norm};
}

template <int D>
HalfSpaceView<D> mapped(const HalfSpaceView<D>& view, const Affine<D>& map) {
    const DVec<D> normal = normalized(mapped_normal(map, view.normal), view.normal);
    return {normal, dot(normal, map.point(view.normal * view.offset))};
}

template <int D>
HalfSpaceView<D> rounded(const HalfSpaceView<D>& view, double radius) {
    return {view.normal, view.offset + radius};
}

template <int D>
Aabb<D> bounds(const HalfSpaceView<D>& view) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Aabb<D> result{Vec<D>(-infinity), Vec<D>(infinity)};
    for (int i = 0; i < D; ++i) {
        if (std::abs(view.normal[i]) != 1) continue;
        const float boundary = static_cast<float>(view.normal[i] * view.offset);
        if (view.normal[i] > 0)
            result.max[i] = std::nextafter(boundary, infinity);
        else
            result.min[i] = std::nextafter(boundary, -infinity);
    }
    return result;
}

#define ABUT_INSTANTIATE(D)                                                      \
    template HalfSpaceView<D> half_space_view(const HalfSpace<D>&);              \
    template HalfSpaceView<D> mapped(const HalfSpaceView<D>&, const Affine<D>&); \
    template HalfSpaceView<D> rounded(const HalfSpaceView<D>&, double);          \
    template Aabb<D> bounds(const HalfSpaceView<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
