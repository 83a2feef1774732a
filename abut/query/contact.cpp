#include <abut/query/contact.hpp>
#include <abut/query/contact_among.hpp>
#include <abut/query/direct.hpp>
#include <abut/query/one_sided.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/write_answer.hpp>

#include <tuple>
#include <utility>

namespace abut {
namespace {

template <int D>
void answer(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options, Contact<D>& result) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    const double margin = static_cast<double>(options.margin);
    PartContact<D> found;
    if (!finite || !part_contact(a, b, margin, margin, {options.cache, options.trace}, found)) return;
    if (!meet_at_fronts(a, b, found.distance.normal)) return;
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
    Deepest<D> result;
    result.contact.normal[0] = 1;
    double least = margin;
    each_part_pair(a, b, options.margin,
                   [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                       PartContact<D> found;
                       if (!part_contact(part_a, part_b, least, margin, search, found)) return true;
                       const SignedDistance<D>& distance = found.distance;
                       if (!meet_at_fronts(part_a, part_b, distance.normal)) return true;
                       const std::pair parts(index_a, index_b);
                       // The lowest of several as deep, so that it isn't up to the order of the visits.
                       if (result.contact && distance.distance == least && parts > result.parts) return true;
                       // Now, while the parts are there: a composite shape may make them up as it goes.
                       least = distance.distance;
                       result.parts = parts;
                       result.found = found;
                       write(found.distance, found.manifold, result.contact);
                       name_features(part_a, part_b, distance, index_a, index_b, result.contact);
                       return true;
                   });
    return result;
}

/// Whether the contact of the deepest pair is felt by the whole shapes.
template <int D>
bool is_felt(const View<D>& a, const View<D>& b, const Deepest<D>& deepest, float margin, const Others<D>& others) {
    bool felt = true;
    const FeltPair<D> pair(a, b, others);
    each_part_pair(
        a, b, margin, [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
            if (std::pair(index_a, index_b) != deepest.parts) return true;
            const PartContact<D>& found = deepest.found;
            felt = static_cast<bool>(
                pair.felt_by(part_a, part_b, found.distance, [&]() -> const Manifold<D>& { return found.manifold; }));
            return false;
        });
    return felt;
}

/// The deepest of those that are felt; of equals, the lowest.
template <int D>
ContactAmong<D> deepest_felt(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                             const Others<D>& others) {
    ContactAmong<D> result;
    each_contact_among<D>(a, b, options, others, [&](const Contact<D>& found, const FeltBy& felt) {
        const auto order = [](const Contact<D>& c) { return std::tuple(-c.depth, c.feature_a.part, c.feature_b.part); };
        if (result.contact && order(found) >= order(result.contact)) return true;
        result.contact = found;
        result.felt = felt;
        return true;
    });
    return result;
}

/// Two shapes of one part each: their one contact, or what stands in for it.
template <int D>
ContactAmong<D> only_contact(const View<D>& a, const View<D>& b, const Deepest<D>& deepest, const Others<D>& others) {
    ContactAmong<D> result;
    result.contact = deepest.contact;
    FeltPair<D> pair(a, b, others);
    each_part_pair(a, b, 0, [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
        PartContact<D> found = deepest.found;
        const FeltBy by =
            pair.felt_by(part_a, part_b, found.distance, [&]() -> const Manifold<D>& { return found.manifold; });
        if (by) return false;
        const bool is_replaced = pair.replace(part_a, part_b, by, found);
        if (found.distance.distance > 0) {
            result.contact = {};
            return false;
        }
        result.felt = by;
        if (!is_replaced) return false;
        write(found.distance, found.manifold, result.contact);
        name_features(part_a, part_b, found.distance, index_a, index_b, result.contact);
        return false;
    });
    return result;
}

/// Kept out of what is hot, where it would take up room.
template <int D>
[[gnu::noinline]] void by_views(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options,
                                Contact<D>& result) {
    answer(convex_of(a), convex_of(b), options, result);
}

}  // namespace

template <int D>
Contact<D> contact(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Contact<D> result;
    result.normal[0] = 1;
    answer(a, b, options, result);
    return result;
}

template <int D>
Contact<D> contact(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options) {
    Contact<D> result;
    result.normal[0] = 1;
    if (options.trace != nullptr || !direct_contact(a, b, static_cast<double>(options.margin), options.cache, result))
        by_views(a, b, options, result);
    return result;
}

template <int D>
Contact<D> contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const auto *convex_a = std::get_if<Convex<D>>(&a), *convex_b = std::get_if<Convex<D>>(&b);
    if (convex_a != nullptr && convex_b != nullptr) return contact(*convex_a, *convex_b, options);
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    Deepest<D> deepest;
    deepest.contact.normal[0] = 1;
    if (!finite) return deepest.contact;
    deepest = deepest_of(a, b, options);
    const bool has_parts = std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
    if (!deepest.contact || !has_parts || is_felt<D>(a, b, deepest, options.margin, {})) return deepest.contact;
    const ContactAmong<D> felt = deepest_felt<D>(a, b, options, {});
    return felt.contact ? felt.contact : deepest.contact;
}

template <int D>
ContactAmong<D> contact_among(const View<D>& a, const View<D>& b, const Others<D>& others) {
    ContactAmong<D> result;
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return result;
    const Deepest<D> deepest = deepest_of<D>(a, b, {});
    if (!deepest.contact) return result;
    const bool has_parts = std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
    if (!has_parts)
        result = only_contact(a, b, deepest, others);
    else if (is_felt(a, b, deepest, 0, others))
        result.contact = deepest.contact;
    else
        result = deepest_felt<D>(a, b, {}, others);
    result.touch = true;
    return result;
}

template ContactAmong<2> contact_among(const View<2>&, const View<2>&, const Others<2>&);
template ContactAmong<3> contact_among(const View<3>&, const View<3>&, const Others<3>&);
template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Contact<3> contact(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
