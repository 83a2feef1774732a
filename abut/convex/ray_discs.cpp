#include <abut/convex/ray_forms.hpp>

namespace abut {
namespace {

/// What may be the place where the beam enters: on a disc or on the side. A convex set is entered in one place only, so
/// where more than one passes they are the same but for rounding.
struct Place {
    double along = -std::numeric_limits<double>::infinity();
    DVec<3> normal{0.0};

    void offer(double at, const DVec<3>& out) {
        if (!(at > along)) return;
        along = at;
        normal = out;
    }
};

}  // namespace

RayEntry<3> enter_discs(const Beam<3>& beam, const DVec<3>& a, const DVec<3>& b, double radius_a, double radius_b) {
    const DVec<3> middle = 0.5 * (a + b), axis = b - a;
    const double height = length(axis), widest = std::max(radius_a, radius_b);
    if (!(height > 1e-3 * widest && widest > 1e-3 * height)) return {};
    const DVec<3> up = axis / height;
    const double reach = std::sqrt(0.25 * height * height + widest * widest);
    const double pace = length(beam.direction);

    // From the place nearest to the middle: from far away, squares of what is near would lose their digits.
    const DVec<3> from = beam.origin - middle;
    const double passes_at = -dot(from, beam.direction) / (pace * pace);
    const DVec<3> near = from + beam.direction * passes_at;
    const double doubt = ray_doubt * (largest(from) + largest(middle) + reach);
    if (length(near) > reach + doubt) return ray_misses<3>();
    if (passes_at < 0 && length(from) > reach + doubt) return ray_misses<3>();

    const double along_axis = dot(near, up), climbs = dot(beam.direction, up);
    const DVec<3> off_axis = near - up * along_axis, across = beam.direction - up * climbs;
    const double z = along_axis + 0.5 * height, narrows = (radius_a - radius_b) / height;
    Place place;
    if (climbs != 0) {
        const double at = climbs > 0 ? -z / climbs : (height - z) / climbs;
        if (length(off_axis + across * at) <= (climbs > 0 ? radius_a : radius_b) + doubt)
            place.offer(at, climbs > 0 ? -up : up);
    }
    const double here = radius_a - narrows * z;
    const double square = length_squared(across) - narrows * narrows * climbs * climbs;
    const double linear = dot(off_axis, across) + narrows * climbs * here;
    const double rest = length_squared(off_axis) - here * here;
    const double inside_root = linear * linear - square * rest;
    if (inside_root >= 0) {
        const double root = std::sqrt(inside_root);
        const double at = linear > 0 ? (-linear - root) / square : rest / (root - linear);
        const double top = z + climbs * at, radius = radius_a - narrows * top;
        if (std::isfinite(at) && top >= -doubt && top <= height + doubt && radius >= -doubt) {
            const DVec<3> out = off_axis + across * at;
            // Of the apex, and of a root without digits, there is nothing to say.
            const double wide = length(out);
            if (!(wide > 1e-6 * widest && std::abs(wide - radius) <= 1e-7 * reach + doubt)) return {};
            place.offer(at, normalized(out / wide + up * narrows));
        }
    } else if (square <= 0 && place.along < -reach / pace) {
        return {};
    }
    RayEntry<3> result;
    result.along = passes_at + place.along;
    result.normal = place.normal;
    if (result.normal == DVec<3>(0.0) || result.along > beam.length) return ray_misses<3>();
    if (!(-dot(beam.direction, result.normal) * result.along > doubt)) return {};
    result.answer = RayAnswer::enters;
    return result;
}

}  // namespace abut
