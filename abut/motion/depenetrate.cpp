#include <abut/motion/depenetrate.hpp>
#include <abut/motion/shortest_way.hpp>

namespace abut {

template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter) {
    Depenetration<D> result;
    const bool finite = is_finite(shape);
    ABUT_ASSERT(finite);
    if (!finite) return result;
    const double touching = 1e-5 * abut::size(shape);
    const ShortestWay<D> way = shortest_way_out(shape, world, filter, 10 * touching);
    result.push = to_float(way.push);
    result.depth = way.found || way.depth <= touching ? 0 : static_cast<float>(way.depth);
    return result;
}

template Depenetration<2> depenetrate_convex(const Convex<2>&, const World<2>&, const Filter&);
template Depenetration<3> depenetrate_convex(const Convex<3>&, const World<3>&, const Filter&);

}  // namespace abut
