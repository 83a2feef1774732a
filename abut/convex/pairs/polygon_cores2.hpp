#pragma once

// The corners and edges of placed polygons and boxes, in SIMD lanes, and their poses and radii. For .cpp files.

#include <abut/convex/pairs/placed_polygon2.hpp>

#include <limits>

namespace abut::detail {

/// The Voronoi region of an edge that a point is in, by bits; `nowhere` for NaN.
enum class EdgeRegion : std::uint32_t { within = 0, past_end = 1, before_start = 2, nowhere = 3 };

/// The edge beside a corner whose normal is nearest to a direction, and the cosine between them.
struct FacingEdge {
    std::uint32_t side;
    double alignment;
};

// The vertices and edges of a core, numbered as in `PolygonSoa`.

class PolygonCore {
public:
    explicit PolygonCore(const PlacedPolygon& polygon) : polygon_(&polygon) {
        // Member by member: reading a structure as a whole right after its parts were written stalls.
        sides_.numbers = polygon.sides.numbers;
        sides_.count = polygon.sides.count;
    }

    const LanePose& place() const { return polygon_->place; }
    double radius() const { return polygon_->radius; }
    const PolygonSoa& sides() const { return sides_; }
    std::uint32_t count() const { return sides().count; }
    /// The shape's own number of a corner, and the corner of a number.
    std::uint32_t number(std::uint32_t i) const { return name_in(polygon_->names->number, i); }
    std::uint32_t corner_of(std::uint32_t number) const { return name_in(polygon_->names->corner, number); }
    /// The number of a corner in contact features.
    std::uint32_t contact_number(std::uint32_t i) const { return name_in(polygon_->names->contact, i); }
    std::uint32_t after(std::uint32_t i) const { return sides().after(i); }
    std::uint32_t before(std::uint32_t i) const { return sides().before(i); }
    Double2 corner(std::uint32_t i) const { return lanes::double2(sides().x(i), sides().y(i)); }
    Double2 normal(std::uint32_t side) const { return lanes::double2(sides().normal_x(side), sides().normal_y(side)); }
    double offset(std::uint32_t side) const { return sides().offset(side); }
    /// The magnitude of its numbers.
    double size() const { return std::abs(sides().x(0)) + std::abs(sides().y(0)) + 2 * sides().size(); }
    /// An upper bound of the distance of its points from its origin.
    double outer_radius() const { return size(); }
    /// About half the diagonal of the bounding box.
    double extent() const { return sides().size(); }
    /// The minimum of dot(direction, vertex).
    double lowest(Double2 direction) const {
        const Double2 x = lanes::first(direction), y = lanes::second(direction);
        Double2 lowest_dot = lanes::double2(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < sides().count; i += 2)
            lowest_dot =
                lanes::lesser(x * lanes::at(sides().at(i)) + y * lanes::at(sides().at(i) + soa_lanes), lowest_dot);
        return std::min(lowest_dot[0], lowest_dot[1]);
    }
    /// Whether no vertex lies farther in that direction: it is between the normals of the vertex's two edges.
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        const std::uint32_t last = before(i);
        return sides().count == 1 ||
               lanes::bits(turned(lanes::double2(sides().normal_x(i), sides().normal_x(last)),
                                  lanes::double2(sides().normal_y(i), sides().normal_y(last)), lanes::first(direction),
                                  lanes::second(direction)) <= Double2{0, 0}) == 3;
    }
    EdgeRegion voronoi_region(std::uint32_t side, Double2 point) const {
        const std::uint32_t end = after(side);
        const Double2 crosses = turned(lanes::double2(sides().normal_x(side)), lanes::double2(sides().normal_y(side)),
                                       lanes::first(point) - lanes::double2(sides().x(end), sides().x(side)),
                                       lanes::second(point) - lanes::double2(sides().y(end), sides().y(side)));
        return static_cast<EdgeRegion>(lanes::bits(crosses <= Double2{0, 0}) ^ 3);
    }
    /// Of two equals, the edge after the corner.
    FacingEdge facing(std::uint32_t corner, Double2 direction) const {
        const std::uint32_t last = before(corner);
        const Double2 alignments =
            lanes::double2(sides().normal_x(corner), sides().normal_x(last)) * lanes::first(direction) +
            lanes::double2(sides().normal_y(corner), sides().normal_y(last)) * lanes::second(direction);
        const Double2 best = lanes::greater(alignments, lanes::swapped(alignments));
        return {corner ^ ((corner ^ last) & (0u - (lanes::bits(alignments < best) & 1))), best[0]};
    }
    /// Whether an edge has a length.
    bool is_proper(std::uint32_t) const { return true; }
    /// The ends of an edge, one in each lane.
    Double2 ends_x(std::uint32_t side) const { return lanes::double2(sides().x(side), sides().x(after(side))); }
    Double2 ends_y(std::uint32_t side) const { return lanes::double2(sides().y(side), sides().y(after(side))); }

private:
    /// Not positive: clockwise from the first normal, or along it; counter-clockwise from the second.
    static Double2 turned(Double2 normal_x, Double2 normal_y, Double2 x, Double2 y) {
        return (normal_x * y - normal_y * x) * Double2{1, -1};
    }

