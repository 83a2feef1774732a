// The face normals of the Minkowski difference of a box and a triangle: the three axes of the box, the normal of the
// triangle, and the cross products of their edges: thirteen separating axes (Gottschalk, Lin, Manocha, "OBBTree", 1996,
// for a box so thin). If they overlap, the minimum depth along the axes is the penetration depth; if one axis separates
// them, that suffices.

#include <abut/convex/pairs/box_triangle.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// The rounding error of a point, relative to the largest coordinate.
constexpr double triangle_tolerance = 1e-10;
/// Slivers, whose edges enclose no sine above a thousandth, are left to the general algorithms.
constexpr double min_sine_squared = 1e-6;

/// A triangle in the frame of the box; lengths are those of the world.
struct TriangleInBox {
    DVec<3> half;
    std::array<DVec<3>, 3> corner;

    TriangleInBox(const Convex<3>& box, const Convex<3>& triangle) : half(DVec<3>(box.own[0]) * box.scale) {
        const double one = 1 / box.scale;
        for (std::uint32_t i = 0; i < 3; ++i)
            corner[i] = box.place.transposed(core_corner(triangle, i) - box.place.offset) * one;
    }

    double scale() const {
        double maximum = 0;
        for (const DVec<3>& c : corner) maximum = std::max(maximum, largest(c));
        return maximum + half.x + half.y + half.z;
    }
    /// The support value of the box along a vector, times its length.
    double reach(const DVec<3>& v) const {
        return half.x * std::abs(v.x) + half.y * std::abs(v.y) + half.z * std::abs(v.z);
    }
};

/// The widest gap so far; below zero, minus the penetration depth.
struct Gap {
    double width;
    DVec<3> out;  ///< from the box to the triangle
    bool thin = false;
};

/// The gaps along the face normals of both, until one is wider than `max_distance`.
Gap widest_face_gap(const TriangleInBox& local, double max_distance) {
    const auto& [a, b, c] = local.corner;
    Gap best{-std::numeric_limits<double>::infinity(), DVec<3>(0.0)};
    for (int i = 0; i < 3; ++i) {
        const double low = std::min(std::min(a[i], b[i]), c[i]), high = std::max(std::max(a[i], b[i]), c[i]);
        const double width = std::max(low, -high) - local.half[i];
        if (width <= best.width) continue;
        best.width = width;
        best.out = axis<3>(i, low >= -high ? 1 : -1);
    }
    if (best.width > max_distance) return best;
    const DVec<3> ab = b - a, ac = c - a, area = cross(ab, ac);
    const double square = length_squared(area);
    if (!(square > min_sine_squared * length_squared(ab) * length_squared(ac))) {
        best.thin = true;
        return best;
    }
    const double one = 1 / square_root(square), height = dot(area, a);
    const double width = (std::abs(height) - local.reach(area)) * one;
    if (width >= best.width) best = {width, area * (height < 0 ? -one : one)};
    return best;
}

/// The gaps along cross products of edges. One replaces the best gap if it is wider by more than the rounding error.
/// Stops at the first gap wider than `max_distance`.
///
/// Along the cross product of an axis of the box and an edge e of the triangle, which starts at p, a corner q lies at
///     dot(cross(axis, e), q) = dot(axis, cross(e, q)):
/// both ends of e at cross(e, p), and the third corner farther by the area, for each edge.
void widen_by_edges(const TriangleInBox& local, double max_distance, double rounding, Gap& best) {
    const DVec<3> area = cross(local.corner[1] - local.corner[0], local.corner[2] - local.corner[0]);
    DVec<3> to_low, to_high;
    for (int i = 0; i < 3; ++i) {
        to_low[i] = std::min(area[i], 0.0);
        to_high[i] = std::max(area[i], 0.0);
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const DVec<3>& from = local.corner[j];
        const DVec<3> edge = local.corner[j == 2 ? 0 : j + 1] - from, ends = cross(edge, from);
        const DVec<3> reach(std::abs(edge.x), std::abs(edge.y), std::abs(edge.z));
        const DVec<3> squared(edge.x * edge.x, edge.y * edge.y, edge.z * edge.z);
        const double min_square = 1e-18 * (squared.x + squared.y + squared.z);
        // The axis i, and those beside it.
        const auto widen = [&](int i, int u, int v) {
            const double low = ends[i] + to_low[i], high = ends[i] + to_high[i];
            const double width = std::max(low, -high) - (local.half[u] * reach[v] + local.half[v] * reach[u]);
            const double square = squared[u] + squared[v];
            // In most cases it is no wider than the face's, which needs no square root to decide.
            const double threshold = best.width + rounding;
            if (width < 0 && threshold <= 0 && width * width >= threshold * threshold * square) return;
            if (!(square > min_square)) return;
            const double one = 1 / square_root(square);
            if (!(width * one > threshold)) return;
            best.width = width * one;
            const double sign = low >= -high ? one : -one;
            best.out = DVec<3>(0.0);
            best.out[u] = -edge[v] * sign;
            best.out[v] = edge[u] * sign;
        };
        widen(0, 1, 2);
        widen(1, 2, 0);
        widen(2, 0, 1);
        if (best.width > max_distance) return;
    }
}

