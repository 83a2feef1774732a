#pragma once

// Placed polygons of few edges and boxes of the plane, in SIMD lanes. Queries of two of one kind stay in registers. For
// .cpp files.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/pairs/edge_gaps2.hpp>
#include <abut/math/simd/double2-inl.h>
#include <abut/query/feature.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>

#include <limits>

namespace abut::polygon_cores {

using lanes::Double2;

/// The Voronoi region of an edge that a point is in, by bits; `nowhere` for NaN.
enum class EdgeRegion : std::uint32_t { within = 0, past_end = 1, before_start = 2, nowhere = 3 };

// The vertices and edges of a shape in its local frame, numbered as in `PolygonSoa`.

class PolygonCore {
public:
    using Shape = Polygon;
    explicit PolygonCore(const detail::PolygonSoa& sides) : sides_(sides) {}
    explicit PolygonCore(const Polygon& polygon) { sides_.view_rows(polygon.sides(), polygon.side_count()); }

    std::uint32_t count() const { return sides_.count; }
    /// Converts the shape's own index of a vertex, and back.
    std::uint32_t number(std::uint32_t i) const { return i; }
    std::uint32_t after(std::uint32_t i) const { return sides_.after(i); }
    std::uint32_t before(std::uint32_t i) const { return sides_.before(i); }
    Double2 corner(std::uint32_t i) const { return lanes::double2(sides_.x[i], sides_.y[i]); }
    Double2 normal(std::uint32_t side) const { return lanes::double2(sides_.normal_x[side], sides_.normal_y[side]); }
    double offset(std::uint32_t side) const { return sides_.offset[side]; }
    /// The magnitude of its numbers.
    double size() const { return std::abs(sides_.x[0]) + std::abs(sides_.y[0]) + 2 * sides_.size; }
    /// An upper bound of the distance of its points from the local origin.
    double radius() const { return size(); }
    /// The minimum of dot(direction, vertex).
    double lowest(Double2 direction) const {
        const Double2 x = lanes::first(direction), y = lanes::second(direction);
        Double2 lowest_dot = lanes::double2(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < sides_.count; i += 2)
            lowest_dot = lanes::lesser(x * lanes::at(sides_.x + i) + y * lanes::at(sides_.y + i), lowest_dot);
        return std::min(lowest_dot[0], lowest_dot[1]);
    }
    /// Whether no vertex lies farther in that direction: it is between the normals of the vertex's two edges.
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        const std::uint32_t last = (i == 0 ? sides_.count : i) - 1;
        return lanes::bits(turned(lanes::double2(sides_.normal_x[i], sides_.normal_x[last]),
                                  lanes::double2(sides_.normal_y[i], sides_.normal_y[last]), lanes::first(direction),
                                  lanes::second(direction)) <= Double2{0, 0}) == 3;
    }
    EdgeRegion voronoi_region(std::uint32_t side, Double2 point) const {
        const std::uint32_t end = after(side);
        const Double2 crosses = turned(lanes::double2(sides_.normal_x[side]), lanes::double2(sides_.normal_y[side]),
                                       lanes::first(point) - lanes::double2(sides_.x[end], sides_.x[side]),
                                       lanes::second(point) - lanes::double2(sides_.y[end], sides_.y[side]));
        return static_cast<EdgeRegion>(lanes::bits(crosses <= Double2{0, 0}) ^ 3);
    }
    /// The edge at a vertex whose normal is closest to a direction; of equals, the one after the vertex.
    std::uint32_t facing(std::uint32_t corner, Double2 direction) const {
        const std::uint32_t last = (corner == 0 ? sides_.count : corner) - 1;
        const Double2 alignments =
            lanes::double2(sides_.normal_x[corner], sides_.normal_x[last]) * lanes::first(direction) +
            lanes::double2(sides_.normal_y[corner], sides_.normal_y[last]) * lanes::second(direction);
        const std::uint32_t before = lanes::bits(alignments < lanes::swapped(alignments)) & 1;
        return corner ^ ((corner ^ last) & (0u - before));
    }
    /// The ends of an edge, one in each lane.
    Double2 ends_x(std::uint32_t side) const { return lanes::double2(sides_.x[side], sides_.x[after(side)]); }
    Double2 ends_y(std::uint32_t side) const { return lanes::double2(sides_.y[side], sides_.y[after(side)]); }
    /// The vertex's number in contact features.
    std::uint32_t contact_number(std::uint32_t i) const { return i; }
    bool has_area() const { return true; }
    /// About half the diagonal of the bounding box.
    double extent() const { return sides_.size; }
    const detail::PolygonSoa& sides() const { return sides_; }

private:
    /// Not positive: clockwise from the first normal, or along it; counter-clockwise from the second.
    static Double2 turned(Double2 normal_x, Double2 normal_y, Double2 x, Double2 y) {
        return (normal_x * y - normal_y * x) * Double2{1, -1};
    }

