// Contacts of two shapes, as a manifold. `QueryOptions::margin` is a speculative margin: surfaces up to that far
// apart have contact points too, with a negative depth.

#include <abut/query/contact.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/detail/write_answer.hpp>

#include <tuple>
#include <utility>

namespace abut {

using namespace detail;

namespace {

template <int D>
Contact<D> no_contact() {
    Contact<D> result;
    result.normal[0] = 1;
    return result;
}

template <int D>
bool has_parts(const View<D>& a, const View<D>& b) {
    return std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
}

/// Returns false, and leaves `result`, if the sets don't touch.
template <int D>
bool answer(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options, PartContact<D>& found,
            Contact<D>& result) {
    if (!detail::is_valid_pair(a, b)) return false;
    const double margin = static_cast<double>(options.margin);
    if (!part_contact(a, b, margin, margin, {options.cache, options.trace}, found)) return false;
    if (!touch_at_fronts(a, b, found.distance.normal)) return false;
    write(found.distance, found.manifold, result);
    name_features(a, b, found.distance, 0, 0, result);
    return true;
}

/// Finds the deepest pair of parts. Returns false, and leaves `result`, if the shapes don't touch.
template <int D>
bool find_deepest(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, DeepestParts<D>& deepest,
                  Contact<D>& result) {
    deepest.parts = {};
    const auto *convex_a = std::get_if<Convex<D>>(&a), *convex_b = std::get_if<Convex<D>>(&b);
    if (convex_a != nullptr && convex_b != nullptr)
        return answer(*convex_a, *convex_b, options, deepest.contact, result);
    if (!detail::is_valid_pair(a, b)) return false;
    const double margin = static_cast<double>(options.margin);
    const SearchOptions<D> search = search_options(a, b, options);
    bool touch = false;
    double limit = margin;
    detail::for_each_part_pair(
        a, b, options.margin,
        [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            PartContact<D> found;
            if (!part_contact<D>(part_a, part_b, limit, margin, search, found)) return true;
            const SignedDistance<D>& distance = found.distance;
            if (!touch_at_fronts(part_a, part_b, distance.normal)) return true;
            const std::pair parts(index_a, index_b);
            // Among equally deep pairs the lowest wins, whatever the order of the visits.
            if (touch && distance.distance == limit && parts > deepest.parts) return true;
            // Written during the visit: a composite shape may create its parts as it goes.
            touch = true;
            limit = distance.distance;
            deepest.parts = parts;
            deepest.contact = found;
            write(found.distance, found.manifold, result);
            name_features(part_a, part_b, distance, index_a, index_b, result);
            return true;
        });
    return touch;
}

/// Whether the normal of the deepest pair is a surface normal of both shapes.
template <int D>
bool is_surface_contact(const View<D>& a, const View<D>& b, const DeepestParts<D>& deepest, float margin,
                        const NeighbourSurfaces<D>& neighbours) {
    bool is_surface = true;
    const EdgeFilter<D> filter(a, b, neighbours);
    detail::for_each_part_pair(
        a, b, margin, [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            if (std::pair(index_a, index_b) != deepest.parts) return true;
            const PartContact<D>& found = deepest.contact;
            is_surface = static_cast<bool>(filter.surface_normal_flags(
                part_a, part_b, found.distance, [&]() -> const Manifold<D>& { return found.manifold; }));
            return false;
        });
    return is_surface;
}

/// The deepest contact with a surface normal; of equals, the lowest parts.
template <int D>
ContactWithNeighbours<D> deepest_surface_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                                                 const NeighbourSurfaces<D>& neighbours) {
    ContactWithNeighbours<D> result;
    each_contact_with_neighbours<D>(a, b, options, neighbours,
                                    [&](const Contact<D>& found, const detail::SurfaceNormalFlags& flags) {
                                        const auto order = [](const Contact<D>& c) {
                                            return std::tuple(-c.depth, c.feature_a.part, c.feature_b.part);
                                        };
                                        if (result.contact && order(found) >= order(result.contact)) return true;
                                        result.contact = found;
                                        result.surface_normals = flags;
                                        return true;
                                    });
    return result;
}

/// Two shapes of one part each: their one contact, or its replacement.
template <int D>
void filter_only_contact(const View<D>& a, const View<D>& b, const PartContact<D>& only,
                         const NeighbourSurfaces<D>& neighbours, ContactWithNeighbours<D>& result) {
    const Part<D> part_a = single_part(a), part_b = single_part(b);
    EdgeFilter<D> filter(a, b, neighbours);
    const detail::SurfaceNormalFlags flags = filter.surface_normal_flags(
        part_a, part_b, only.distance, [&]() -> const Manifold<D>& { return only.manifold; });
    if (flags) return;
    PartContact<D> found = only;
    const bool is_replaced = filter.replace(part_a, part_b, flags, found);
    if (found.distance.distance > 0) {
        result.contact = {};
        return;
    }
    result.surface_normals = flags;
    if (!is_replaced) return;
    write(found.distance, found.manifold, result.contact);
    name_features(part_a, part_b, found.distance, 0, 0, result.contact);
}

Contact<3> solid_contact(const View<3>& a, const View<3>& b, float margin) {
    const Closest<3> nearest = closest(a, b);
    return nearest.distance <= margin ? contact_of_solids(a, b, nearest) : no_contact<3>();
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

/// Out of line, to keep the fast path small.
template <int D>
[[gnu::noinline]] void by_views(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options,
                                Contact<D>& result) {
    PartContact<D> found;
    answer(convex_of(a), convex_of(b), options, found, result);
}

}  // namespace

template <int D>
Contact<D> contact(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Contact<D> result = no_contact<D>();
    PartContact<D> found;
    answer(a, b, options, found, result);
    return result;
}

template <int D>
Contact<D> contact(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options) {
    Contact<D> result = no_contact<D>();
    if (options.trace != nullptr ||
        !closed_form_contact(a, b, static_cast<double>(options.margin), options.cache, result))
        by_views(a, b, options, result);
    return result;
}

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    if constexpr (D == 3)
        if (are_solids(a, b) && detail::is_valid_pair(a, b)) return solid_contact(a, b, options.margin);
    Contact<D> result = no_contact<D>();
    DeepestParts<D> deepest;
    if (!find_deepest(a, b, options, deepest, result) || !has_parts(a, b) || are_meshes(a, b) ||
        is_surface_contact<D>(a, b, deepest, options.margin, {}))
        return result;
    const ContactWithNeighbours<D> surface = deepest_surface_contact<D>(a, b, options, {});
    return surface.contact ? surface.contact : result;
}

}  // namespace abut

