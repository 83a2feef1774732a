#include <abut/query/part_pairs.hpp>

namespace abut {

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Solid<D>& b, const SearchOptions<D>&) {
    const CorePoint<D> lowest = core_support(a, -b.normal);
    SignedDistance<D> result;
    result.normal = -b.normal;
    result.on_a = lowest.position + result.normal * a.radius;
    result.distance = dot(b.normal, result.on_a) - b.offset;
    result.face.count = 1;
    result.face.weights[0] = 1;
    result.face.points[0] = {lowest.position, lowest.position, DVec<D>(0.0), lowest.index, 0};
    return result;
}

template <int D>
SignedDistance<D> signed_distance(const Solid<D>& a, const Convex<D>& b, const SearchOptions<D>&) {
    SignedDistance<D> result = signed_distance(b, a);
    result.on_a = result.on_b();
    result.normal = -result.normal;
    std::swap(result.face.points[0].index_a, result.face.points[0].index_b);
    return result;
}

template <int D>
Feature feature_on(const Simplex<D>& face, std::uint32_t DifferencePoint<D>::*index, std::uint32_t part) {
    std::uint32_t least = face.points[0].*index, most = least;
    bool third = false;
    for (std::size_t i = 1; i < face.count; ++i) {
        const std::uint32_t next = face.points[i].*index;
        third = third || (least != most && next != least && next != most);
        least = std::min(least, next);
        most = std::max(most, next);
    }
    if (third) return {part, least, FeatureKind::face};
    if (least != most) return {part, least | most << 16, FeatureKind::edge};
    return {part, least, FeatureKind::vertex};
}

#define ABUT_INSTANTIATE(D)                                                                                 \
    template SignedDistance<D> signed_distance(const Convex<D>&, const Solid<D>&, const SearchOptions<D>&); \
    template SignedDistance<D> signed_distance(const Solid<D>&, const Convex<D>&, const SearchOptions<D>&); \
    template Feature feature_on(const Simplex<D>&, std::uint32_t DifferencePoint<D>::*, std::uint32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
