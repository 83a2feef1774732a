#include <abut/convex/farthest_point.hpp>
#include <abut/convex/features.hpp>
#include <abut/query/part_pairs.hpp>

namespace abut {

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Solid<D>& b, const SearchOptions<D>&) {
    const CorePoint<D> lowest = core_support(a, -b.normal);
    SignedDistance<D> result;
    result.normal = -b.normal;
    result.on_a = lowest.position + result.normal * a.radius;
    result.distance = dot(b.normal, result.on_a) - b.offset;
    result.corners.a[0] = lowest.index;
    return result;
}

template <int D>
SignedDistance<D> part_distance(const Solid<D>& a, const Convex<D>& b, const SearchOptions<D>&) {
    SignedDistance<D> result = part_distance(b, a);
    result.on_a = result.on_b();
    result.normal = -result.normal;
    std::swap(result.corners.a, result.corners.b);
    return result;
}

namespace {

/// The distinct ones among them.
template <int D>
struct Numbers {
    CornerNumbers<D> all{};
    std::size_t count = 0;

    Numbers(const CornerNumbers<D>& corners, std::size_t corner_count) {
        for (std::size_t i = 0; i < corner_count; ++i)
            if (std::find(all.begin(), all.begin() + count, corners[i]) == all.begin() + count)
                all[count++] = corners[i];
    }
};

/// Of a box, whose corners tell by their bits what they span. Without guesses at which it is: it is another each time.
Feature feature_on_box(const CornerNumbers<3>& corners, std::size_t count, std::uint32_t number) {
    const std::uint32_t first = corners[0];
    std::uint32_t free = 0, seen = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t corner = i < count ? corners[i] : first;
        free |= corner ^ first;
        seen |= 1u << (corner & 7u);
    }
    const std::uint32_t all_but_two = (seen & (seen - 1)) & ((seen & (seen - 1)) - 1);
    if (free == 0) return {number, first, FeatureKind::vertex};
    if (all_but_two == 0) return {number, edge_index(first, first ^ free), FeatureKind::edge};
    // The bit on which the corners agree is the axis of their side.
    const std::uint32_t axis = (free & 1u) == 0 ? 0 : (free & 2u) == 0 ? 1 : (free & 4u) == 0 ? 2 : 3;
    return {number, axis == 3 ? 0 : 2 * axis + (first >> axis & 1u), FeatureKind::face};
}

std::uint32_t face_number(const Convex<3>& part, const DVec<3>& out) {
    if (part.facets == nullptr) {
        const auto corner = [&](std::uint32_t i) { return part.place.point(DVec<3>(part.vertices()[i])); };
        const DVec<3> normal = cross(corner(1) - corner(0), corner(2) - corner(0));
        return dot(normal, out) < 0 ? 1 : 0;
    }
    const DVec<3> local = part.place.transposed(out);
    return farthest_point(part.facets->normals, local);
}

}  // namespace

template <int D>
Feature feature_on(const Convex<D>& part, const CornerNumbers<D>& corners, std::size_t count,
                   [[maybe_unused]] const DVec<D>& out, std::uint32_t number) {
    if (!has_features(part)) return {number, 0, FeatureKind::none};
    if constexpr (D == 3)
        if (part.core == Core::box) return feature_on_box(corners, count, number);
    const Numbers<D> numbers(corners, count);
    if (numbers.count == 1) return {number, numbers.all[0], FeatureKind::vertex};
    if constexpr (D == 3)
        if (numbers.count > 2) return {number, face_number(part, out), FeatureKind::face};
    return {number, edge_index(numbers.all[0], numbers.all[1]), FeatureKind::edge};
}

template <int D>
Feature feature_on(const Solid<D>&, const CornerNumbers<D>&, std::size_t, const DVec<D>&, std::uint32_t number) {
    return {number, 0, FeatureKind::none};
}

#define ABUT_INSTANTIATE(D)                                                                               \
    template SignedDistance<D> part_distance(const Convex<D>&, const Solid<D>&, const SearchOptions<D>&); \
    template SignedDistance<D> part_distance(const Solid<D>&, const Convex<D>&, const SearchOptions<D>&); \
    template Feature feature_on(const Convex<D>&, const CornerNumbers<D>&, std::size_t, const DVec<D>&,   \
                                std::uint32_t);                                                           \
    template Feature feature_on(const Solid<D>&, const CornerNumbers<D>&, std::size_t, const DVec<D>&, std::uint32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
