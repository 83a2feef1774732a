#include <abut/motion/depenetrate.hpp>
#include <abut/motion/get_out.hpp>

namespace abut {

template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter) {
    Depenetration<D> result;
    const bool finite = is_finite(shape);
    ABUT_ASSERT(finite);
    if (!finite) return result;
    NearSurface<D> near;
    near.begin(world, filter, shape, DVec<D>(0.0), nullptr);
    const double touching = 1e-5 * near.size();
    const WayOut<D> way = way_out(near, DVec<D>(0.0), 0.0, 10 * touching, 10 * touching);
    result.push = to_float(way.push);
    result.depth = way.depth > touching ? static_cast<float>(way.depth) : 0;
    return result;
}

template Depenetration<2> depenetrate_convex(const Convex<2>&, const World<2>&, const Filter&);
template Depenetration<3> depenetrate_convex(const Convex<3>&, const World<3>&, const Filter&);

}  // namespace abut
