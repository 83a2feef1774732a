#include <abut/query/contains.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/overlaps.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool any_parts_overlap(const View<D>& a, const View<D>& b, const SearchOptions<D>& options) {
    bool found = false;
    detail::for_each_part_pair(a, b, 0,
                               [&](const Part<D>& part_a, std::uint32_t, const Part<D>& part_b, std::uint32_t) {
                                   found = part_overlaps<D>(part_a, part_b, options);
                                   return !found;
                               });
    return found;
}

}  // namespace

template <int D>
bool overlaps(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    return detail::is_valid_pair(a, b) && part_overlaps(a, b, SearchOptions<D>{options.cache, options.trace});
}

template <>
bool overlaps(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    if (options.trace == nullptr) {
        const PairAnswer answer = closed_form_overlap(a, b, options.cache);
        if (answer != PairAnswer::unknown) return answer == PairAnswer::yes;
    }
    return overlaps(convex_of(a), convex_of(b), options);
}

template <int D>
bool overlaps(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    if (!detail::is_valid_pair(a, b)) return false;
    if (any_parts_overlap(a, b, search_options(a, b, options))) return true;
    if constexpr (D == 3) return has_solid(a, b) && is_inside_other(a, b);
    return false;
}

template <int D>
bool contains(const View<D>& shape, const Vec<D>& point) {
    if (!detail::is_valid_query(shape, point)) return false;
    const auto* composite = std::get_if<Composite<D>>(&shape);
    if (composite != nullptr && contains_inside(*composite, point)) return true;
    return any_parts_overlap<D>(shape, View<D>(round_points<D>({point}, 0)), {});
}

#define ABUT_INSTANTIATE(D)                                                             \
    template bool overlaps(const View<D>&, const View<D>&, const QueryOptions<D>&);     \
    template bool overlaps(const Convex<D>&, const Convex<D>&, const QueryOptions<D>&); \
    template bool contains(const View<D>&, const Vec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
