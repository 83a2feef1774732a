#include <abut/convex/box_axes.hpp>
#include <abut/convex/box_distance.hpp>
#include <abut/convex/box_manifold.hpp>
#include <abut/convex/box_pair.hpp>
#include <abut/convex/box_patch.hpp>

namespace abut {
namespace {

/// Whether the axis that parted them last parts them still, by more than `reach`, not below zero: the axis may be none,
/// along which nothing is apart.
bool still_parted(const Convex<3>& a, const Convex<3>& b, double reach, const Cache* cache) {
    if (cache == nullptr || reach < 0) return false;
    const DVec<3> axis(static_cast<double>(cache->axis[0]), static_cast<double>(cache->axis[1]),
                       static_cast<double>(cache->axis[2]));
    double middle = dot(axis, b.place.offset - a.place.offset), covered = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        covered += std::abs(dot(axis, a.place.column[i])) * static_cast<double>(a.own[0][static_cast<int>(i)]);
        covered += std::abs(dot(axis, b.place.column[i])) * static_cast<double>(b.own[0][static_cast<int>(i)]);
    }
    // What was kept in floats is of length 1 to within 1e-6, or no axis at all.
    const double doubt = 1e-14 * (std::abs(middle) + covered) + 1e-6 * reach;
    return middle - covered > reach + doubt && length_squared(axis) < 1 + 1e-6;
}

void remember_axis(const BoxPlacement& a, const Triple& normal, Cache* cache) {
    if (cache == nullptr) return;
    const DVec<3> axis = a.vector(normal);
    for (std::size_t i = 0; i < 3; ++i) cache->axis[i] = static_cast<float>(axis[static_cast<int>(i)]);
}

Triple face_normal(const BoxFrame& frame, std::size_t number) {
    Triple normal{};
    if (number < 3) {
        normal[number] = frame.middle[number] < 0 ? -1 : 1;
        return normal;
    }
    normal = frame.axis_b[number - 3];
    if (dot(normal, frame.middle) < 0)
        for (double& x : normal) x = -x;
    return normal;
}

Triple unit_edge_axis(const BoxFrame& frame, std::size_t number) {
    Triple axis = edge_axis(frame, number);
    const double one = 1 / std::sqrt(dot(axis, axis));
    for (double& x : axis) x *= one;
    return axis;
}

/// The parts of both that reach farthest along a normal of a face, for a meeting that lacks the place alone.
void meet_along(const BoxFrame& frame, const Triple& normal, double gap, BoxMeeting& meeting) {
    const Triple turned = frame.along_b(normal);
    const double level = 1e-9 * frame.scale();
    meeting.distance = gap;
    meeting.part_a = meeting.part_b = {};
    for (std::size_t i = 0; i < 3; ++i) {
        const bool level_a = std::abs(normal[i]) * frame.half_a[i] <= level,
                   level_b = std::abs(turned[i]) * frame.half_b[i] <= level;
        meeting.normal[i] = normal[i];
        meeting.part_a.free |= level_a ? 1u << i : 0u;
        meeting.part_a.low |= normal[i] < 0 && !level_a ? 1u << i : 0u;
        meeting.part_b.free |= level_b ? 1u << i : 0u;
        meeting.part_b.low |= turned[i] > 0 && !level_b ? 1u << i : 0u;
    }
}

/// Where the face of A across an axis meets B, along its normal.
bool meeting_face_of_a(const BoxFrame& frame, std::size_t axis, double gap, BoxMeeting& meeting) {
    meet_along(frame, face_normal(frame, axis), gap, meeting);
    const std::size_t u = next_axis(axis), v = last_axis(axis);
    const double side = frame.half_a[axis] * meeting.normal[axis];
    Triple nearest{frame.middle[0], frame.middle[1], frame.middle[2]};
    for (std::size_t j = 0; j < 3; ++j) {
        const double half = frame.axis_b[j][axis] * side > 0 ? -frame.half_b[j] : frame.half_b[j];
        for (std::size_t i = 0; i < 3; ++i) nearest[i] += frame.axis_b[j][i] * half;
    }
    if (std::abs(nearest[u]) <= frame.half_a[u] && std::abs(nearest[v]) <= frame.half_a[v]) {
        for (std::size_t i = 0; i < 3; ++i) meeting.on_a[i] = i == axis ? side : nearest[i];
        return true;
    }
    const BoxPatch patch(frame, meeting.normal);
    const std::size_t i = patch.nearest();
    if (i == patch.count || patch.gap[i] > gap + 1e-9 * frame.scale()) return false;
    meeting.on_a = patch.foot(i);
    return true;
}

/// The same of whichever box has the face.
bool meeting_face(const BoxFrame& frame, const BoxFaceGap& face, BoxMeeting& meeting) {
    if (face.number < 3) return meeting_face_of_a(frame, face.number, face.gap, meeting);
    if (!meeting_face_of_a(frame.turned_round(), face.number - 3, face.gap, meeting)) return false;
    turn_round(frame, meeting);
    return true;
}

/// The corner of B that reaches farthest against the face of A across an axis.
std::uint32_t foremost_corner(const BoxFrame& frame, std::size_t axis) {
    std::uint32_t corner = 0;
    for (std::size_t j = 0; j < 3; ++j) corner |= frame.axis_b[j][axis] * frame.middle[axis] > 0 ? 1u << j : 0u;
    return corner;
}

/// Where boxes are nearest that are apart. Mostly that is the corner of one that reaches farthest against the face of
/// the other whose gap is the widest.
bool nearest_points(const BoxFrame& frame, const BoxFaceGap& face, BoxMeeting& meeting) {
    if (face.gap > 0 && face.number < 3) {
        if (nearest_from_corner(frame, foremost_corner(frame, face.number), meeting)) return true;
    } else if (face.gap > 0) {
        const BoxFrame round = frame.turned_round();
        if (nearest_from_corner(round, foremost_corner(round, face.number - 3), meeting)) {
            turn_round(frame, meeting);
            return true;
        }
    }
    if (nearest_corner(frame, meeting)) return true;
    const BoxEdgeGaps edges(frame, face.gap);
    const std::size_t number = edges.widest(0);
    if (number < 9 && meeting_edges(frame, number, meeting) && meeting.distance > 0) return true;
    return face.gap > 0 && meeting_face(frame, face, meeting);
}

/// Where edges are deepest in one another.
bool deepest_edges(const BoxFrame& frame, const BoxFaceGap& face, const BoxEdgeGaps& edges, BoxMeeting& meeting) {
    if (!meeting_edges(frame, edges.widest(face.gap), meeting)) return false;
    meeting.distance = std::min(meeting.distance, 0.0);
    return true;
}

bool meeting_of(const BoxFrame& frame, BoxMeeting& meeting) {
    const BoxFaceGap face = widest_face_gap(frame);
    if (face.gap > 0) return nearest_points(frame, face, meeting);
    const BoxEdgeGaps edges(frame, face.gap);
    if (edges.apart) return nearest_points(frame, face, meeting);
    return edges.beats_face ? deepest_edges(frame, face, edges, meeting) : meeting_face(frame, face, meeting);
}

/// Whether all of a part is one corner.
bool is_corner(const std::array<std::uint32_t, 4>& numbers, std::uint32_t count) {
    bool other = numbers[0] > 7;
    for (std::uint32_t i = 1; i < 4; ++i) other |= (i < count) & (numbers[i] != numbers[0]);
    return !other;
}

/// Whether a corner of one is nearest to the other, as the last time.
bool nearest_as_before(const Convex<3>& a, const Convex<3>& b, const Cache& cache, SignedDistance<3>& distance) {
    const bool of_a = is_corner(cache.corner_a, cache.count), of_b = is_corner(cache.corner_b, cache.count);
    if (cache.count == 0 || !(of_a || of_b)) return false;
    const Convex<3>&first = of_b ? a : b, &second = of_b ? b : a;
    BoxMeeting meeting;
    if (!nearest_from_corner(BoxFrame(first, second), of_b ? cache.corner_b[0] : cache.corner_a[0], meeting))
        return false;
    in_world(BoxPlacement(first), meeting, !of_b, distance);
    set_corners(meeting, !of_b, distance.corners);
    return true;
}

void remember(const SignedDistance<3>& distance, Cache& cache) {
    for (std::size_t i = 0; i < 3; ++i) {
        cache.axis[i] = static_cast<float>(distance.normal[static_cast<int>(i)]);
        cache.corner_a[i] = distance.corners.a[i];
        cache.corner_b[i] = distance.corners.b[i];
    }
    cache.count = static_cast<std::uint32_t>(distance.corners.count);
}

}  // namespace

