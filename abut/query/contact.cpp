#include <abut/query/contact.hpp>
#include <abut/query/direct.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/felt_contact.hpp>
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

/// Whether the contact of the deepest pair is felt by the whole shapes.
template <int D>
bool is_felt(const View<D>& a, const View<D>& b, const std::pair<std::uint32_t, std::uint32_t>& parts,
             const SignedDistance<D>& distance, float margin) {
    bool felt = true;
    const FeltPair<D> pair(a, b);
    each_part_pair(a, b, margin,
                   [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                       if (std::pair(index_a, index_b) != parts) return true;
                       felt = pair.is_felt(part_a, part_b, distance);
                       return false;
                   });
    return felt;
}

/// Kept out of what is hot, where it would take up room.
template <int D>
[[gnu::noinline]] void by_views(const Given<D>& a, const Given<D>& b, const QueryOptions<D>& options,
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
Contact<D> contact(const Given<D>& a, const Given<D>& b, const QueryOptions<D>& options) {
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
    Contact<D> result;
    result.normal[0] = 1;
    if (!finite) return result;
    const double margin = static_cast<double>(options.margin);
    const SearchOptions<D> search = search_options(a, b, options);
    double least = margin;
    std::pair<std::uint32_t, std::uint32_t> parts;
    SignedDistance<D> deepest{};
    each_part_pair(a, b, options.margin,
                   [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                       PartContact<D> found;
                       if (!part_contact(part_a, part_b, least, margin, search, found)) return true;
                       const SignedDistance<D>& distance = found.distance;
                       if (!meet_at_fronts(part_a, part_b, distance.normal)) return true;
                       // The lowest of several as deep, so that it isn't up to the order of the visits.
                       if (result && distance.distance == least && std::pair(index_a, index_b) > parts) return true;
                       // Now, while the parts are there: a composite shape may make them up as it goes.
                       least = distance.distance;
                       parts = {index_a, index_b};
                       deepest = distance;
                       write(found.distance, found.manifold, result);
                       name_features(part_a, part_b, distance, index_a, index_b, result);
                       return true;
                   });
    if (!result || is_felt(a, b, parts, deepest, options.margin)) return result;
    // The deepest of those that are felt; of equals, the lowest.
    Contact<D> felt;
    each_contact_of<D>(a, b, options, [&](const Contact<D>& found) {
        const auto order = [](const Contact<D>& c) { return std::tuple(-c.depth, c.feature_a.part, c.feature_b.part); };
        if (!felt || order(found) < order(felt)) felt = found;
        return true;
    });
    return felt ? felt : result;
}

template Contact<2> contact(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Contact<3> contact(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Contact<2> contact(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Contact<3> contact(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Contact<3> contact(const Given<3>&, const Given<3>&, const QueryOptions<3>&);

}  // namespace abut
