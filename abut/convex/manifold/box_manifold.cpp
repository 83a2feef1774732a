#include <abut/convex/manifold/box_face_clip.hpp>
#include <abut/convex/manifold/box_manifold.hpp>
#include <abut/convex/manifold/reduce.hpp>

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
            if (std::find(selected.begin(), selected.begin() + k, i) != selected.begin() + k) continue;
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

}  // namespace

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

}  // namespace abut::detail
