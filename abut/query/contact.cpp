#include <abut/query/contact.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/detail/write_answer.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
Contact<D> no_contact() {
    Contact<D> result;
    result.normal[0] = 1;
    return result;
}

/// For two convex parts, or two parts of any kind.
template <int D, class PartType>
void contact_of_parts(const PartType& a, const PartType& b, const QueryOptions<D>& options, Contact<D>& result) {
    const double margin = static_cast<double>(options.margin);
    PartContact<D> found;
    if (!part_contact<D>(a, b, margin, margin, {options.cache, options.trace}, found)) return;
    if (!touch_at_fronts<D>(a, b, found.distance.normal)) return;
    write(found.distance, found.manifold, result);
    name_features(a, b, found.distance, 0, 0, result);
}

template <int D>
void answer(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options, Contact<D>& result) {
    if (detail::is_valid_pair(a, b)) contact_of_parts<D>(a, b, options, result);
}

/// The deepest pair of parts that touch, if any do.
template <int D>
std::optional<PairDistance<D>> deepest_pair(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const SearchOptions<D> search = search_options(a, b, options);
    double limit = static_cast<double>(options.margin);
    std::optional<PairDistance<D>> result;
    detail::for_each_part_pair(
        a, b, options.margin,
        [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
            PartContact<D> found;
            if (!part_distance_within<D>(part_a, part_b, limit, limit, search, found)) return true;
            if (!touch_at_fronts(part_a, part_b, found.distance.normal)) return true;
            const PairDistance<D> pair{found.distance, index_a, index_b};
            if (result && !comes_before(pair, *result)) return true;
            result = pair;
            limit = found.distance.distance;
            return true;
        });
    return result;
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
    Contact<D> result = no_contact<D>();
    if (!std::holds_alternative<Composite<D>>(a) && !std::holds_alternative<Composite<D>>(b)) {
        contact_of_parts(single_part(a), single_part(b), options, result);
        return result;
    }
    const std::optional<PairDistance<D>> deepest = deepest_pair(a, b, options);
    if (!deepest || whole_contact(a, b, options, *deepest, result)) return result;
    each_surface_contact<D>(a, b, options, {}, [&](const SurfaceContact<D>& found) {
        if (!result || found.contact.depth > result.depth) result = found.contact;
        return true;
    });
    return result;
}

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Contact<3> contact(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