    detail::PolygonSoa sides_;
};

class BoxCore {
public:
    using Shape = Box2;
    explicit BoxCore(const Box2& box) : half_(lanes::loaded(&box.half.x)) {}

    std::uint32_t count() const { return 4; }
    std::uint32_t number(std::uint32_t i) const { return i ^ i >> 1; }
    std::uint32_t after(std::uint32_t i) const { return (i + 1) & 3; }
    std::uint32_t before(std::uint32_t i) const { return (i + 3) & 3; }
    Double2 corner(std::uint32_t i) const { return half_ * quadrant(i); }
    Double2 normal(std::uint32_t side) const {
        alignas(16) static constexpr double normals[8] = {0, 1, -1, 0, 0, -1, 1, 0};
        return lanes::at(normals + 2 * side);
    }
    double offset(std::uint32_t side) const { return half_[1 - (side & 1)]; }
    double size() const { return 3 * (half_[0] + half_[1]); }
    double radius() const { return half_[0] + half_[1]; }
    double lowest(Double2 direction) const {
        const Double2 reach = lanes::magnitude(direction) * half_;
        return -(reach[0] + reach[1]);
    }
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        return lanes::bits(direction * quadrant(i) >= Double2{0, 0}) == 3;
    }
    EdgeRegion voronoi_region(std::uint32_t side, Double2 point) const {
        const Double2 across = normal(side), along = lanes::swapped(across) * Double2{-1, 1};
        const double place = lanes::dot(along, point)[0], end = half_[side & 1];
        return static_cast<EdgeRegion>((place > end ? 1u : 0u) | (place < -end ? 2u : 0u));
    }
    std::uint32_t facing(std::uint32_t corner, Double2 direction) const {
        // The edges before the four vertices face along x and along y in turn.
        const Double2 alignments = direction * quadrant(corner);
        const std::uint32_t is_last = lanes::bits(alignments > lanes::swapped(alignments)) >> (corner & 1) & 1;
        return (corner + 3 * is_last) & 3;
    }
    Double2 ends_x(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, -1, -1, -1, -1, 1, 1, 1};
        return lanes::first(half_) * lanes::at(signs + 2 * side);
    }
    Double2 ends_y(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, 1, 1, -1, -1, -1, -1, 1};
        return lanes::second(half_) * lanes::at(signs + 2 * side);
    }
    std::uint32_t contact_number(std::uint32_t i) const { return (i + 2) & 3; }
    bool has_area() const { return lanes::bits(half_ > Double2{0, 0}) == 3; }
    double extent() const { return half_[0] + half_[1]; }
    detail::DVec<2> half() const { return {half_[0], half_[1]}; }
    Double2 half_lanes() const { return half_; }

private:
    static Double2 quadrant(std::uint32_t i) {
        alignas(16) static constexpr double quadrants[8] = {1, 1, -1, 1, -1, -1, 1, -1};
        return lanes::at(quadrants + 2 * i);
    }

    Double2 half_;
};

/// The placement of a shape by the numbers of its pose. A rotated vector has the length of these numbers until it is
/// scaled.
struct PolygonPlacement {
    Double2 position, turn;
    Double2 cos, sin;  ///< `sin` holds the sine and minus the sine
    Double2 scale;

    PolygonPlacement(const Polygon&, const Pose2* pose) : PolygonPlacement(detail::pose_or_none(pose)) {}
    explicit PolygonPlacement(const detail::Rigid2& place)
        : position(lanes::double2(place.x, place.y)), turn(lanes::double2(place.cos, place.sin)) {}
    PolygonPlacement(const Box2& box, const Pose2*)
        : position(lanes::loaded(&box.center.x)), turn(lanes::loaded(&box.rotation.cos)) {}

    void set_scale(Double2 inverse_length) {
        cos = lanes::first(turn);
        sin = lanes::second(turn) * Double2{1, -1};
        scale = inverse_length;
    }
    Double2 vector(Double2 v) const { return cos * v - sin * lanes::swapped(v); }
    Double2 back(Double2 v) const { return cos * v + sin * lanes::swapped(v); }

private:
    explicit PolygonPlacement(const Pose2& pose)
        : position(lanes::loaded(&pose.position.x)), turn(lanes::loaded(&pose.rotation.cos)) {}
};

inline bool set_scales(PolygonPlacement& a, PolygonPlacement& b) {
    const Double2 squares = lanes::squared_lengths(a.turn, b.turn);
    if (!lanes::are_near_one(squares)) return false;
    const Double2 scales = lanes::inverse_root(squares);
    a.set_scale(lanes::first(scales));
    b.set_scale(lanes::second(scales));
    return true;
}