namespace abut::detail {

template <int D>
bool find_deepest_parts(const View<D>& a, const View<D>& b, DeepestParts<D>& deepest, Contact<D>& contact) {
    if constexpr (D == 3)
        if (are_solids(a, b)) {
            contact = detail::is_valid_pair(a, b) ? solid_contact(a, b, 0) : no_contact<D>();
            return static_cast<bool>(contact);
        }
    return find_deepest(a, b, {}, deepest, contact);
}

template <int D>
ContactWithNeighbours<D> contact_with_neighbours(const View<D>& a, const View<D>& b, const DeepestParts<D>& deepest,
                                                 const Contact<D>& contact, const NeighbourSurfaces<D>& neighbours) {
    ContactWithNeighbours<D> result{contact, {}};
    if (are_solids(a, b)) return result;
    if (!has_parts(a, b))
        filter_only_contact(a, b, deepest.contact, neighbours, result);
    else if (!is_surface_contact(a, b, deepest, 0, neighbours))
        result = deepest_surface_contact<D>(a, b, {}, neighbours);
    return result;
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template bool find_deepest_parts(const View<D>&, const View<D>&, DeepestParts<D>&, Contact<D>&);                  \
    template ContactWithNeighbours<D> contact_with_neighbours(const View<D>&, const View<D>&, const DeepestParts<D>&, \
                                                              const Contact<D>&, const NeighbourSurfaces<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail

namespace abut {

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Contact<3> contact(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
