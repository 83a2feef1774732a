#include <abut/convex/gjk/trace.hpp>
#include <abut/convex/manifold/box_face_clip.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/manifold/reduce.hpp>
#include <abut/convex/pairs/box3.hpp>
#include <abut/convex/pairs/box_axes.hpp>
#include <abut/convex/pairs/box_closest.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// A point in the frame of a box, in the world.
lanes::Double3 point_of(const PlacedBox& box, const Triple& place) {
    return box.center + box.axes.vector(in_lanes(place));
}

/// Writes points in place, component by component.
struct Writer {
    const PlacedBox &a, &b;
    const BoxClosest& closest;
    double margin, tolerance;
    lanes::Double3* on_a;
    Manifold<3>& points;

    void add_witness() const {
        Triple middle;
        for (std::size_t k = 0; k < 3; ++k) middle[k] = closest.on_a[k] + closest.normal[k] * (0.5 * closest.distance);
        ManifoldPoint<3>& point = points.points[points.count++];
        lanes::put(point_of(a, middle), &point.position.x);
        point.depth = -closest.distance;
        point.feature = closest.part_a.low << 8 ^ closest.part_b.low;
    }

    /// Adds the points of the intersection of a face of `box` and a face of the other box, which `frame` holds in its
    /// axes. `name` is added to the feature names.
    bool add_clipped_face(const PlacedBox& box, const BoxFrame& frame, const Triple& out, std::uint32_t name) const {
        const BoxFaceClip clipped(frame, out);
        const double depth = -closest.distance;
        std::array<double, BoxFaceClip::capacity + 1> x, y, depths;
        std::array<std::size_t, BoxFaceClip::capacity + 1> number;
        std::size_t count = 0;
        double max_depth = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < clipped.count; ++i) {
            // No point is deeper than the boxes, but faces that are not quite orthogonal to the normal may suggest it.
            const double here = -clipped.gap[i] < depth ? -clipped.gap[i] : depth;
            x[count] = clipped.x[i];
            y[count] = clipped.y[i];
            depths[count] = here;
            number[count] = i;
            count += here >= -margin - tolerance ? 1 : 0;
            max_depth = here > max_depth ? here : max_depth;
        }
        // The deepest corner may lie on no face along the normal.
        const bool lacks_deepest = max_depth < depth - tolerance;
        if (lacks_deepest && on_a != nullptr) return false;
        if (lacks_deepest) add_witness();
        if (on_a != nullptr) {
            const std::size_t nearest = clipped.nearest();
            Triple place = clipped.point_on_face(nearest);
            if (&box == &b)
                for (std::size_t i = 0; i < 3; ++i) place[i] += out[i] * clipped.gap[nearest];
            *on_a = point_of(box, place);
        }

        std::array<std::size_t, 4> selected{0, 1, 2, 3};
        std::size_t selected_count = std::min(count, selected.size() - points.count);
        if (count > selected_count) {
            // Of the points that are deepest to within the tolerance the first, which persists from frame to frame.
            std::size_t deepest = 0;
            while (depths[deepest] < max_depth - tolerance) ++deepest;
            selected = largest_quadrilateral({x.data(), count}, {y.data(), count}, deepest);
        }
        for (std::size_t k = 0; k < selected_count; ++k) {
            const std::size_t i = selected[k];
            if (std::find(selected.data(), selected.data() + k, i) != selected.data() + k) continue;
            Triple place = clipped.point_on_face(number[i]);
            const double along = clipped.gap[number[i]] + 0.5 * depths[i];
            for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += out[axis] * along;
            ManifoldPoint<3>& point = points.points[points.count++];
            lanes::put(point_of(box, place), &point.position.x);
            point.depth = margin > 0 || depths[i] > 0 ? depths[i] : 0;
            point.feature = clipped.name(number[i]) | name;
        }
        return true;
    }
};

/// As `manifold`, from the closest features of two boxes. Feature names are its own: they persist while the same
/// corners and edges touch and the same face is the reference. If the normal is that of a face, the closest point need
/// not be known: it is written to `on_a`, in the world, unless that is null. Returns false, with the points undefined,
/// if it isn't found.
bool manifold_of_boxes(const PlacedBox& a, const PlacedBox& b, const BoxFrame& frame, const BoxClosest& closest,
                       double margin, lanes::Double3* on_a, Manifold<3>& points) {
    const Triple &half_a = frame.half_a, &half_b = frame.half_b;
    const double tolerance = 1e-6 * std::min(half_a[0] + half_a[1] + half_a[2], half_b[0] + half_b[1] + half_b[2]);
    const Writer writer{a, b, closest, margin, tolerance, on_a, points};
    points.count = 0;
    const Triple along_b = frame.along_b(closest.normal);
    const double alignment_a = std::abs(closest.normal[steepest(closest.normal)]);
    const double alignment_b = std::abs(along_b[steepest(along_b)]);
    if (std::max(alignment_a, alignment_b) < aligned) {
        writer.add_witness();
        return true;
    }
    if (alignment_a >= aligned) return writer.add_clipped_face(a, frame, closest.normal, 0);
    return writer.add_clipped_face(b, frame.swapped(), {-along_b[0], -along_b[1], -along_b[2]}, 1u << 31);
}

}  // namespace
bool still_separated(const PlacedBox& a, const PlacedBox& b, double reach, const Cache& cache) {
    using namespace lanes;
    if (reach < 0) return false;
    const Double3 axis{loaded(cache.axis.data()), loaded_twice(cache.axis[2])};
    const double apart = dot(axis, b.center - a.center)[0];
    const double covered =
        (dot(magnitude(a.axes.transposed(axis)), a.half) + dot(magnitude(b.axes.transposed(axis)), b.half))[0];
    // The cached axis has length 1 to within 1e-6, or it is zero.
    const double tolerance = 1e-14 * (std::abs(apart) + covered) + 1e-6 * reach;
    return apart - covered > reach + tolerance && apart <= std::numeric_limits<double>::max() &&
           dot(axis, axis)[0] < 1 + 1e-6;
}

