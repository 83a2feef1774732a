#include <abut/convex/manifold/box_face_clip.hpp>
#include <abut/convex/manifold/box_manifold.hpp>
#include <abut/convex/pairs/box3.hpp>
#include <abut/convex/pairs/box_axes.hpp>
#include <abut/convex/pairs/box_distance.hpp>

namespace abut::detail {
namespace {

/// Warm start: whether the cached axis still separates the boxes by more than `reach`, which is not below zero. An
/// unset axis separates nothing.
bool still_separated(const Convex<3>& a, const Convex<3>& b, double reach, const Cache* cache) {
    if (cache == nullptr || reach < 0) return false;
    const DVec<3> axis(static_cast<double>(cache->axis[0]), static_cast<double>(cache->axis[1]),
                       static_cast<double>(cache->axis[2]));
    double middle = dot(axis, b.place.offset - a.place.offset), covered = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        covered += std::abs(dot(axis, a.place.column[i])) * static_cast<double>(a.own[0][static_cast<int>(i)]);
        covered += std::abs(dot(axis, b.place.column[i])) * static_cast<double>(b.own[0][static_cast<int>(i)]);
    }
    // The cached axis has length 1 to within 1e-6, or it is zero.
    const double tolerance = 1e-14 * (std::abs(middle) + covered) + 1e-6 * reach;
    return middle - covered > reach + tolerance && length_squared(axis) < 1 + 1e-6;
}

void store_axis(const BoxPlacement& a, const Triple& normal, Cache* cache) {
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

/// The features of both that are extreme along a face normal; the closest point itself stays unset.
void set_features_along(const BoxFrame& frame, const Triple& normal, double gap, BoxClosest& closest) {
    const Triple rotated = frame.along_b(normal);
    const double level = 1e-9 * frame.scale();
    closest.distance = gap;
    closest.part_a = closest.part_b = {};
    for (std::size_t i = 0; i < 3; ++i) {
        const bool level_a = std::abs(normal[i]) * frame.half_a[i] <= level,
                   level_b = std::abs(rotated[i]) * frame.half_b[i] <= level;
        closest.normal[i] = normal[i];
        closest.part_a.free |= level_a ? 1u << i : 0u;
        closest.part_a.low |= normal[i] < 0 && !level_a ? 1u << i : 0u;
        closest.part_b.free |= level_b ? 1u << i : 0u;
        closest.part_b.low |= rotated[i] > 0 && !level_b ? 1u << i : 0u;
    }
}

/// The closest point on the face of A across an axis, along its normal.
bool closest_on_face_of_a(const BoxFrame& frame, std::size_t axis, double gap, BoxClosest& closest) {
    set_features_along(frame, face_normal(frame, axis), gap, closest);
    const std::size_t u = next_axis(axis), v = last_axis(axis);
    const double side = frame.half_a[axis] * closest.normal[axis];
    Triple nearest{frame.middle[0], frame.middle[1], frame.middle[2]};
    for (std::size_t j = 0; j < 3; ++j) {
        const double half = frame.axis_b[j][axis] * side > 0 ? -frame.half_b[j] : frame.half_b[j];
        for (std::size_t i = 0; i < 3; ++i) nearest[i] += frame.axis_b[j][i] * half;
    }
    if (std::abs(nearest[u]) <= frame.half_a[u] && std::abs(nearest[v]) <= frame.half_a[v]) {
        for (std::size_t i = 0; i < 3; ++i) closest.on_a[i] = i == axis ? side : nearest[i];
        return true;
    }
    const BoxFaceClip clipped(frame, closest.normal);
    const std::size_t i = clipped.nearest();
    if (i == clipped.count || clipped.gap[i] > gap + 1e-9 * frame.scale()) return false;
    closest.on_a = clipped.point_on_face(i);
    return true;
}

/// The closest point on a face of either box.
bool closest_on_face(const BoxFrame& frame, const BoxFaceGap& face, BoxClosest& closest) {
    if (face.number < 3) return closest_on_face_of_a(frame, face.number, face.gap, closest);
    if (!closest_on_face_of_a(frame.swapped(), face.number - 3, face.gap, closest)) return false;
    flip(frame, closest);
    return true;
}

/// The corner of B that reaches farthest against the face of A across an axis.
std::uint32_t foremost_corner(const BoxFrame& frame, std::size_t axis) {
    std::uint32_t corner = 0;
    for (std::size_t j = 0; j < 3; ++j) corner |= frame.axis_b[j][axis] * frame.middle[axis] > 0 ? 1u << j : 0u;
    return corner;
}

/// The closest points of disjoint boxes. In most cases one of them is the corner that reaches farthest against the face
/// with the widest gap.
bool nearest_points(const BoxFrame& frame, const BoxFaceGap& face, BoxClosest& closest) {
    if (face.gap > 0 && face.number < 3) {
        if (nearest_from_corner(frame, foremost_corner(frame, face.number), closest)) return true;
    } else if (face.gap > 0) {
        const BoxFrame swapped_frame = frame.swapped();
        if (nearest_from_corner(swapped_frame, foremost_corner(swapped_frame, face.number - 3), closest)) {
            flip(frame, closest);
            return true;
        }
    }
    if (nearest_corner(frame, closest)) return true;
    const BoxEdgeGaps edges(frame, face.gap);
    const std::size_t number = edges.widest(0);
    if (number < 9 && closest_on_edges(frame, number, closest) && closest.distance > 0) return true;
    return face.gap > 0 && closest_on_face(frame, face, closest);
}

/// The edges of deepest penetration.
bool deepest_edges(const BoxFrame& frame, const BoxFaceGap& face, const BoxEdgeGaps& edges, BoxClosest& closest) {
    if (!closest_on_edges(frame, edges.widest(face.gap), closest)) return false;
    closest.distance = std::min(closest.distance, 0.0);
    return true;
}

bool find_closest(const BoxFrame& frame, BoxClosest& closest) {
    const BoxFaceGap face = widest_face_gap(frame);
    if (face.gap > 0) return nearest_points(frame, face, closest);
    const BoxEdgeGaps edges(frame, face.gap);
    if (edges.apart) return nearest_points(frame, face, closest);
    return edges.beats_face ? deepest_edges(frame, face, edges, closest) : closest_on_face(frame, face, closest);
}

/// Whether a feature is a single corner.
bool is_corner(const std::array<std::uint32_t, 4>& numbers, std::uint32_t count) {
    bool other = numbers[0] > 7;
    for (std::uint32_t i = 1; i < 4; ++i) other |= (i < count) & (numbers[i] != numbers[0]);
    return !other;
}

/// Warm start: whether the cached corner is still the closest one.
bool nearest_as_before(const Convex<3>& a, const Convex<3>& b, const Cache& cache, SignedDistance<3>& distance) {
    const bool of_a = is_corner(cache.corner_a, cache.count), of_b = is_corner(cache.corner_b, cache.count);
    if (cache.count == 0 || !(of_a || of_b)) return false;
    const Convex<3>&first = of_b ? a : b, &second = of_b ? b : a;
    BoxClosest closest;
    if (!nearest_from_corner(BoxFrame(first, second), of_b ? cache.corner_b[0] : cache.corner_a[0], closest))
        return false;
    set_world_distance(BoxPlacement(first), closest, !of_b, distance);
    set_corners(closest, !of_b, distance.corners);
    return true;
}

void store(const SignedDistance<3>& distance, Cache& cache) {
    for (std::size_t i = 0; i < 3; ++i) {
        cache.axis[i] = static_cast<float>(distance.normal[static_cast<int>(i)]);
        cache.corner_a[i] = distance.corners.a[i];
        cache.corner_b[i] = distance.corners.b[i];
    }
    cache.count = static_cast<std::uint32_t>(distance.corners.count);
}

}  // namespace

// With a trace, the general algorithms run first, so that their steps are recorded. Their answers agree.

bool boxes_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (options.trace != nullptr) convex_overlap(a, b, {.trace = options.trace});
    if (still_separated(a, b, 0, options.cache)) return false;
    const BoxFrame frame(a, b);
    const BoxFaceGap face = widest_face_gap(frame);
    if (face.gap > 0) {
        if (options.cache != nullptr) store_axis(BoxPlacement(a), face_normal(frame, face.number), options.cache);
        return false;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (!edges.apart) return true;
    if (options.cache != nullptr) store_axis(BoxPlacement(a), unit_edge_axis(frame, edges.widest(0)), options.cache);
    return false;
}

SignedDistance<3> distance_of_boxes(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    SignedDistance<3> result;
    if (options.trace != nullptr) signed_distance(a, b, {.trace = options.trace});
    if (options.cache == nullptr || !nearest_as_before(a, b, *options.cache, result)) {
        const BoxFrame frame(a, b);
        BoxClosest closest;
        if (!find_closest(frame, closest)) {
            result = signed_distance(a, b, options);
            return result;
        }
        set_world_distance(BoxPlacement(a), closest, false, result);
        set_corners(closest, false, result.corners);
    }
    if (options.cache != nullptr && result.distance > 0) store(result, *options.cache);
    return result;
}

BoxContact contact_in_frame(const BoxFrame& frame, const BoxFaceGap& face, const BoxPlacement& a, const BoxPlacement& b,
                            double reach, double margin, Cache* cache, BoxClosest& closest, SignedDistance<3>& distance,
                            Manifold<3>& points) {
    if (face.gap > reach) {
        store_axis(a, face_normal(frame, face.number), cache);
        return BoxContact::none;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (edges.apart && edges.wider_than(reach)) {
        store_axis(a, unit_edge_axis(frame, edges.widest(0)), cache);
        return BoxContact::none;
    }
    const bool apart = face.gap > 0 || edges.apart, along_face = !apart && !edges.beats_face;
    bool found = true;
    if (along_face)
        set_features_along(frame, face_normal(frame, face.number), face.gap, closest);
    else
        found = apart ? nearest_points(frame, face, closest) : deepest_edges(frame, face, edges, closest);
    if (!found) return BoxContact::unknown;
    if (closest.distance > reach) {
        store_axis(a, closest.normal, cache);
        return BoxContact::none;
    }
    set_world_distance(a, closest, false, distance);
    DVec<3>* const place = along_face ? &distance.on_a : nullptr;
    return manifold_of_boxes(a, b, frame, closest, margin, place, points) ? BoxContact::some : BoxContact::unknown;
}

bool contact_of_boxes(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                      const SearchOptions<3>& options, SignedDistance<3>& distance, Manifold<3>& points) {
    if (options.trace != nullptr)
        manifold(a, b, signed_distance(a, b, {.trace = options.trace}), margin, options.trace);
    if (still_separated(a, b, reach, options.cache)) return false;
    const BoxFrame frame(a, b);
    BoxClosest closest;
    const BoxContact contact = contact_in_frame(frame, widest_face_gap(frame), BoxPlacement(a), BoxPlacement(b), reach,
                                                margin, options.cache, closest, distance, points);
    if (contact != BoxContact::unknown) {
        set_corners(closest, false, distance.corners);
        return contact == BoxContact::some;
    }
    distance = signed_distance(a, b, options);
    if (distance.distance > reach) return false;
    points = manifold(a, b, distance, margin);
    return true;
}

}  // namespace abut::detail
