#include <abut/convex/ray/ball.hpp>
#include <abut/convex/ray/polygon_soa.hpp>

namespace abut::detail {
namespace {

/// The ray in the shape's own frame, if the inverse placement is well conditioned.
template <int D>
bool unplace(const Placement<D>& placement, double radius, const DRay<D>& ray, DRay<D>& own) {
    const DVec<D> from = ray.origin - placement.place.offset;
    own.length = ray.length;
    if (placement.similar) {
        if (!(placement.scale > 0)) return false;
        const double factor = 1 / (placement.scale * placement.scale);
        own.origin = placement.place.transposed(from) * factor;
        own.direction = placement.place.transposed(ray.direction) * factor;
        return true;
    }
    if (radius > 0) return false;
    double shortest = std::numeric_limits<double>::infinity(), longest = 0, volume = 1;
    for (const DVec<D>& column : placement.place.column) {
        shortest = std::min(shortest, length(column));
        longest = std::max(longest, length(column));
        volume *= length(column);
    }
    const double stretched_volume = determinant(placement.place);
    if (!(shortest > 1e-3 * longest && std::abs(stretched_volume) > 1e-3 * volume)) return false;
    const Affine<D> back = inverse(placement.place, stretched_volume);
    own.origin = back.vector(from);
    own.direction = back.vector(ray.direction);
    return true;
}

template <int D>
RayEntry<D> enter_own(const Convex<D>& convex, const DRay<D>& own, double radius) {
    if (convex.core == Core::box) return enter_box(own, DVec<D>(convex.own[0]), radius);
    if constexpr (D == 2) {
        if (convex.sides != nullptr) {
            PolygonSoa sides;
            sides.view_rows(convex.sides, convex.count);
            return enter_polygon_soa(own, sides, radius);
        }
        if (convex.core == Core::points) return enter_polygon(own, {convex.vertices(), convex.count}, radius);
    } else {
        if (convex.core == Core::points)
            return enter_polyhedron(own, {convex.vertices(), convex.count}, *convex.facets, radius);
        if (convex.core == Core::discs && radius == 0)
            return enter_discs(own, DVec<3>(convex.own[0]), DVec<3>(convex.own[1]),
                               static_cast<double>(convex.disc_radius[0]), static_cast<double>(convex.disc_radius[1]));
    }
    return {};
}

template <int D>
RayEntry<D> enter_few_points(const Convex<D>& convex, double radius, const DRay<D>& ray) {
    Affine<D> seen = convex.place;
    seen.offset -= ray.origin;
    const auto corner = [&](std::uint32_t i) { return seen.point(DVec<D>(convex.vertices()[i])); };
    if (convex.count == 1) return enter_ball(ray, corner(0), radius);
    if (convex.count == 2 && radius > 0) return enter_capsule(ray, corner(0), corner(1), radius);
    if constexpr (D == 2) {
        return radius > 0 ? RayEntry<2>() : enter_segment(ray, corner(0), corner(1));
    } else {
        if (convex.count != 3) return {};
        return radius > 0 ? enter_rounded_triangle(ray, {corner(0), corner(1), corner(2)}, radius)
                          : enter_triangle(ray, corner(0), corner(1), corner(2));
    }
}

}  // namespace

template <int D>
RayEntry<D> ray_entry(const Convex<D>& convex, const DRay<D>& ray, double more_radius) {
    if (convex.inner_radius > 0 || convex.core == Core::function) return {};
    const double radius = convex.radius + more_radius;
    if (convex.core == Core::points && convex.facets == nullptr) {
        if (convex.count <= static_cast<std::uint32_t>(D)) return enter_few_points(convex, radius, ray);
        if (D == 3) return {};
    }
    DRay<D> own;
    if (!unplace(convex, radius, ray, own)) return {};
    RayEntry<D> result = enter_own(convex, own, radius / convex.scale);
    if (result.answer == RayAnswer::enters)
        result.normal =
            convex.similar ? convex.place.vector(result.normal) : mapped_normal(convex.place, result.normal);
    return result;
}

template RayEntry<2> ray_entry(const Convex<2>&, const DRay<2>&, double);
template RayEntry<3> ray_entry(const Convex<3>&, const DRay<3>&, double);

}  // namespace abut::detail
