#include <abut/convex/ray/ball.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

template <int D>
RayEntry<D> entered(double along, const DVec<D>& normal, FeatureKind kind, std::uint32_t index) {
    return {RayAnswer::enters, along, normal, kind, index};
}

}  // namespace

template <int D>
RayEntry<D> enter_capsule(const DRay<D>& ray, const DVec<D>& a, const DVec<D>& b, double radius) {
    const DVec<D> axis = b - a;
    const double long_squared = length_squared(axis), tolerance = ray_tolerance * (largest(a) + largest(b) + radius);
    const double about = radius + tolerance;
    if (!(long_squared > tolerance * tolerance)) return {};
    const double along_axis = -dot(a, axis) / long_squared;
    const DVec<D> nearest = a + axis * std::clamp(along_axis, 0.0, 1.0);
    if (!(length_squared(nearest) > about * about)) return {};

    // Projected along the axis, the capsule is a disc.
    const DVec<D> projection = a + axis * along_axis;
    const double climbs = dot(ray.direction, axis) / long_squared;
    const DVec<D> across = ray.direction - axis * climbs;
    const double off_axis = length_squared(projection), pace = length_squared(across);
    double height = along_axis;
    if (off_axis > radius * radius) {
        // Nearly parallel to the axis, the projected ray hardly moves.
        if (!(pace > 1e-10)) return {};
        const double passes_at = dot(projection, across) / pace;
        const double half_chord = radius * radius - length_squared(projection - across * passes_at);
        if (passes_at < 0 || half_chord < 0) return ray_misses<D>();
        const double along = passes_at - square_root(half_chord / pace);
        height += climbs * along;
        if (height >= 0 && height <= 1) {
            if (along > ray.length) return ray_misses<D>();
            return entered(along, across * along - projection, FeatureKind::edge, edge_index(0, 1));
        }
    }
    // Beyond an end of the axis only the ball at that end remains.
    return height < 0.5 ? enter_end(ray, a, radius, 0) : enter_end(ray, b, radius, 1);
}

template RayEntry<2> enter_capsule(const DRay<2>&, const DVec<2>&, const DVec<2>&, double);
template RayEntry<3> enter_capsule(const DRay<3>&, const DVec<3>&, const DVec<3>&, double);

}  // namespace abut::detail