namespace {

void store_axis(const lanes::Double3& axis, Cache* cache) {
    lanes::store(axis.xy, cache->axis.data());
    cache->axis[2] = static_cast<float>(axis.z[0]);
}
void store_axis(const PlacedBox& a, const Triple& normal, Cache* cache) {
    if (cache != nullptr) store_axis(a.axes.vector(in_lanes(normal)), cache);
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
    const double one = 1 / square_root(dot(axis, axis));
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
        const double half = frame.axis_b[j][axis] * closest.normal[axis] > 0 ? -frame.half_b[j] : frame.half_b[j];
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
/// with the widest gap, or both are on edges. Else the corner nearest to where one search ends starts the next, by
/// turns of either box.
bool nearest_points(const BoxFrame& frame, const BoxFaceGap& face, BoxClosest& closest) {
    const bool of_b = face.number > 2;
    BoxFrame swapped_frame;
    if (of_b) swapped_frame = frame.swapped();
    const auto find_from = [&](bool in_b, std::uint32_t corner) {
        if (!nearest_from_corner(in_b ? swapped_frame : frame, corner, closest)) return false;
        if (in_b) flip(frame, closest);
        return true;
    };
    if (face.gap > 0 && find_from(of_b, foremost_corner(of_b ? swapped_frame : frame, face.number % 3))) return true;
    std::uint32_t corner = closest.part_a.low;

    const BoxEdgeGaps edges(frame, face.gap);
    const std::size_t number = edges.widest(0);
    if (number < 9 && closest_on_edges(frame, number, closest) && closest.distance > 0) return true;

    if (!of_b) swapped_frame = frame.swapped();
    for (int turn = 1; turn < 5; ++turn) {
        if (find_from(of_b != (turn % 2 == 1), corner)) return true;
        corner = closest.part_a.low;
    }
    return face.gap > 0 && closest_on_face(frame, face, closest);
}

/// The edges of deepest penetration.
bool deepest_edges(const BoxFrame& frame, const BoxFaceGap& face, const BoxEdgeGaps& edges, BoxClosest& closest) {
    if (!closest_on_edges(frame, edges.widest(face.gap), closest)) return false;
    closest.distance = std::min(closest.distance, 0.0);
    return true;
}

bool find_closest(const BoxFrame& frame, const BoxFaceGap& face, BoxClosest& closest) {
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

/// The axis of an edge by its two corners; 3 if they are not the ends of an edge.
std::uint32_t axis_of_edge(const std::array<std::uint32_t, 4>& corners) {
    const std::uint32_t bit = corners[0] ^ corners[1];
    return bit == 1 ? 0 : bit == 2 ? 1 : bit == 4 ? 2 : 3;
}

/// Warm start: whether the cached corner, or the cached edges, are still the closest ones.
bool nearest_as_before(const PlacedBox& a, const PlacedBox& b, const Cache& cache, CoresDistance& found) {
    if (cache.count == 0) return false;
    const bool of_b = is_corner(cache.corner_b, cache.count), of_a = !of_b && is_corner(cache.corner_a, cache.count);
    const PlacedBox &first = of_a ? b : a, &second = of_a ? a : b;
    const BoxFaceGaps gaps(first, second);
    if (!gaps.finite()) return false;
    const BoxFrame frame = gaps.frame();
    BoxClosest closest;
    if (of_a || of_b) {
        if (!nearest_from_corner(frame, of_b ? cache.corner_b[0] : cache.corner_a[0], closest)) return false;
    } else {
        const std::uint32_t edge_a = axis_of_edge(cache.corner_a), edge_b = axis_of_edge(cache.corner_b);
        if (cache.count != 2 || edge_a == 3 || edge_b == 3) return false;
        if (!closest_on_edges(frame, 3 * edge_a + edge_b, closest) || !(closest.distance > 0)) return false;
    }
    set_world_distance(first, closest, of_a, found);
    return true;
}

void store(const CoresDistance& found, Cache& cache) {
    ClosestCorners<3> corners;
    set_corners(found.part_a, found.part_b, corners);
    for (std::size_t i = 0; i < 3; ++i) {
        cache.corner_a[i] = corners.a[i];
        cache.corner_b[i] = corners.b[i];
    }
    cache.count = static_cast<std::uint32_t>(corners.count);
    store_axis(found.normal, &cache);
}

}  // namespace

PairAnswer boxes_overlap(const PlacedBox& a, const PlacedBox& b, const BoxFaceGaps& gaps, Cache* cache) {
    const double reach = a.radius[0] + b.radius[0];
    const BoxFaceGap face = gaps.widest();
    const BoxFrame frame = gaps.frame();
    if (face.gap > reach) {
        store_axis(a, face_normal(frame, face.number), cache);
        return PairAnswer::no;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (face.gap <= 0 && !edges.apart) return PairAnswer::yes;
    if (reach == 0 || (edges.apart && edges.wider_than(reach))) {
        if (cache != nullptr) store_axis(a, unit_edge_axis(frame, edges.widest(0)), cache);
        return PairAnswer::no;
    }
    BoxClosest closest;
    if (!nearest_points(frame, face, closest)) return PairAnswer::unknown;
    if (closest.distance <= reach) return PairAnswer::yes;
    store_axis(a, closest.normal, cache);
    return PairAnswer::no;
}

bool distance_of_boxes(const PlacedBox& a, const PlacedBox& b, Cache* cache, CoresDistance& found) {
    if (cache == nullptr || !nearest_as_before(a, b, *cache, found)) {
        const BoxFaceGaps gaps(a, b);
        BoxClosest closest;
        if (!gaps.finite() || !find_closest(gaps.frame(), gaps.widest(), closest)) return false;
        set_world_distance(a, closest, false, found);
    }
    if (cache != nullptr && found.distance[0] > 0) store(found, *cache);
    add_balls(a.radius, b.radius, found);
    return true;
}

PairAnswer contact_of_boxes(const PlacedBox& a, const PlacedBox& b, double reach, double margin, Cache* cache,
                            CoresDistance& found, Manifold<3>& points) {
    if (cache != nullptr && still_separated(a, b, reach, *cache)) return PairAnswer::no;
    const BoxFaceGaps gaps(a, b);
    if (!gaps.finite()) return PairAnswer::unknown;
    const BoxFaceGap face = gaps.widest();
    const BoxFrame frame = gaps.frame();
    if (face.gap > reach) {
        store_axis(a, face_normal(frame, face.number), cache);
        return PairAnswer::no;
    }
    const BoxEdgeGaps edges(frame, face.gap);
    if (edges.apart && edges.wider_than(reach)) {
        store_axis(a, unit_edge_axis(frame, edges.widest(0)), cache);
        return PairAnswer::no;
    }
    BoxClosest closest;
    const bool apart = face.gap > 0 || edges.apart, along_face = !apart && !edges.beats_face;
    bool known = true;
    if (along_face)
        set_features_along(frame, face_normal(frame, face.number), face.gap, closest);
    else
        known = apart ? nearest_points(frame, face, closest) : deepest_edges(frame, face, edges, closest);
    if (!known) return PairAnswer::unknown;
    if (closest.distance > reach) {
        store_axis(a, closest.normal, cache);
        return PairAnswer::no;
    }
    set_world_distance(a, closest, false, found);
    lanes::Double3* const place = along_face ? &found.on_a : nullptr;
    return manifold_of_boxes(a, b, frame, closest, margin, place, points) ? PairAnswer::yes : PairAnswer::unknown;
}

void record_axes(const PlacedBox& a, const PlacedBox& b, Trace<3>& trace) {
    const auto record = [&](const DVec<3>& direction) {
        const DVec<3> from_a = lanes::vector(a.center), from_b = lanes::vector(b.center);
        if (!(length_squared(direction) > 1e-12)) return;
        const DVec<3> axis = normalized(dot(direction, from_b - from_a) < 0 ? -direction : direction);
        const lanes::Double3 along = lanes::double3(axis);
        const double reach_a = dot(magnitude(a.axes.transposed(along)), a.half)[0], at_a = dot(axis, from_a);
        const double reach_b = dot(magnitude(b.axes.transposed(along)), b.half)[0], at_b = dot(axis, from_b);
        trace.steps.push_back(AxisStep<3>{to_float(axis), static_cast<float>(at_a - reach_a),
                                          static_cast<float>(at_a + reach_a), static_cast<float>(at_b - reach_b),
                                          static_cast<float>(at_b + reach_b)});
    };
    const auto columns = [](const PlacedBox& box) {
        return std::array{lanes::vector(box.axes.first_column()), lanes::vector(box.axes.second_column()),
                          lanes::vector(box.axes.last_column())};
    };
    const std::array<DVec<3>, 3> of_a = columns(a), of_b = columns(b);
    for (const DVec<3>& normal : of_a) record(normal);
    for (const DVec<3>& normal : of_b) record(normal);
    for (const DVec<3>& edge_a : of_a)
        for (const DVec<3>& edge_b : of_b) record(cross(edge_a, edge_b));
}

}  // namespace abut::detail