template <class Core>
struct Placed {
    Core core;
    PolygonPlacement place;

    explicit Placed(const detail::ShapeRef<2>& given) : Placed(given.as<typename Core::Shape>(), given.pose) {}
    Placed(const typename Core::Shape& shape, const Pose2* pose) : core(shape), place(shape, pose) {}
    Placed(const Core& known, const detail::Rigid2& where) : core(known), place(where) {}
};

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline void name_vertex(std::uint32_t number, Feature& feature) {
    feature.index = number;
    feature.kind = FeatureKind::vertex;
}

template <class Core>
inline void name_edge(const Core& core, std::uint32_t side, Feature& feature) {
    feature.index = edge_index(core.number(side), core.number(core.after(side)));
    feature.kind = FeatureKind::edge;
}

/// An edge of one shape and a vertex of the other, both placed.
template <class Core>
struct EdgeVertexPair {
    Double2 offset, normal;  ///< of the vertex from its shape's position; of the edge, not yet normalised
    double gap;
    EdgeRegion region;

    EdgeVertexPair(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t side, std::uint32_t corner) {
        offset = other.place.vector(other.core.corner(corner)) * other.place.scale;
        const Double2 between = other.place.position - reference.place.position;
        const Double2 local_corner = reference.place.back(offset + between) * reference.place.scale;
        const Double2 own_normal = reference.core.normal(side);
        normal = reference.place.vector(own_normal);
        gap = lanes::dot(own_normal, local_corner)[0] - reference.core.offset(side);
        region = reference.core.voronoi_region(side, local_corner);
    }
};

/// The placement of each shape in the frame of the other.
template <class Core>
inline void set_relative_places(const Placed<Core>& a, const Placed<Core>& b, detail::Rigid2 (&relative_places)[2]) {
    const Double2 turn = a.place.back(b.place.turn) * (a.place.scale * b.place.scale);
    const Double2 between = b.place.position - a.place.position;
    const Double2 from_a = a.place.back(between) * a.place.scale, from_b = b.place.back(-between) * b.place.scale;
    relative_places[0].cos = relative_places[1].cos = turn[0];
    relative_places[0].sin = turn[1];
    relative_places[1].sin = -turn[1];
    relative_places[0].x = from_a[0];
    relative_places[0].y = from_a[1];
    relative_places[1].x = from_b[0];
    relative_places[1].y = from_b[1];
}

inline void find_widest_gap(const PolygonCore& a, const PolygonCore& b, const detail::Rigid2 (&relative_places)[2],
                            double tolerance, detail::EdgeGap& found) {
    widest_edge_gap(a.sides(), b.sides(), relative_places, infinity, tolerance, found);
}
inline void find_widest_gap(const BoxCore& a, const BoxCore& b, const detail::Rigid2 (&relative_places)[2],
                            double tolerance, detail::EdgeGap& found) {
    gap_of_boxes(a.half(), b.half(), relative_places, tolerance, found);
}

/// The edge with the widest gap, and the placement of each shape in the frame of the other. Returns false if a number
/// isn't finite.
template <class Core>
inline bool find_widest(const Placed<Core>& a, const Placed<Core>& b, detail::Rigid2 (&relative_places)[2],
                        detail::EdgeGap& widest) {
    set_relative_places(a, b, relative_places);
    const double size = std::abs(relative_places[0].x) + std::abs(relative_places[0].y) + a.core.size() + b.core.size();
    if (!(size < infinity)) return false;
    find_widest_gap(a.core, b.core, relative_places, 1e-14 * size, widest);
    return true;
}

/// Caches a separating edge. Overlapping polygons cache nothing, as all their edges are tested each time.
template <class Core>
inline void cache_edge(const Placed<Core>& reference, const Placed<Core>& other, const detail::EdgeGap& widest,
                       Cache& cache) {
    auto &of_reference = widest.of == 0 ? cache.corner_a : cache.corner_b,
         &of_other = widest.of == 0 ? cache.corner_b : cache.corner_a;
    cache.count = widest.gap > 0 ? 2 : 0;
    of_reference[0] = reference.core.number(widest.side);
    of_reference[1] = reference.core.number(reference.core.after(widest.side));
    of_other[0] = of_other[1] = other.core.number(widest.corner);
}

inline bool is_polygon(const detail::ShapeRef<2>& given) {
    return given.kind == detail::ShapeKind::polytope && given.as<Polygon>().sides() != nullptr;
}
inline bool is_box(const detail::ShapeRef<2>& given) {
    return given.kind == detail::ShapeKind::box && given.pose == nullptr;
}

}  // namespace abut::polygon_cores
