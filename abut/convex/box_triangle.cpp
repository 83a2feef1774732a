// The sides of the difference of a box and a triangle are those across the three axes of the box, both of the triangle,
// and those that an edge of each makes: thirteen axes (Gottschalk, Lin, Manocha, "OBBTree", 1996, for a box so thin).
// Where the two overlap, the least depth along one of them is the depth; where one of them parts them, that suffices.

#include <abut/convex/box_triangle.hpp>

namespace abut {
namespace {

/// By so much, in parts of the largest coordinate, may rounding move a place.
constexpr double doubt = 1e-10;
/// Triangles whose sides meet at no greater sine than a thousandth are left to the searches.
constexpr double thin = 1e-6;

/// A triangle as a box sees it from its middle, along its axes; lengths are those of the world.
struct Seen {
    DVec<3> half;
    std::array<DVec<3>, 3> corner;

    Seen(const Convex<3>& box, const Convex<3>& triangle) : half(DVec<3>(box.own[0]) * box.scale) {
        const double one = 1 / box.scale;
        for (std::uint32_t i = 0; i < 3; ++i)
            corner[i] = box.place.transposed(core_corner(triangle, i) - box.place.offset) * one;
    }

    double scale() const {
        double most = 0;
        for (const DVec<3>& c : corner) most = std::max(most, largest(c));
        return most + half.x + half.y + half.z;
    }
    /// How far the box reaches along a vector, in its lengths.
    double reach(const DVec<3>& v) const {
        return half.x * std::abs(v.x) + half.y * std::abs(v.y) + half.z * std::abs(v.z);
    }
};

/// The widest gap so far; below zero, how deep they are in one another.
struct Gap {
    double width;
    DVec<3> out;  ///< from the box to the triangle
    bool thin = false;
};

/// The gaps across the sides of both, as far as none is wider than `enough`.
Gap widest_face_gap(const Seen& seen, double enough) {
    const auto& [a, b, c] = seen.corner;
    Gap best{-std::numeric_limits<double>::infinity(), DVec<3>(0.0)};
    for (int i = 0; i < 3; ++i) {
        const double low = std::min(std::min(a[i], b[i]), c[i]), high = std::max(std::max(a[i], b[i]), c[i]);
        const double width = std::max(low, -high) - seen.half[i];
        if (width <= best.width) continue;
        best.width = width;
        best.out = axis<3>(i, low >= -high ? 1 : -1);
    }
    if (best.width > enough) return best;
    const DVec<3> ab = b - a, ac = c - a, area = cross(ab, ac);
    const double square = length_squared(area);
    if (!(square > thin * length_squared(ab) * length_squared(ac))) {
        best.thin = true;
        return best;
    }
    const double one = 1 / std::sqrt(square), height = dot(area, a);
    const double width = (std::abs(height) - seen.reach(area)) * one;
    if (width >= best.width) best = {width, area * (height < 0 ? -one : one)};
    return best;
}

/// The same of an edge of each, where they are wider by more than rounding explains. Stops at one wider than `enough`.
///
/// Along an axis of the box across an edge e of the triangle, of which p is an end, a corner q lies at
///     dot(cross(axis, e), q) = dot(axis, cross(e, q)):
/// both ends of e at cross(e, p), and the third corner farther by the area, whichever edge it is.
void widen_by_edges(const Seen& seen, double enough, double rounding, Gap& best) {
    const DVec<3> area = cross(seen.corner[1] - seen.corner[0], seen.corner[2] - seen.corner[0]);
    DVec<3> to_low, to_high;
    for (int i = 0; i < 3; ++i) {
        to_low[i] = std::min(area[i], 0.0);
        to_high[i] = std::max(area[i], 0.0);
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const DVec<3>& from = seen.corner[j];
        const DVec<3> edge = seen.corner[j == 2 ? 0 : j + 1] - from, ends = cross(edge, from);
        const DVec<3> reach(std::abs(edge.x), std::abs(edge.y), std::abs(edge.z));
        const DVec<3> squared(edge.x * edge.x, edge.y * edge.y, edge.z * edge.z);
        const double no_axis = 1e-18 * (squared.x + squared.y + squared.z);
        // The axis i, and those beside it.
        const auto widen = [&](int i, int u, int v) {
            const double low = ends[i] + to_low[i], high = ends[i] + to_high[i];
            const double width = std::max(low, -high) - (seen.half[u] * reach[v] + seen.half[v] * reach[u]);
            const double square = squared[u] + squared[v];
            // Mostly it is no wider than the face's, which is found out without a root.
            const double least = best.width + rounding;
            if (width < 0 && least <= 0 && width * width >= least * least * square) return;
            if (!(square > no_axis)) return;
            const double one = 1 / std::sqrt(square);
            if (!(width * one > least)) return;
            best.width = width * one;
            const double sign = low >= -high ? one : -one;
            best.out = DVec<3>(0.0);
            best.out[u] = -edge[v] * sign;
            best.out[v] = edge[u] * sign;
        };
        widen(0, 1, 2);
        widen(1, 2, 0);
        widen(2, 0, 1);
        if (best.width > enough) return;
    }
}

/// What of the two meets across a gap, and a place in both.
class Meeting {
public:
    Meeting(const Seen& seen, const Gap& gap, double scale) : seen_(seen), gap_(gap), off_(doubt * scale) {
        const double level = 10 * off_;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t bit = 1u << i;
            if (std::abs(gap.out[i]) * seen.half[i] <= level)
                free_[free_count_++] = bit;
            else if (gap.out[i] < 0)
                first_ |= bit;
        }
        std::array<double, 3> along;
        for (std::size_t i = 0; i < 3; ++i) along[i] = dot(gap.out, seen.corner[i]);
        const double least = std::min(std::min(along[0], along[1]), along[2]);
        for (std::uint32_t i = 0; i < 3; ++i)
            if (along[i] <= least + level) of_triangle_[triangle_count_++] = i;
    }

