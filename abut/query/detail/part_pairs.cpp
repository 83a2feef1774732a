#include <abut/convex/farthest_point.hpp>
#include <abut/convex/features.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>

namespace abut::detail {
namespace {

template <int D>
SignedDistance<D> distance_from_plane(const Convex<D>& set, const HalfSpaceView<D>& half_space) {
    const CorePoint<D> lowest = core_support(set, -half_space.normal);
    SignedDistance<D> result;
    result.normal = -half_space.normal;
    result.on_a = lowest.position + result.normal * set.radius;
    result.distance = dot(half_space.normal, result.on_a) - half_space.offset;
    result.corners.a[0] = lowest.index;
    return result;
}

/// A convex part and a half-space, in either order.
template <int D>
SignedDistance<D> distance_of_half_space(const Part<D>& a, const Part<D>& b) {
    const bool reversed = a.is_half_space();
    SignedDistance<D> result = distance_from_plane((reversed ? b : a).convex(), (reversed ? a : b).half_space());
    if (reversed) flip(result);
    return result;
}

/// The kinds of the two parts are in their order.
template <int D>
bool ordered_contact(const Part<D>& a, const Part<D>& b, double reach, double margin, PartContact<D>& contact) {
    if (!a.is_convex() || b.is_function()) return function_contact(a, b, reach, margin, contact);
    contact.distance = distance_from_plane(a.convex(), b.half_space());
    if (contact.distance.distance > reach) return false;
    contact.manifold = manifold_with_plane(a.convex(), b.half_space().normal, b.half_space().offset, margin);
    return true;
}

}  // namespace

template <int D>
bool mixed_overlaps(const Part<D>& a, const Part<D>& b) {
    if (a.is_function() || b.is_function()) return function_overlap(a, b);
    return mixed_distance(a, b).distance <= 0;
}

template <int D>
SignedDistance<D> mixed_distance(const Part<D>& a, const Part<D>& b) {
    if (a.is_function() || b.is_function()) return function_distance(a, b, DistanceRequest{});
    return distance_of_half_space(a, b);
}

template <int D>
bool mixed_contact(const Part<D>& a, const Part<D>& b, double reach, double margin, PartContact<D>& contact) {
    if (a.kind() <= b.kind()) return ordered_contact(a, b, reach, margin, contact);
    if (!ordered_contact(b, a, reach, margin, contact)) return false;
    flip(contact);
    return true;
}

namespace {

/// The bits of a box's corners tell which feature they span. The code has no branches: the feature changes from call to
/// call, so a branch would be mispredicted.
void name_box_feature(const CornerIndices<3>& corners, std::size_t count, Feature& feature) {
    const std::uint32_t first = corners[0];
    std::uint32_t free = 0, used = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t corner = i < count ? corners[i] : first;
        free |= corner ^ first;
        used |= 1u << (corner & 7u);
    }
    const std::uint32_t all_but_two = (used & (used - 1)) & ((used & (used - 1)) - 1);
    // All corners of a face agree on the bit of its axis.
    const std::uint32_t axis = (free & 1u) == 0 ? 0 : (free & 2u) == 0 ? 1 : (free & 4u) == 0 ? 2 : 3;
    const bool is_corner = free == 0, is_edge = all_but_two == 0;
    feature.kind = is_corner ? FeatureKind::vertex : is_edge ? FeatureKind::edge : FeatureKind::face;
    feature.index = is_corner   ? first
                    : is_edge   ? edge_index(first, first ^ free)
                    : axis == 3 ? 0
                                : 2 * axis + (first >> axis & 1u);
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
void name_feature(const Convex<D>& part, const CornerIndices<D>& corners, std::size_t count,
                  [[maybe_unused]] const DVec<D>& out, std::uint32_t number, Feature& feature) {
    feature.part = number;
    feature.index = 0;
    feature.kind = FeatureKind::none;
    if (!has_features(part)) return;
    if (count == 2) return name_end_or_edge(corners[0], corners[1], number, feature);
    if constexpr (D == 3)
        if (part.core == Core::box) return name_box_feature(corners, count, feature);
    // A corner may appear twice.
    std::size_t i = 1;
    while (i < count && corners[i] == corners[0]) ++i;
    if (i >= count) {
        feature.index = corners[0];
        feature.kind = FeatureKind::vertex;
        return;
    }
    const std::uint32_t other = corners[i];
    if constexpr (D == 3) {
        while (i < count && (corners[i] == corners[0] || corners[i] == other)) ++i;
        if (i < count) {
            feature.index = face_number(part, out);
            feature.kind = FeatureKind::face;
            return;
        }
    }
    feature.index = edge_index(corners[0], other);
    feature.kind = FeatureKind::edge;
}

template <int D>
void name_feature(const AnyPart<D>& part, const CornerIndices<D>& corners, std::size_t count, const DVec<D>& out,
                  std::uint32_t number, Feature& feature) {
    if (part.is_convex()) return name_feature(part.convex(), corners, count, out, number, feature);
    feature = {number, 0, FeatureKind::none};
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template bool mixed_overlaps(const Part<D>&, const Part<D>&);                                                     \
    template SignedDistance<D> mixed_distance(const Part<D>&, const Part<D>&);                                        \
    template bool mixed_contact(const Part<D>&, const Part<D>&, double, double, PartContact<D>&);                     \
    template void name_feature(const Convex<D>&, const CornerIndices<D>&, std::size_t, const DVec<D>&, std::uint32_t, \
                               Feature&);                                                                             \
    template void name_feature(const Part<D>&, const CornerIndices<D>&, std::size_t, const DVec<D>&, std::uint32_t,   \
                               Feature&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
