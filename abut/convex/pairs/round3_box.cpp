// A segment and a box, in the frame of the box.

#include <abut/convex/pairs/round3.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// A smaller distance, relative to the largest coordinate, may have a direction that is rounding.
constexpr double min_box_gap = 1e-7;

DVec<3> within(const DVec<3>& half, const DVec<3>& point) {
    return {std::min(std::max(point.x, -half.x), half.x), std::min(std::max(point.y, -half.y), half.y),
            std::min(std::max(point.z, -half.z), half.z)};
}

/// A segment in the frame of the box.
struct SeenSegment {
    DVec<3> half;  ///< of the box
    DVec<3> from, to, along;
    double scale;  ///< the largest coordinate

    SeenSegment(const PlacedBox& box, const PlacedSegment& segment)
        : half(lanes::vector(box.half)),
          from(lanes::vector(box.axes.transposed(segment.from - box.center))),
          to(lanes::vector(box.axes.transposed(segment.to - box.center))),
          along(to - from),
          scale(std::max({largest(half), largest(from), largest(to)})) {}

    DVec<3> at(double part) const { return part >= 1 ? to : from + along * part; }
};

/// Writes the result for the cores, in the frame of the box, with the point of the segment by its parameter.
void set_result(const PlacedBox& box, const PlacedSegment& segment, double distance, const DVec<3>& normal,
                const DVec<3>& on_box, double part, CoresDistance& found) {
    found.distance = lanes::double2(distance);
    found.normal = box.axes.vector(lanes::double3(normal));
    found.on_a = box.center + box.axes.vector(lanes::double3(on_box));
    found.on_b = found.on_a + found.normal * found.distance;
    found.part_b = {part >= 1 ? 1u : 0u, part > 0 && part < 1 ? 1u : 0u};
    add_balls(box.radius, segment.radius, found);
}

/// Half the derivative of the squared distance from the box along the segment.
double slope(const SeenSegment& s, double part) {
    const DVec<3> point = s.from + s.along * part;
    return dot(point - within(s.half, point), s.along);
}

/// The parameter of the point of the segment nearest to the box. The slope never decreases along the segment, and it is
/// piecewise linear, with breaks at the planes of the six faces. The root lies between the last break with a negative
/// slope and the first without.
double nearest_part(const SeenSegment& s) {
    if (slope(s, 0) >= 0) return 0;
    if (dot(s.to - within(s.half, s.to), s.along) <= 0) return 1;
    double low = 0, high = 1;
    for (int i = 0; i < 3; ++i) {
        const double one = s.along[i] != 0 ? 1 / s.along[i] : 0;
        for (const double side : {-s.half[i], s.half[i]}) {
            const double part = std::min(std::max((side - s.from[i]) * one, 0.0), 1.0);
            const bool falls = slope(s, part) < 0;
            low = falls ? std::max(low, part) : low;
            high = falls ? high : std::min(high, part);
        }
    }
    const DVec<3> middle = s.at(0.5 * (low + high)), inside = within(s.half, middle);
    double whole = 0, along = 0;
    for (int i = 0; i < 3; ++i) {
        const double weight = middle[i] != inside[i] ? s.along[i] : 0;
        whole += weight * weight;
        along += weight * (inside[i] - s.from[i]);
    }
    return whole > 0 ? std::min(std::max(along / whole, low), high) : low;
}

/// A direction out of the box with the separation of box and segment along it.
struct SeparatingDirection {
    double separation = -std::numeric_limits<double>::infinity();
    DVec<3> out{0.0};
    int axis = 0;          ///< of the face of the box, or of its edge
    bool of_side = false;  ///< a face; else an edge
};

/// The direction of minimum depth among all face normals of the Minkowski difference: the axes of the box, and their
/// cross products with the segment.
SeparatingDirection separating_direction(const SeenSegment& s) {
    SeparatingDirection best;
    const DVec<3> middle = (s.from + s.to) * 0.5;
    for (int i = 0; i < 3; ++i) {
        const double separation = std::abs(middle[i]) - s.half[i] - 0.5 * std::abs(s.along[i]);
        if (!(separation > best.separation)) continue;
        best = {separation, axis<3>(i, middle[i] < 0 ? -1 : 1), i, true};
    }
    const double min_square = 1e-18 * length_squared(s.along);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double square = s.along[j] * s.along[j] + s.along[k] * s.along[k];
        if (!(square > min_square)) continue;
        const double across = square_root(square), height = middle[k] * s.along[j] - middle[j] * s.along[k];
        const double separation =
            (std::abs(height) - s.half[j] * std::abs(s.along[k]) - s.half[k] * std::abs(s.along[j])) / across;
        if (!(separation > best.separation + round3_tolerance * s.scale)) continue;
        const double sign = height < 0 ? -1 / across : 1 / across;
        best = {separation, DVec<3>(0.0), i, false};
        best.out[j] = -s.along[k] * sign;
        best.out[k] = s.along[j] * sign;
    }
    return best;
}