    /// False where rounding hides it.
    bool find(DVec<3>& on_box, MeetingCorners<3>& corners) const {
        if (free_count_ == 1 && triangle_count_ == 2) return edges_meet(on_box, corners);
        return corner_of_box_meets(on_box, corners) || corner_of_triangle_meets(on_box, corners) ||
               edges_meet(on_box, corners);
    }

private:
    DVec<3> corner_of_box(std::uint32_t number) const {
        DVec<3> result = seen_.half;
        for (int i = 0; i < 3; ++i)
            if ((number >> i & 1u) != 0) result[i] = -result[i];
        return result;
    }
    std::uint32_t box_corner_count() const { return 1u << std::min(free_count_, 2u); }
    std::uint32_t box_corner(std::uint32_t i) const {
        return first_ | ((i & 1u) != 0 ? free_[0] : 0) | ((i & 2u) != 0 ? free_[1] : 0);
    }
    std::uint32_t triangle_edge_count() const { return triangle_count_ == 3 ? 3 : triangle_count_ - 1; }

    bool is_on_triangle(const DVec<3>& place) const {
        const DVec<3>& from = seen_.corner[of_triangle_[0]];
        const DVec<3> way = place - from;
        if (triangle_count_ == 1) return largest(way) <= off_;
        const DVec<3> ab = seen_.corner[of_triangle_[1]] - from;
        if (triangle_count_ == 2) {
            const double part = part_on_segment(dot(way, ab) / length_squared(ab));
            return largest(way - ab * part) <= off_;
        }
        const DVec<3> ac = seen_.corner[2] - from, area = cross(ab, ac);
        const double square = length_squared(area), least = -doubt * square;
        const double b = dot(area, cross(way, ac)), c = dot(area, cross(ab, way));
        return b >= least && c >= least && b + c <= square - least;
    }
    bool corner_of_box_meets(DVec<3>& on_box, MeetingCorners<3>& corners) const {
        for (std::uint32_t i = 0; i < box_corner_count(); ++i) {
            on_box = corner_of_box(box_corner(i));
            if (!is_on_triangle(on_box + gap_.out * gap_.width)) continue;
            corners.count = triangle_count_;
            for (std::size_t j = 0; j < triangle_count_; ++j) {
                corners.a[j] = box_corner(i);
                corners.b[j] = of_triangle_[j];
            }
            return true;
        }
        return false;
    }
    bool corner_of_triangle_meets(DVec<3>& on_box, MeetingCorners<3>& corners) const {
        for (std::size_t j = 0; j < triangle_count_; ++j) {
            on_box = seen_.corner[of_triangle_[j]] - gap_.out * gap_.width;
            bool within = true;
            for (int i = 0; i < 3; ++i) within = within && std::abs(on_box[i]) <= seen_.half[i] + off_;
            if (!within) continue;
            corners.count = box_corner_count();
            for (std::uint32_t i = 0; i < corners.count; ++i) {
                corners.a[i] = box_corner(i);
                corners.b[i] = of_triangle_[j];
            }
            return true;
        }
        return false;
    }
    /// An edge of each, of those that meet.
    bool edges_meet(DVec<3>& on_box, MeetingCorners<3>& corners) const {
        if (free_count_ == 0 || triangle_count_ == 1) return false;
        const std::uint32_t box_edges = free_count_ == 1 ? 1 : 4;
        for (std::uint32_t i = 0; i < box_edges; ++i) {
            // Around a face: 0 to 1, 2 to 3, 0 to 2, 1 to 3.
            const std::uint32_t from = box_corner(i < 2 ? 2 * i : i - 2), to = from | (i < 2 ? free_[0] : free_[1]);
            const DVec<3> start = corner_of_box(from), way = corner_of_box(to) - start;
            for (std::uint32_t j = 0; j < triangle_edge_count(); ++j) {
                const std::uint32_t first = of_triangle_[j], last = of_triangle_[j + 1 == triangle_count_ ? 0 : j + 1];
                const DVec<3> there = seen_.corner[first] - gap_.out * gap_.width;
                const DVec<3> way_there = seen_.corner[last] - seen_.corner[first];
                const Places places = nearest_places(way, way_there, start - there);
                on_box = start + way * places.on_a;
                if (largest(there + way_there * places.on_b - on_box) > off_) continue;
                corners.count = 2;
                corners.a[0] = places.on_a >= 1 ? to : from;
                corners.a[1] = places.on_a <= 0 ? from : to;
                corners.b[0] = places.on_b >= 1 ? last : first;
                corners.b[1] = places.on_b <= 0 ? first : last;
                return true;
            }
        }
        return false;
    }