// Who watches is shown the searches, which come to the same.

bool boxes_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (options.trace != nullptr) convex_overlap(a, b, {.trace = options.trace});
    if (still_parted(a, b, 0, options.cache)) return false;
    const BoxFrame frame(a, b);
    const BoxFaceGap face = widest_face_gap(frame);
    if (face.gap > 0) {
        if (options.cache != nullptr) remember_axis(BoxPlacement(a), face_normal(frame, face.number), options.cache);
        return false;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (!edges.apart) return true;
    if (options.cache != nullptr) remember_axis(BoxPlacement(a), unit_edge_axis(frame, edges.widest(0)), options.cache);
    return false;
}

SignedDistance<3> distance_of_boxes(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    SignedDistance<3> result;
    if (options.trace != nullptr) signed_distance(a, b, {.trace = options.trace});
    if (options.cache == nullptr || !nearest_as_before(a, b, *options.cache, result)) {
        const BoxFrame frame(a, b);
        BoxMeeting meeting;
        if (!meeting_of(frame, meeting)) {
            result = signed_distance(a, b, options);
            return result;
        }
        in_world(BoxPlacement(a), meeting, false, result);
        set_corners(meeting, false, result.corners);
    }
    if (options.cache != nullptr && result.distance > 0) remember(result, *options.cache);
    return result;
}