/// The deepest point of the segment below a face: an end, or an end of the part over the face.
double parameter_below(const SeenSegment& s, const SeparatingDirection& direction) {
    double low = 0, high = 1;
    for (int i = 0; i < 3; ++i) {
        if (i == direction.axis || s.along[i] == 0) continue;
        const double one = 1 / s.along[i], a = (-s.half[i] - s.from[i]) * one, b = (s.half[i] - s.from[i]) * one;
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    const double deepest = s.along[direction.axis] * direction.out[direction.axis] > 0 ? 0 : 1;
    // A segment along a face of which rounding leaves no part over the face: its deepest end.
    return low <= high ? std::min(std::max(deepest, low), high) : deepest;
}

/// The point of the segment nearest to the line of the edge at `corner`, along the separating direction.
double parameter_beside(const SeenSegment& s, const SeparatingDirection& direction, const DVec<3>& corner) {
    const DVec<3> across = cross(axis<3>(direction.axis), direction.out);
    return std::min(std::max(dot(across, corner - s.from) / dot(across, s.along), 0.0), 1.0);
}

/// The cores overlap or nearly touch, with a gap of `gap`.
bool deep_in_box(const PlacedBox& box, const PlacedSegment& segment, const SeenSegment& s, double gap,
                 CoresDistance& found) {
    const SeparatingDirection direction = separating_direction(s);
    if (direction.separation > 0 && gap - direction.separation > round3_tolerance * s.scale) return false;
    DVec<3> on_box = s.half;
    std::uint32_t low = 0;
    for (int i = 0; i < 3; ++i) {
        on_box[i] = direction.out[i] < 0 ? -s.half[i] : s.half[i];
        low |= direction.out[i] < 0 ? 1u << i : 0u;
    }
    const double part = direction.of_side ? parameter_below(s, direction) : parameter_beside(s, direction, on_box);
    const DVec<3> on_segment = s.at(part), inside = within(s.half, on_segment);
    for (int i = 0; i < 3; ++i)
        if (direction.of_side != (i == direction.axis)) on_box[i] = inside[i];
    // The depth at the points must equal the separation, one point right above the other.
    if (largest(on_segment - on_box - direction.out * direction.separation) > round3_tolerance * s.scale) return false;

    const std::uint32_t bit = 1u << direction.axis;
    found.part_a = {low, direction.of_side ? 7u ^ bit : bit};
    set_result(box, segment, direction.separation, direction.out, on_box, part, found);
    return true;
}

}  // namespace

bool distance_of(const PlacedBox& box, const PlacedSegment& segment, CoresDistance& found) {
    const SeenSegment s(box, segment);
    const DVec<3> sum = s.half + s.from + s.to;
    if (!std::isfinite(sum.x + sum.y + sum.z)) return false;
    const double part = nearest_part(s);
    const DVec<3> on_segment = s.at(part), on_box = within(s.half, on_segment), between = on_segment - on_box;
    const double gap = length(between);
    if (!(gap > min_box_gap * s.scale)) return deep_in_box(box, segment, s, gap, found);

    const DVec<3> normal = between * (1 / gap);
    double beyond = std::min(dot(normal, s.from), dot(normal, s.to));
    for (int i = 0; i < 3; ++i) beyond -= std::abs(normal[i]) * s.half[i];
    if (!(gap - beyond <= round3_tolerance * s.scale)) return false;
    found.part_a = {};
    for (int i = 0; i < 3; ++i) {
        found.part_a.free |= between[i] == 0 ? 1u << i : 0u;
        found.part_a.low |= between[i] < 0 ? 1u << i : 0u;
    }
    set_result(box, segment, gap, normal, on_box, part, found);
    return true;
}

bool is_beyond_a_face(const PlacedBox& box, const PlacedSegment& segment, double within) {
    using namespace lanes;
    const Double2 half = double2(0.5);
    const Double3 middle = box.axes.transposed((segment.from + segment.to) * half - box.center);
    const Double3 reach = magnitude(box.axes.transposed(segment.to - segment.from)) * half + box.half;
    const Double3 far = magnitude(middle), gap = far - reach, sizes = far + reach;
    const Double2 rounding = (sizes.xy + swapped(sizes.xy) + sizes.z) * double2(1e-12);
    const Double2 needed = double2(within) + (box.radius + segment.radius) + rounding;
    // A NaN separates nothing.
    return bits(greater(gap.xy, gap.z) > needed) != 0 && finite(rounding);
}

}  // namespace abut::detail
