#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/overlaps.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool part_overlaps(const Convex<D>& a, const HalfSpaceView<D>& b, const SearchOptions<D>&) {
    return part_distance(a, b).distance <= 0;
}
template <int D>
bool part_overlaps(const HalfSpaceView<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    return part_overlaps(b, a, options);
}

}  // namespace

template <int D>
bool overlaps(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    return finite && part_overlaps(a, b, SearchOptions<D>{options.cache, options.trace});
}

template <int D>
bool overlaps(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options) {
    if (options.trace == nullptr) {
        const ClosedFormAnswer answer = closed_form_overlap(a, b, options.cache);
        if (answer != ClosedFormAnswer::unknown) return answer == ClosedFormAnswer::yes;
    }
    return overlaps(convex_of(a), convex_of(b), options);
}

template <int D>
bool overlaps(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const auto *convex_a = std::get_if<Convex<D>>(&a), *convex_b = std::get_if<Convex<D>>(&b);
    if (convex_a != nullptr && convex_b != nullptr) return overlaps(*convex_a, *convex_b, options);
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return false;
    const SearchOptions<D> search = search_options(a, b, options);
    bool found = false;
    each_part_pair(a, b, 0, [&](const auto& part_a, std::uint32_t, const auto& part_b, std::uint32_t) {
        found = part_overlaps(part_a, part_b, search);
        return !found;
    });
    return found;
}

template bool overlaps(const View<2>&, const View<2>&, const QueryOptions<2>&);
template bool overlaps(const View<3>&, const View<3>&, const QueryOptions<3>&);
template bool overlaps(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template bool overlaps(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template bool overlaps(const ShapeRef<2>&, const ShapeRef<2>&, const QueryOptions<2>&);
template bool overlaps(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
