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
void answer(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options, Contact<D>& result) {
    if (!detail::is_valid_pair(a, b)) return;
    const double margin = static_cast<double>(options.margin);
    PartContact<D> found;
    if (!part_contact(a, b, margin, margin, {options.cache, options.trace}, found)) return;
    if (!touch_at_fronts(a, b, found.distance.normal)) return;
    write(found.distance, found.manifold, result);
    name_features(a, b, found.distance, 0, 0, result);
}

/// The deepest pair of parts.
template <int D>
struct Deepest {
    Contact<D> contact;
    std::pair<std::uint32_t, std::uint32_t> parts;
    PartContact<D> found;
};

template <int D>
Deepest<D> deepest_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const double margin = static_cast<double>(options.margin);
    const SearchOptions<D> search = search_options(a, b, options);
    Deepest<D> result{no_contact<D>(), {}, {}};
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
            if (result.contact && distance.distance == limit && parts > result.parts) return true;
            // Written during the visit: a composite shape may create its parts as it goes.
            limit = distance.distance;
            result.parts = parts;
            result.found = found;
            write(found.distance, found.manifold, result.contact);
            name_features(part_a, part_b, distance, index_a, index_b, result.contact);
            return true;
        });
    return result;
}

/// Whether the normal of the deepest pair is a surface normal of both shapes.
template <int D>
bool is_surface_contact(const View<D>& a, const View<D>& b, const Deepest<D>& deepest, float margin,
                        const NeighbourSurfaces<D>& neighbours) {
    bool is_surface = true;
    const EdgeFilter<D> filter(a, b, neighbours);
    detail::for_each_part_pair(
        a, b, margin, [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            if (std::pair(index_a, index_b) != deepest.parts) return true;
            const PartContact<D>& found = deepest.found;
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
ContactWithNeighbours<D> only_contact(const View<D>& a, const View<D>& b, const Deepest<D>& deepest,
                                      const NeighbourSurfaces<D>& neighbours) {
    ContactWithNeighbours<D> result;
    result.contact = deepest.contact;
    EdgeFilter<D> filter(a, b, neighbours);
    detail::for_each_part_pair(
        a, b, 0, [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            PartContact<D> found = deepest.found;
            const detail::SurfaceNormalFlags flags = filter.surface_normal_flags(
                part_a, part_b, found.distance, [&]() -> const Manifold<D>& { return found.manifold; });
            if (flags) return false;
            const bool is_replaced = filter.replace(part_a, part_b, flags, found);
            if (found.distance.distance > 0) {
                result.contact = {};
                return false;
            }
            result.surface_normals = flags;
            if (!is_replaced) return false;
            write(found.distance, found.manifold, result.contact);
            name_features(part_a, part_b, found.distance, index_a, index_b, result.contact);
            return false;
        });
    return result;
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
    answer(convex_of(a), convex_of(b), options, result);
}

}  // namespace

template <int D>
Contact<D> contact(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Contact<D> result = no_contact<D>();
    answer(a, b, options, result);
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
    const auto *convex_a = std::get_if<Convex<D>>(&a), *convex_b = std::get_if<Convex<D>>(&b);
    if (convex_a != nullptr && convex_b != nullptr) return contact(*convex_a, *convex_b, options);
    if (!detail::is_valid_pair(a, b)) return no_contact<D>();
    if constexpr (D == 3)
        if (are_solids(a, b)) return solid_contact(a, b, options.margin);
    const Deepest<D> deepest = deepest_of(a, b, options);
    const bool has_parts = std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
    if (!deepest.contact || !has_parts || are_meshes(a, b) || is_surface_contact<D>(a, b, deepest, options.margin, {}))
        return deepest.contact;
    const ContactWithNeighbours<D> surface = deepest_surface_contact<D>(a, b, options, {});
    return surface.contact ? surface.contact : deepest.contact;
}

}  // namespace abut

namespace abut::detail {

template <int D>
ContactWithNeighbours<D> contact_with_neighbours(const View<D>& a, const View<D>& b,
                                                 const NeighbourSurfaces<D>& neighbours) {
    ContactWithNeighbours<D> result;
    if constexpr (D == 3)
        if (are_solids(a, b)) {
            result.contact = solid_contact(a, b, 0);
            result.touch = static_cast<bool>(result.contact);
            return result;
        }
    const Deepest<D> deepest = deepest_of<D>(a, b, {});
    if (!deepest.contact) return result;
    const bool has_parts = std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
    if (!has_parts)
        result = only_contact(a, b, deepest, neighbours);
    else if (is_surface_contact(a, b, deepest, 0, neighbours))
        result.contact = deepest.contact;
    else
        result = deepest_surface_contact<D>(a, b, {}, neighbours);
    result.touch = true;
    return result;
}

template ContactWithNeighbours<2> contact_with_neighbours(const View<2>&, const View<2>&, const NeighbourSurfaces<2>&);
template ContactWithNeighbours<3> contact_with_neighbours(const View<3>&, const View<3>&, const NeighbourSurfaces<3>&);
}  // namespace abut::detail

namespace abut {

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Contact<3> contact(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
