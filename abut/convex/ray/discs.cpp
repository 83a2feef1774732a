#include <abut/convex/ray/closed_forms.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// The candidate entry on a disc or on the side. A ray enters a convex set once, so several candidates are equal but
/// for rounding.
struct CandidateEntry {
    double along = -std::numeric_limits<double>::infinity();
    DVec<3> normal{0.0};

    void offer(double at, const DVec<3>& out) {
        if (!(at > along)) return;
        along = at;
        normal = out;
    }
};

}  // namespace

RayEntry<3> enter_discs(const DRay<3>& ray, const DVec<3>& a, const DVec<3>& b, double radius_a, double radius_b) {
    const DVec<3> middle = 0.5 * (a + b), axis = b - a;
    const double height = length(axis), widest = std::max(radius_a, radius_b);
    if (!(height > 1e-3 * widest && widest > 1e-3 * height)) return {};
    const DVec<3> up = axis / height;
    const double reach = square_root(0.25 * height * height + widest * widest);
    const double pace = length(ray.direction);

    // From the point nearest to the middle: from far away, squares of small distances would lose their digits.
    const DVec<3> from = ray.origin - middle;
    const double passes_at = -dot(from, ray.direction) / (pace * pace);
    const DVec<3> near = from + ray.direction * passes_at;
    const double tolerance = ray_tolerance * (largest(from) + largest(middle) + reach);
    if (length(near) > reach + tolerance) return ray_misses<3>();
    if (passes_at < 0 && length(from) > reach + tolerance) return ray_misses<3>();

    const double along_axis = dot(near, up), climbs = dot(ray.direction, up);
    const DVec<3> off_axis = near - up * along_axis, across = ray.direction - up * climbs;
    const double z = along_axis + 0.5 * height, narrows = (radius_a - radius_b) / height;
    CandidateEntry entry;
    if (climbs != 0) {
        const double at = climbs > 0 ? -z / climbs : (height - z) / climbs;
        if (length(off_axis + across * at) <= (climbs > 0 ? radius_a : radius_b) + tolerance)
            entry.offer(at, climbs > 0 ? -up : up);
    }
    const double here = radius_a - narrows * z;
    const double square = length_squared(across) - narrows * narrows * climbs * climbs;
    const double linear = dot(off_axis, across) + narrows * climbs * here;
    const double rest = length_squared(off_axis) - here * here;
    const double inside_root = linear * linear - square * rest;
    if (inside_root >= 0) {
        const double root = square_root(inside_root);
        const double at = linear > 0 ? (-linear - root) / square : rest / (root - linear);
        const double top = z + climbs * at, radius = radius_a - narrows * top;
        if (std::isfinite(at) && top >= -tolerance && top <= height + tolerance && radius >= -tolerance) {
            const DVec<3> out = off_axis + across * at;
            // The normal is undefined at the apex, and for a root without digits.
            const double wide = length(out);
            if (!(wide > 1e-6 * widest && std::abs(wide - radius) <= 1e-7 * reach + tolerance)) return {};
            entry.offer(at, normalized(out / wide + up * narrows));
        }
    } else if (square <= 0 && entry.along < -reach / pace) {
        return {};
    }
    RayEntry<3> result;
    result.along = passes_at + entry.along;
    result.normal = entry.normal;
    if (result.normal == DVec<3>(0.0) || result.along > ray.length) return ray_misses<3>();
    if (!(-dot(ray.direction, result.normal) * result.along > tolerance)) return {};
    result.answer = RayAnswer::enters;
    return result;
}

}  // namespace abut::detail
