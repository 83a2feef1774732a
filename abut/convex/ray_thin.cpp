#include <abut/convex/ray_triangle.hpp>

namespace abut {

RayEntry<2> enter_segment(const Beam<2>& beam, const DVec<2>& a, const DVec<2>& b) {
    const DVec<2> along_it = b - a, normal(along_it.y, -along_it.x);
    const double size = length(along_it), scale = largest(a) + largest(b), doubt = ray_doubt * scale;
    if (!(size > doubt)) return {};
    const double height = -dot(a, normal) / size, sinks = -dot(beam.direction, normal) / size;
    if (std::abs(sinks) <= ray_skims) return ray_stays_clear(std::abs(height), scale) ? ray_misses<2>() : RayEntry<2>();
    const double along = height / sinks;
    const double part = dot(beam.direction * along - a, along_it) / size;
    if (part < -doubt || part > size + doubt) return ray_misses<2>();
    if (std::abs(height) <= ray_start_doubt * scale) return {};
    if (along < 0 || along > beam.length) return ray_misses<2>();
    return {RayAnswer::enters, along, sinks > 0 ? normal : -normal, FeatureKind::edge, edge_index(0, 1)};
}

RayEntry<3> enter_triangle(const Beam<3>& beam, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    RayEntry<3> result;
    result.answer = decide_triangle(beam.direction, beam.length, a, b, c, result);
    return result;
}

}  // namespace abut
