#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/depenetrate.hpp>
#include <abut/motion/push/shortest_push.hpp>
#include <abut/query/detail/valid_query.hpp>

namespace abut::detail {

template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter) {
    detail::enter_library();
    Depenetration<D> result;
    if (!detail::is_valid_query(shape)) return result;
    const double touching = 1e-5 * detail::size(shape);
    const ShortestPush<D> found = shortest_push(shape, world, filter, 10 * touching);
    result.push = to_float(found.push);
    result.depth = found.found || found.depth <= touching ? 0 : static_cast<float>(found.depth);
    return result;
}

template Depenetration<2> depenetrate_convex(const Convex<2>&, const World<2>&, const Filter&);
template Depenetration<3> depenetrate_convex(const Convex<3>&, const World<3>&, const Filter&);

}  // namespace abut::detail
