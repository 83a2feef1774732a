// Contacts of two shapes, as a manifold. `QueryOptions::margin` is a speculative margin: surfaces up to that far
// apart have contact points too, with a negative depth.

#include <abut/query/contact.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/query/overlaps.hpp>

#include <utility>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool has_parts(const View<D>& a, const View<D>& b) {
    return std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
}

/// Two triangles have no inside, so between two meshes the deepest pair decides, as it does in `closest`.
template <int D>
bool are_meshes(const View<D>& a, const View<D>& b) {
    const auto is_mesh = [](const View<D>& shape) {
        const auto* composite = std::get_if<Composite<D>>(&shape);
        return composite != nullptr && composite->triangles != nullptr;
    };
    return is_mesh(a) && is_mesh(b);
}

/// Returns false, and leaves `result`, if the parts, which are convex sets or of any kind, don't touch.
template <int D, class PartType>
bool answer(const PartType& a, const PartType& b, const QueryOptions<D>& options, PartContact<D>& found,
            Contact<D>& result) {
    const double margin = static_cast<double>(options.margin);
    if (!part_contact<D>(a, b, margin, margin, {options.cache, options.trace}, found)) return false;
    if (!touch_at_fronts<D>(a, b, found.distance.normal)) return false;
    write(found.distance, found.manifold, result);
    name_features(a, b, found.distance, 0, 0, result);
    return true;
}

}  // namespace

template <int D>
Contact<D> contact(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Contact<D> result = no_contact<D>();
    PartContact<D> found;
    if (detail::is_valid_pair(a, b)) answer(a, b, options, found, result);
    return result;
}

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    Contact<D> result = no_contact<D>();
    if (!detail::is_valid_pair(a, b)) return result;
    if constexpr (D == 3)
        if (has_solid(a, b) && find_solid_contact(a, b, options.margin, result)) return result;
    DeepestParts<D> deepest;
    if (!find_deepest_parts(a, b, options, deepest, result) || !has_parts(a, b) ||
        whole_contact(a, b, options, deepest, are_meshes(a, b), result))
        return result;
    each_surface_contact<D>(a, b, options, {}, [&](const SurfaceContact<D>& found) {
        if (!result || found.contact.depth > result.depth) result = found.contact;
        return true;
    });
    return result;
}

}  // namespace abut

namespace abut::detail {

template <int D>
bool find_deepest_parts(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, DeepestParts<D>& deepest,
                        Contact<D>& contact) {
    const auto *convex_a = std::get_if<Convex<D>>(&a), *convex_b = std::get_if<Convex<D>>(&b);
    if (convex_a != nullptr && convex_b != nullptr)
        return answer(*convex_a, *convex_b, options, deepest.contact, contact);
    if (!has_parts(a, b)) return answer(single_part(a), single_part(b), options, deepest.contact, contact);
    if (are_solids(a, b)) return overlaps(a, b);
    const SearchOptions<D> search = search_options(a, b, options);
    double limit = static_cast<double>(options.margin);
    PairDistance<D> first;
    bool touch = false;
    detail::for_each_part_pair(
        a, b, options.margin,
        [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            PartContact<D> found;
            if (!part_distance_within<D>(part_a, part_b, limit, limit, search, found)) return true;
            if (!touch_at_fronts(part_a, part_b, found.distance.normal)) return true;
            // Among equally deep pairs the lowest wins, whatever the order of the visits.
            const bool is_lower = std::pair(index_a, index_b) < std::pair(first.index_a, first.index_b);
            if (touch && found.distance.distance == limit && !is_lower) return true;
            touch = true;
            first = {found.distance, index_a, index_b};
            limit = found.distance.distance;
            return true;
        });
    deepest.index_a = first.index_a;
    deepest.index_b = first.index_b;
    deepest.contact.distance = first.distance;
    if constexpr (D == 3) return touch || (has_solid(a, b) && is_inside_other(a, b));
    return touch;
}

template bool find_deepest_parts(const View<2>&, const View<2>&, const QueryOptions<2>&, DeepestParts<2>&, Contact<2>&);
template bool find_deepest_parts(const View<3>&, const View<3>&, const QueryOptions<3>&, DeepestParts<3>&, Contact<3>&);

}  // namespace abut::detail

namespace abut {

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);

}  // namespace abut