BoxContact contact_in_frame(const BoxFrame& frame, const BoxFaceGap& face, const BoxPlacement& a, const BoxPlacement& b,
                            double reach, double margin, Cache* cache, BoxMeeting& meeting, SignedDistance<3>& distance,
                            Manifold<3>& points) {
    if (face.gap > reach) {
        remember_axis(a, face_normal(frame, face.number), cache);
        return BoxContact::none;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (edges.apart && edges.wider_than(reach)) {
        remember_axis(a, unit_edge_axis(frame, edges.widest(0)), cache);
        return BoxContact::none;
    }
    const bool apart = face.gap > 0 || edges.apart, along_face = !apart && !edges.beats_face;
    bool found = true;
    if (along_face)
        meet_along(frame, face_normal(frame, face.number), face.gap, meeting);
    else
        found = apart ? nearest_points(frame, face, meeting) : deepest_edges(frame, face, edges, meeting);
    if (!found) return BoxContact::unknown;
    if (meeting.distance > reach) {
        remember_axis(a, meeting.normal, cache);
        return BoxContact::none;
    }
    in_world(a, meeting, false, distance);
    DVec<3>* const place = along_face ? &distance.on_a : nullptr;
    return manifold_of_boxes(a, b, frame, meeting, margin, place, points) ? BoxContact::some : BoxContact::unknown;
}

bool contact_of_boxes(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                      const SearchOptions<3>& options, SignedDistance<3>& distance, Manifold<3>& points) {
    if (options.trace != nullptr)
        manifold(a, b, signed_distance(a, b, {.trace = options.trace}), margin, options.trace);
    if (still_parted(a, b, reach, options.cache)) return false;
    const BoxFrame frame(a, b);
    BoxMeeting meeting;
    const BoxContact contact = contact_in_frame(frame, widest_face_gap(frame), BoxPlacement(a), BoxPlacement(b), reach,
                                                margin, options.cache, meeting, distance, points);
    if (contact != BoxContact::unknown) {
        set_corners(meeting, false, distance.corners);
        return contact == BoxContact::some;
    }
    distance = signed_distance(a, b, options);
    if (distance.distance > reach) return false;
    points = manifold(a, b, distance, margin);
    return true;
}

}  // namespace abut
