#include <abut/convex/ray/closed_forms.hpp>
#include <abut/convex/ray/planes.hpp>

namespace abut::detail {
namespace {

/// A lower bound of the distance of a point in a face's plane from the inside of its loop; 0 inside.
double beyond_loop(std::span<const Vec3> points, std::span<const std::uint32_t> loop, const DVec<3>& normal,
                   const DVec<3>& place) {
    double farthest = 0;
    DVec<3> a(points[loop[loop.size() - 1]]);
    for (const std::uint32_t corner : loop) {
        const DVec<3> b(points[corner]), out = cross(b - a, normal);
        const double beyond = dot(out, place - a);
        if (beyond > 0) farthest = std::max(farthest, beyond / length(out));
        a = b;
    }
    return farthest;
}

}  // namespace

RayEntry<3> enter_polyhedron(const DRay<3>& ray, std::span<const Vec3> points, const Facets& facets, double radius) {
    const std::size_t count = facets.normals.size();
    if (facets.offsets.size() != count) return {};
    const PlaneCut planes = cut_by_planes(facets.normals, facets.offsets, radius, ray.origin, ray.direction);
    const double tolerance = ray_tolerance * (largest(ray.origin) + largest(DVec<3>(points[0])) +
                                              largest(DVec<3>(points[points.size() - 1])) + radius);
    if (planes.beside > tolerance || planes.cut.lower > ray.length) return ray_misses<3>();
    if (planes.beside > 0 || planes.in == count || planes.out == count) return {};
    RayEntry<3> result;
    result.answer = planes.cut.answer(ray.length, tolerance);
    // A flat polyhedron has two nearly equal planes: its edges decide whether the ray hits.
    const bool flat = count == 2;
    const double lower = planes.cut.lower, slope = planes.cut.slope_in / length(ray.direction);
    if (flat && lower * planes.cut.slope_in > tolerance && slope > 1e-3) result.answer = RayAnswer::enters;
    if (result.answer != RayAnswer::enters) return result;

    // The planes of faces that aren't quite flat, or that share a sharp edge, may cross outside of the faces.
    result.normal = DVec<3>(facets.normals[planes.in]);
    const std::span<const std::uint32_t> loop = facets.loop(planes.in);
    const DVec<3> place = ray.at(lower) - result.normal * radius;
    const double beyond = beyond_loop(points, loop, result.normal, place);
    if (beyond > 0 || slope < 1e-6) {
        const bool clear = flat && radius == 0 && beyond > 1e-6 * largest(place - DVec<3>(points[loop[0]]));
        return clear ? ray_misses<3>() : RayEntry<3>();
    }
    result.along = lower;
    result.kind = FeatureKind::face;
    result.index = static_cast<std::uint32_t>(planes.in);
    return result;
}

}  // namespace abut::detail
