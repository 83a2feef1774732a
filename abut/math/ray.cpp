#include <abut/math/dvec.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/simd/library_entry.hpp>

namespace abut {

using namespace detail;

template <int D>
Ray<D> Ray<D>::between(const Vec<D>& a, const Vec<D>& b) {
    detail::enter_library();
    const DVec<D> offset = DVec<D>(b) - DVec<D>(a);
    return {a, to_float(normalized(offset)), static_cast<float>(abut::length(offset))};
}

template <int D>
RayD<D> RayD<D>::between(const DVec<D>& a, const DVec<D>& b) {
    detail::enter_library();
    const DVec<D> offset = b - a;
    return {a, to_float(normalized(offset)), static_cast<float>(abut::length(offset))};
}

template struct Ray<2>;
template struct Ray<3>;
template struct RayD<2>;
template struct RayD<3>;

}  // namespace abut