/// The features of both across the gap, and a point on both.
class ContactFeatures {
public:
    ContactFeatures(const TriangleInBox& local, const Gap& gap, double scale)
        : local_(local), gap_(gap), tolerance_(triangle_tolerance * scale) {
        const double level = 10 * tolerance_;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t bit = 1u << i;
            if (std::abs(gap.out[i]) * local.half[i] <= level)
                free_[free_count_++] = bit;
            else if (gap.out[i] < 0)
                first_ |= bit;
        }
        std::array<double, 3> along;
        for (std::size_t i = 0; i < 3; ++i) along[i] = dot(gap.out, local.corner[i]);
        const double lowest = std::min(std::min(along[0], along[1]), along[2]);
        for (std::uint32_t i = 0; i < 3; ++i)
            if (along[i] <= lowest + level) of_triangle_[triangle_count_++] = i;
    }

    /// Returns false if rounding hides it.
    bool find(DVec<3>& on_box, ClosestCorners<3>& corners) const {
        if (free_count_ == 1 && triangle_count_ == 2) return find_on_edges(on_box, corners);
        return find_at_box_corner(on_box, corners) || find_at_triangle_corner(on_box, corners) ||
               find_on_edges(on_box, corners);
    }

private:
    DVec<3> corner_of_box(std::uint32_t number) const {
        DVec<3> result = local_.half;
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
        const DVec<3>& from = local_.corner[of_triangle_[0]];
        const DVec<3> offset = place - from;
        if (triangle_count_ == 1) return largest(offset) <= tolerance_;
        const DVec<3> ab = local_.corner[of_triangle_[1]] - from;
        if (triangle_count_ == 2) {
            const double part = clamp_to_segment(dot(offset, ab) / length_squared(ab));
            return largest(offset - ab * part) <= tolerance_;
        }
        const DVec<3> ac = local_.corner[2] - from, area = cross(ab, ac);
        const double square = length_squared(area), min_weight = -triangle_tolerance * square;
        const double b = dot(area, cross(offset, ac)), c = dot(area, cross(ab, offset));
        return b >= min_weight && c >= min_weight && b + c <= square - min_weight;
    }
    bool find_at_box_corner(DVec<3>& on_box, ClosestCorners<3>& corners) const {
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
    bool find_at_triangle_corner(DVec<3>& on_box, ClosestCorners<3>& corners) const {
        for (std::size_t j = 0; j < triangle_count_; ++j) {
            on_box = local_.corner[of_triangle_[j]] - gap_.out * gap_.width;
            bool within = true;
            for (int i = 0; i < 3; ++i) within = within && std::abs(on_box[i]) <= local_.half[i] + tolerance_;
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
    /// The first pair of edges that cross.
    bool find_on_edges(DVec<3>& on_box, ClosestCorners<3>& corners) const {
        if (free_count_ == 0 || triangle_count_ == 1) return false;
        const std::uint32_t box_edges = free_count_ == 1 ? 1 : 4;
        for (std::uint32_t i = 0; i < box_edges; ++i) {
            // Around a face: 0 to 1, 2 to 3, 0 to 2, 1 to 3.
            const std::uint32_t from = box_corner(i < 2 ? 2 * i : i - 2), to = from | (i < 2 ? free_[0] : free_[1]);
            const DVec<3> start = corner_of_box(from), offset = corner_of_box(to) - start;
            for (std::uint32_t j = 0; j < triangle_edge_count(); ++j) {
                const std::uint32_t first = of_triangle_[j], last = of_triangle_[j + 1 == triangle_count_ ? 0 : j + 1];
                const DVec<3> there = local_.corner[first] - gap_.out * gap_.width;
                const DVec<3> edge_there = local_.corner[last] - local_.corner[first];
                const SegmentParameters places = closest_parameters(offset, edge_there, start - there);
                on_box = start + offset * places.on_a;
                if (largest(there + edge_there * places.on_b - on_box) > tolerance_) continue;
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

    const TriangleInBox& local_;
    const Gap& gap_;
    double tolerance_;
    std::uint32_t first_ = 0;              ///< the corner of the box at the gap, its free bits clear
    std::array<std::uint32_t, 3> free_{};  ///< bits of the axes orthogonal to the gap
    std::uint32_t free_count_ = 0;
    std::array<std::uint32_t, 3> of_triangle_{};
    std::uint32_t triangle_count_ = 0;
};

}  // namespace

PairAnswer box_triangle_overlap(const Convex<3>& box, const Convex<3>& triangle) {
    const double balls = box.radius + triangle.radius;
    const TriangleInBox local(box, triangle);
    Gap gap = widest_face_gap(local, balls);
    if (gap.width > balls) return PairAnswer::no;
    if (gap.thin) return PairAnswer::unknown;
    widen_by_edges(local, balls, triangle_tolerance * local.scale(), gap);
    if (gap.width > balls) return PairAnswer::no;
    return gap.width > 0 ? PairAnswer::unknown : PairAnswer::yes;
}

PairAnswer box_triangle_distance(const Convex<3>& box, const Convex<3>& triangle, double reach,
                                 SignedDistance<3>& result) {
    const double max_distance = reach + box.radius + triangle.radius;
    const TriangleInBox local(box, triangle);
    Gap gap = widest_face_gap(local, max_distance);
    if (gap.width > max_distance) return PairAnswer::no;
    if (gap.thin) return PairAnswer::unknown;
    const double scale = local.scale();
    widen_by_edges(local, max_distance, triangle_tolerance * scale, gap);
    if (gap.width > max_distance) return PairAnswer::no;
    DVec<3> on_box;
    if (gap.width > 0 || !ContactFeatures(local, gap, scale).find(on_box, result.corners)) return PairAnswer::unknown;
    const double one = 1 / box.scale;
    result.normal = box.place.vector(gap.out) * one;
    result.distance = gap.width - box.radius - triangle.radius;
    result.on_a = box.place.offset + box.place.vector(on_box) * one + result.normal * box.radius;
    return PairAnswer::yes;
}

}  // namespace abut::detail
