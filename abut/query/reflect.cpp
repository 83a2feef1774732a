#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/query/reflect.hpp>

namespace abut {

/// With d the direction, n the normal and s = -dot(d, n) the sine of the angle of incidence, the ray leaves along d + 2
/// s n.
///
/// The hit's point is rounded to floats, so it may lie behind the mirror. A step back along the ray by lift / s lies
/// `lift` above the mirror. It lies in free space even in a corner, where a step along the normal could go through
/// another mirror. The step displaces the reflected ray by at most twice the lift, as sin(2 a) / sin(a) <= 2.
template <int D>
Ray<D> reflect(const Ray<D>& ray, const Hit<D>& hit) {
    detail::enter_library();
    const bool finite = is_finite(ray.origin) && is_finite(ray.direction) && !std::isnan(ray.length) &&
                        is_finite(hit.point) && is_finite(hit.normal) && std::isfinite(hit.distance);
    ABUT_ASSERT(finite);
    if (!finite) return {ray.origin, to_float(axis<D>(0)), 0};

    // More than the rounding of a direction and a normal together, and of two points.
    constexpr double min_rise = 4e-7, rounding = 4e-7;
    const DVec<D> direction = unit(DVec<D>(ray.direction)), normal = unit(DVec<D>(hit.normal)), point(hit.point);
    const double sinks = std::max(-dot(direction, normal), 0.0);
    const double lift = rounding * std::max(largest(point), largest(DVec<D>(ray.origin)));
    const double travelled = static_cast<double>(hit.distance);
    const double back = lift < sinks * travelled ? lift / sinks : travelled;

    DVec<D> away = direction + normal * (2 * sinks);
    away += normal * std::max(min_rise - dot(away, normal), 0.0);
    const double left = std::max(static_cast<double>(ray.length) - (travelled - back), 0.0);
    return {to_float(point - direction * back), to_float(normalized(away)), static_cast<float>(left)};
}

template Ray<2> reflect(const Ray<2>&, const Hit<2>&);
template Ray<3> reflect(const Ray<3>&, const Hit<3>&);

}  // namespace abut
