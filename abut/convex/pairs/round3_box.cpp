// A point or a segment and a box, in the box' own frame.

#include <abut/convex/pairs/box_point-inl.h>
#include <abut/convex/pairs/round3.hpp>

namespace abut::detail {
namespace {

/// A smaller distance, relative to the largest coordinate, may have a direction that is rounding.
constexpr double min_box_gap = 1e-7;

inline DVec<3> seen_from(const Convex<3>& box, const Convex<3>& convex, std::uint32_t corner) {
    const DVec<3> local = box.place.transposed(core_corner(convex, corner) - box.place.offset);
    return box.scale == 1 ? local : local / (box.scale * box.scale);
}

DVec<3> within(const DVec<3>& half, const DVec<3>& point) {
    return {std::min(std::max(point.x, -half.x), half.x), std::min(std::max(point.y, -half.y), half.y),
            std::min(std::max(point.z, -half.z), half.z)};
}

/// The corners of a feature of the box, at which the axes in `fixed` are at one end, those in `low` at the low end. A
/// face has three.
void set_box_corners(std::uint32_t fixed, std::uint32_t low, ClosestCorners<3>& corners) {
    corners.a[0] = low;
    corners.count = 1;
    for (std::uint32_t i = 0; i < 3; ++i)
        if ((fixed >> i & 1u) == 0) corners.a[corners.count++] = low | 1u << i;
}

/// Adds the corners of a point on a segment, by its parameter.
void set_segment_corners(double part, ClosestCorners<3>& corners) {
    const std::uint32_t first = part >= 1 ? 1 : 0, last = part <= 0 ? 0 : 1;
    if (first != last && corners.count == 1) corners.a[corners.count++] = corners.a[0];
    for (std::size_t i = 0; i < corners.count; ++i) corners.b[i] = i == 0 ? first : last;
}

/// Converts the result for the cores to the world.
void set_result(const Convex<3>& box, const Convex<3>& other, double distance, const DVec<3>& normal,
                const DVec<3>& on_box, SignedDistance<3>& result) {
    result.normal = box.place.vector(normal);
    if (box.scale != 1) {
        result.normal = result.normal / box.scale;
        distance *= box.scale;
    }
    result.distance = distance - box.radius - other.radius;
    result.on_a = box.place.point(on_box) + result.normal * box.radius;
}

/// A segment in the frame of the box.
struct SeenSegment {
    DVec<3> half;  ///< of the box
    DVec<3> from, to, along;
    double scale;  ///< the largest coordinate

    DVec<3> at(double part) const { return part >= 1 ? to : from + along * part; }
};

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
        const double across = std::sqrt(square), height = middle[k] * s.along[j] - middle[j] * s.along[k];
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
    return std::min(std::max(deepest, low), high);
}

/// The point of the segment nearest to the line of the edge at `corner`, along the separating direction.
double parameter_beside(const SeenSegment& s, const SeparatingDirection& direction, const DVec<3>& corner) {
    const DVec<3> across = cross(axis<3>(direction.axis), direction.out);
    return std::min(std::max(dot(across, corner - s.from) / dot(across, s.along), 0.0), 1.0);
}

/// The cores overlap or nearly touch, with a gap of `gap`.
bool deep_in_box(const Convex<3>& box, const Convex<3>& segment, const SeenSegment& s, double gap,
                 SignedDistance<3>& result) {
    const SeparatingDirection direction = separating_direction(s);
    if (direction.separation > 0 && gap - direction.separation > round3_tolerance * s.scale) return false;
    DVec<3> on_box = s.half;
    for (int i = 0; i < 3; ++i) on_box[i] = direction.out[i] < 0 ? -s.half[i] : s.half[i];
    const double part = direction.of_side ? parameter_below(s, direction) : parameter_beside(s, direction, on_box);
    const DVec<3> on_segment = s.at(part), inside = within(s.half, on_segment);
    for (int i = 0; i < 3; ++i)
        if (direction.of_side != (i == direction.axis)) on_box[i] = inside[i];
    // The depth at the points must equal the separation, one point right above the other.
    if (largest(on_segment - on_box - direction.out * direction.separation) > round3_tolerance * s.scale) return false;

    set_result(box, segment, direction.separation, direction.out, on_box, result);
    std::uint32_t low = 0;
    for (int i = 0; i < 3; ++i) low |= direction.out[i] < 0 ? 1u << i : 0u;
    const std::uint32_t bit = 1u << direction.axis;
    set_box_corners(direction.of_side ? bit : 7u & ~bit, low, result.corners);
    set_segment_corners(part, result.corners);
    return true;
}

}  // namespace

bool box_point(const Convex<3>& box, const Convex<3>& point, SignedDistance<3>& result) {
    BoxClosestPoint place;
    const DVec<3> center = core_corner(point, 0), half(box.own[0]), seen = seen_from(box, point, 0);
    const bool outside = nearest_from_outside(lanes::double3(half), lanes::double3(seen), place);
    if (!outside) nearest_from_inside(half, seen, place);
    const double distance = place.distance[0];
    const DVec<3> offset = box.place.vector(lanes::vector(place.offset));
    result.distance = distance * box.scale - box.radius - point.radius;
    result.normal = offset * place.per_length[0] / box.scale;
    result.on_a = center - (outside ? offset : offset * distance) + result.normal * box.radius;
    set_box_corners(place.fixed, place.low, result.corners);
    return true;
}

bool box_segment(const Convex<3>& box, const Convex<3>& segment, SignedDistance<3>& result) {
    SeenSegment s{DVec<3>(box.own[0]), seen_from(box, segment, 0), seen_from(box, segment, 1), {}, 0};
    s.along = s.to - s.from;
    s.scale = std::max({largest(s.half), largest(s.from), largest(s.to)});
    const double part = nearest_part(s);
    const DVec<3> on_segment = s.at(part), on_box = within(s.half, on_segment), between = on_segment - on_box;
    const double gap = length(between);
    if (!(gap > min_box_gap * s.scale)) return deep_in_box(box, segment, s, gap, result);

    const DVec<3> normal = between * (1 / gap);
    double beyond = std::min(dot(normal, s.from), dot(normal, s.to));
    for (int i = 0; i < 3; ++i) beyond -= std::abs(normal[i]) * s.half[i];
    if (!(gap - beyond <= round3_tolerance * s.scale)) return false;
    set_result(box, segment, gap, normal, on_box, result);
    std::uint32_t fixed = 0, low = 0;
    for (int i = 0; i < 3; ++i) {
        fixed |= between[i] != 0 ? 1u << i : 0u;
        low |= between[i] < 0 ? 1u << i : 0u;
    }
    set_box_corners(fixed, low, result.corners);
    set_segment_corners(part, result.corners);
    return true;
}

}  // namespace abut::detail