    const Seen& seen_;
    const Gap& gap_;
    double off_;
    std::uint32_t first_ = 0;              ///< the corner of the box that meets, its free bits clear
    std::array<std::uint32_t, 3> free_{};  ///< bits of axes that lie across
    std::uint32_t free_count_ = 0;
    std::array<std::uint32_t, 3> of_triangle_{};
    std::uint32_t triangle_count_ = 0;
};

}  // namespace

BoxTriangle box_triangle_overlap(const Convex<3>& box, const Convex<3>& triangle) {
    const double balls = box.radius + triangle.radius;
    const Seen seen(box, triangle);
    Gap gap = widest_face_gap(seen, balls);
    if (gap.width > balls) return BoxTriangle::apart;
    if (gap.thin) return BoxTriangle::unknown;
    widen_by_edges(seen, balls, doubt * seen.scale(), gap);
    if (gap.width > balls) return BoxTriangle::apart;
    return gap.width > 0 ? BoxTriangle::unknown : BoxTriangle::meeting;
}

BoxTriangle box_triangle_distance(const Convex<3>& box, const Convex<3>& triangle, double reach,
                                  SignedDistance<3>& result) {
    const double enough = reach + box.radius + triangle.radius;
    const Seen seen(box, triangle);
    Gap gap = widest_face_gap(seen, enough);
    if (gap.width > enough) return BoxTriangle::apart;
    if (gap.thin) return BoxTriangle::unknown;
    const double scale = seen.scale();
    widen_by_edges(seen, enough, doubt * scale, gap);
    if (gap.width > enough) return BoxTriangle::apart;
    DVec<3> on_box;
    if (gap.width > 0 || !Meeting(seen, gap, scale).find(on_box, result.corners)) return BoxTriangle::unknown;
    const double one = 1 / box.scale;
    result.normal = box.place.vector(gap.out) * one;
    result.distance = gap.width - box.radius - triangle.radius;
    result.on_a = box.place.offset + box.place.vector(on_box) * one + result.normal * box.radius;
    return BoxTriangle::meeting;
}

}  // namespace abut
