#include <abut/convex/manifold.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/part_pairs.hpp>

namespace abut {
namespace {

template <int D>
Manifold<D> parts_manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                           Trace<D>* trace) {
    return manifold(a, b, distance, margin, trace);
}
template <int D>
Manifold<D> parts_manifold(const Convex<D>& a, const Solid<D>& b, const SignedDistance<D>&, double margin, Trace<D>*) {
    return manifold_with_plane(a, b.normal, b.offset, margin);
}
template <int D>
Manifold<D> parts_manifold(const Solid<D>& a, const Convex<D>& b, const SignedDistance<D>&, double margin, Trace<D>*) {
    return manifold_with_plane(b, a.normal, a.offset, margin);
}

template <int D>
Contact<D> answer(const Manifold<D>& found, const SignedDistance<D>& distance, const std::array<Feature, 2>& features) {
    Contact<D> result;
    result.normal = to_float(distance.normal);
    result.depth = static_cast<float>(-distance.distance);
    for (std::size_t i = 0; i < found.count; ++i)
        result.points.push_back(
            {to_float(found.points[i].position), static_cast<float>(found.points[i].depth), found.points[i].feature});
    result.feature_a = features[0];
    result.feature_b = features[1];
    return result;
}

}  // namespace

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    Contact<D> result;
    result.normal[0] = 1;
    if (!finite) return result;
    const double margin = static_cast<double>(options.margin);
    const SearchOptions<D> search = search_options(a, b, options);
    double least = margin;
    each_part_pair(a, b, options.margin,
                   [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                       const SignedDistance<D> distance = part_distance(part_a, part_b, search);
                       if (distance.distance > least || (result && distance.distance == least)) return true;
                       // Now, while the parts are there: a composite shape may make them up as it goes.
                       least = distance.distance;
                       result = answer(parts_manifold(part_a, part_b, distance, margin, options.trace), distance,
                                       features_of(part_a, part_b, distance, index_a, index_b));
                       return true;
                   });
    return result;
}

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);

}  // namespace abut