    const PlacedPolygon* polygon_;
    PolygonSoa sides_;
};

/// A polygon whose corners have the numbers of its rows.
class ListedCore : public PolygonCore {
public:
    using PolygonCore::PolygonCore;

    std::uint32_t number(std::uint32_t i) const { return i; }
};

/// A point, for queries with another point.
class PointCore {
public:
    explicit PointCore(const PlacedPolygon& point) : point_(&point) {}

    const LanePose& place() const { return point_->place; }
    double radius() const { return point_->radius; }
    std::uint32_t number(std::uint32_t) const { return 0; }
    Double2 corner(std::uint32_t) const { return Double2{0, 0}; }

private:
    const PlacedPolygon* point_;
};

/// A box, a segment or a point.
class BoxCore {
public:
    explicit BoxCore(const PlacedPolygon& box) : box_(&box), half_(box.half) {}

    const LanePose& place() const { return box_->place; }
    double radius() const { return box_->radius; }
    Double2 half() const { return half_; }

    std::uint32_t count() const { return 4; }
    std::uint32_t number(std::uint32_t i) const { return name_in(box_->names->number, i); }
    std::uint32_t corner_of(std::uint32_t number) const { return name_in(box_->names->corner, number); }
    std::uint32_t contact_number(std::uint32_t i) const { return name_in(box_->names->contact, i); }
    std::uint32_t after(std::uint32_t i) const { return (i + 1) & 3; }
    std::uint32_t before(std::uint32_t i) const { return (i + 3) & 3; }
    Double2 corner(std::uint32_t i) const { return half() * quadrant(i); }
    Double2 normal(std::uint32_t side) const {
        alignas(16) static constexpr double normals[8] = {0, 1, -1, 0, 0, -1, 1, 0};
        return lanes::at(normals + 2 * side);
    }
    double offset(std::uint32_t side) const { return half()[1 - (side & 1)]; }
    double size() const { return 3 * extent(); }
    double outer_radius() const { return extent(); }
    double extent() const { return half()[0] + half()[1]; }
    double lowest(Double2 direction) const {
        const Double2 reach = lanes::magnitude(direction) * half();
        return -(reach[0] + reach[1]);
    }
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        return lanes::bits(direction * corner(i) >= Double2{0, 0}) == 3;
    }
    EdgeRegion voronoi_region(std::uint32_t side, Double2 point) const {
        const Double2 across = normal(side), along = lanes::swapped(across) * Double2{-1, 1};
        const double place = lanes::dot(along, point)[0], end = half()[side & 1];
        return static_cast<EdgeRegion>((place > end ? 1u : 0u) | (place < -end ? 2u : 0u));
    }
    /// An edge of length 0 faces nothing. Of two equals, the edge after the corner.
    FacingEdge facing(std::uint32_t corner, Double2 direction) const {
        // The sides left and right are as long as the box is high. A segment has all its corners on both sides.
        const lanes::Mask2 proper = lanes::swapped(half()) > Double2{0, 0}, thick = half() > Double2{0, 0};
        const Double2 out = lanes::select(thick, direction * quadrant(corner), lanes::magnitude(direction));
        const Double2 alignments = lanes::select(proper, out, Double2{-1, -1});
        const bool along_x = (corner & 1) != 0 ? alignments[0] >= alignments[1] : alignments[0] > alignments[1];
        const std::uint32_t low = lanes::bits(thick) >> (along_x ? 0 : 1) & 1
                                      ? lanes::signs(quadrant(corner)) >> (along_x ? 0 : 1) & 1
                                      : lanes::signs(direction) >> (along_x ? 0 : 1) & 1;
        static constexpr std::uint32_t sides[4] = {0, 2, 3, 1};
        return {sides[(along_x ? 2u : 0u) | low], alignments[along_x ? 0 : 1]};
    }
    bool is_proper(std::uint32_t side) const { return half()[side & 1] > 0; }
    Double2 ends_x(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, -1, -1, -1, -1, 1, 1, 1};
        return lanes::first(half()) * lanes::at(signs + 2 * side);
    }
    Double2 ends_y(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, 1, 1, -1, -1, -1, -1, 1};
        return lanes::second(half()) * lanes::at(signs + 2 * side);
    }

private:
    static Double2 quadrant(std::uint32_t i) {
        alignas(16) static constexpr double quadrants[8] = {1, 1, -1, 1, -1, -1, 1, -1};
        return lanes::at(quadrants + 2 * i);
    }

    const PlacedPolygon* box_;
    Double2 half_;
};

}  // namespace abut::detail
