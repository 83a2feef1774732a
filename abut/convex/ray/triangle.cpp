#include <abut/convex/ray/triangle.hpp>

namespace abut::detail {

RayEntry<2> enter_segment(const DRay<2>& ray, const DVec<2>& a, const DVec<2>& b) {
    const DVec<2> along_it = b - a, normal(along_it.y, -along_it.x);
    const double size = length(along_it), scale = largest(a) + largest(b), tolerance = ray_tolerance * scale;
    if (!(size > tolerance)) return {};
    const double height = -dot(a, normal) / size, descent = -dot(ray.direction, normal) / size;
    if (std::abs(descent) <= ray_grazing_slope)
        return surely_misses_plane(std::abs(height), scale) ? ray_misses<2>() : RayEntry<2>();
    const double along = height / descent;
    const double part = dot(ray.direction * along - a, along_it) / size;
    if (part < -tolerance || part > size + tolerance) return ray_misses<2>();
    if (std::abs(height) <= ray_start_tolerance * scale) return {};
    if (along < 0 || along > ray.length) return ray_misses<2>();
    return {RayAnswer::enters, along, descent > 0 ? normal : -normal, FeatureKind::edge, edge_index(0, 1)};
}

RayEntry<3> enter_triangle(const DRay<3>& ray, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    RayEntry<3> result;
    result.answer = decide_triangle(ray.direction, ray.length, a, b, c, result);
    return result;
}

}  // namespace abut::detail
