#include <abut/math/assert.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>

namespace abut {

using namespace detail;

template <int D>
bool contains(const View<D>& shape, const Vec<D>& point) {
    const Convex<D> as_shape = round_points<D>({point}, 0);
    if (const auto* composite = std::get_if<Composite<D>>(&shape)) {
        const bool finite = is_finite(shape) && is_finite(point);
        ABUT_ASSERT(finite);
        if (!finite) return false;
        if (contains_inside(*composite, point)) return true;
    }
    return overlaps(shape, View<D>(as_shape));
}

template bool contains(const View<2>&, const Vec<2>&);
template bool contains(const View<3>&, const Vec<3>&);

}  // namespace abut
