#include <abut/convex/box_manifold.hpp>
#include <abut/convex/box_patch.hpp>
#include <abut/convex/largest_quadrilateral.hpp>

namespace abut {
namespace {

/// A place along the axes of a box, in the world.
void put(const BoxPlacement& box, const Triple& place, DVec<3>& position) {
    const Affine<3>& map = box.place;
    for (int i = 0; i < 3; ++i)
        position[i] =
            map.offset[i] +
            (map.column[0][i] * place[0] + map.column[1][i] * place[1] + map.column[2][i] * place[2]) * box.one;
}

/// Writes points where they are wanted, number by number.
struct Writer {
    const BoxPlacement &a, &b;
    const BoxMeeting& meeting;
    double margin, slack;
    DVec<3>* on_a;
    Manifold<3>& points;

    void add_witness() const {
        Triple middle;
        for (std::size_t k = 0; k < 3; ++k) middle[k] = meeting.on_a[k] + meeting.normal[k] * (0.5 * meeting.distance);
        ManifoldPoint<3>& point = points.points[points.count++];
        put(a, middle, point.position);
        point.depth = -meeting.distance;
        point.feature = meeting.part_a.low << 8 ^ meeting.part_b.low;
    }

    /// The points between a face of `box`, which sees the other one so, and that one. The name is added to those of all
    /// points.
    bool add_patch(const BoxPlacement& box, const BoxFrame& frame, const Triple& out, std::uint32_t name) const {
        const BoxPatch patch(frame, out);
        const double depth = -meeting.distance;
        std::array<double, BoxPatch::capacity + 1> x, y, depths;
        std::array<std::size_t, BoxPatch::capacity + 1> number;
        std::size_t count = 0;
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < patch.count; ++i) {
            // No two places are deeper than the boxes; faces that are not quite along the normal may say so.
            const double here = -patch.gap[i] < depth ? -patch.gap[i] : depth;
            x[count] = patch.x[i];
            y[count] = patch.y[i];
            depths[count] = here;
            number[count] = i;
            count += here >= -margin - slack ? 1 : 0;
            most = here > most ? here : most;
        }
        // A corner may lie on no face that looks along the normal.
        const bool lacks_deepest = most < depth - slack;
        if (lacks_deepest && on_a != nullptr) return false;
        if (lacks_deepest) add_witness();
        if (on_a != nullptr) {
            const std::size_t nearest = patch.nearest();
            Triple place = patch.foot(nearest);
            if (&box == &b)
                for (std::size_t i = 0; i < 3; ++i) place[i] += out[i] * patch.gap[nearest];
            put(box, place, *on_a);
        }

        std::array<std::size_t, 4> kept{0, 1, 2, 3};
        std::size_t keep = std::min(count, kept.size() - points.count);
        if (count > keep) {
            // Of those that are as deep to within the slack the first, which stays the same from frame to frame.
            std::size_t deepest = 0;
            while (depths[deepest] < most - slack) ++deepest;
            kept = largest_quadrilateral({x.data(), count}, {y.data(), count}, deepest);
        }
        for (std::size_t k = 0; k < keep; ++k) {
            const std::size_t i = kept[k];
            if (std::find(kept.begin(), kept.begin() + k, i) != kept.begin() + k) continue;
            Triple place = patch.foot(number[i]);
            const double along = patch.gap[number[i]] + 0.5 * depths[i];
            for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += out[axis] * along;
            ManifoldPoint<3>& point = points.points[points.count++];
            put(box, place, point.position);
            point.depth = margin > 0 || depths[i] > 0 ? depths[i] : 0;
            point.feature = patch.name(number[i]) | name;
        }
        return true;
    }
};

}  // namespace

bool manifold_of_boxes(const BoxPlacement& a, const BoxPlacement& b, const BoxFrame& frame, const BoxMeeting& meeting,
                       double margin, DVec<3>* on_a, Manifold<3>& points) {
    const Triple &half_a = frame.half_a, &half_b = frame.half_b;
    const double slack = 1e-6 * std::min(half_a[0] + half_a[1] + half_a[2], half_b[0] + half_b[1] + half_b[2]);
    const Writer writer{a, b, meeting, margin, slack, on_a, points};
    points.count = 0;
    const Triple along_b = frame.along_b(meeting.normal);
    const double alignment_a = std::abs(meeting.normal[steepest(meeting.normal)]);
    const double alignment_b = std::abs(along_b[steepest(along_b)]);
    if (std::max(alignment_a, alignment_b) < aligned) {
        writer.add_witness();
        return true;
    }
    if (alignment_a >= alignment_b - 1e-6) return writer.add_patch(a, frame, meeting.normal, 0);
    return writer.add_patch(b, frame.turned_round(), {-along_b[0], -along_b[1], -along_b[2]}, 1u << 31);
}

}  // namespace abut
