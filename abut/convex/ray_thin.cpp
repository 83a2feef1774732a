#include <abut/convex/ray_forms.hpp>

namespace abut {
namespace {

/// A beam that starts so near to the line or plane of a thin part, in sizes of the part, may be leaving it.
constexpr double start_doubt = 1e-5;

/// A beam that passes an edge so near, in parts of the numbers seen, may meet it: neighbours leave no crack.
constexpr double edge_doubt = 1e-12;

/// Of a line or plane along which the beam runs, but for `slope`: whether it surely stays clear of it.
bool stays_clear(double height, double slope, double scale) {
    return height > 4 * (ray_doubt + slope) * scale;
}

}  // namespace

RayEntry<2> enter_segment(const Beam<2>& beam, const DVec<2>& a, const DVec<2>& b) {
    const DVec<2> along_it = b - a, normal(along_it.y, -along_it.x);
    const double size = length(along_it), scale = largest(a) + largest(b), doubt = ray_doubt * scale;
    if (!(size > doubt)) return {};
    const double height = -dot(a, normal) / size, sinks = -dot(beam.direction, normal) / size;
    constexpr double skims = 1e-6;
    if (std::abs(sinks) <= skims) return stays_clear(std::abs(height), skims, scale) ? ray_misses<2>() : RayEntry<2>();
    const double along = height / sinks;
    const double part = dot(beam.direction * along - a, along_it) / size;
    if (part < -doubt || part > size + doubt) return ray_misses<2>();
    if (std::abs(height) <= start_doubt * size) return {};
    if (along < 0 || along > beam.length) return ray_misses<2>();
    return {RayAnswer::enters, along, sinks > 0 ? normal : -normal, FeatureKind::edge, edge_index(0, 1)};
}

RayEntry<3> enter_triangle(const Beam<3>& beam, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const DVec<3> ab = b - a, ac = c - a, normal = cross(ab, ac);
    const double size = largest(ab) + largest(ac), scale = largest(a) + size;
    const double area = length(normal);
    if (!(area > 1e-6 * size * size)) return {};
    const double height = -dot(a, normal), sinks = -dot(beam.direction, normal);
    constexpr double skims = 1e-6;
    if (std::abs(sinks) <= skims * area)
        return stays_clear(std::abs(height) / area, skims, scale) ? ray_misses<3>() : RayEntry<3>();
    // How far the line passes from the edges through `a` and then from the third, in areas.
    const DVec<3> turned = cross(beam.direction, a);
    const double side = sinks > 0 ? 1 : -1;
    const double to_ac = side * dot(ac, turned), to_ab = -side * dot(ab, turned), whole = side * sinks;
    const double beyond = std::max({-to_ac, -to_ab, to_ac + to_ab - whole});
    if (beyond > edge_doubt * scale * size) return ray_misses<3>();
    if (std::abs(height) <= start_doubt * size * area) return {};
    const double along = height / sinks;
    if (along < 0 || along > beam.length) return ray_misses<3>();
    // Where it skims, or past a sharp corner, a little outside of the edges may be far.
    if (whole < 1e-3 * area || (beyond > 0 && area < 1e-3 * size * size)) return {};
    return {RayAnswer::enters, along, normal * side, FeatureKind::face, sinks > 0 ? 0u : 1u};
}

}  // namespace abut
