#pragma once

// Polygons of few sides and boxes of the plane, placed, as lanes of their own numbers: what is asked of two of one kind
// stays in registers. For .cpp files.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/pairs/edge_gaps2.hpp>
#include <abut/math/simd/double2-inl.h>
#include <abut/query/feature.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>

#include <limits>

namespace abut::placed_sides {

using lanes::Double2;

/// Where a point is along a side, by bits; where polygons can't tell, as of what is not a number, `nowhere`.
enum class Beside : std::uint32_t { within = 0, past_end = 1, before_start = 2, nowhere = 3 };

// Corners and sides of a shape in its own frame, counted as `PolygonSoa` does.

class PolygonCore {
public:
    using Shape = Polygon;
    explicit PolygonCore(const PolygonSoa& sides) : sides_(sides) {}
    explicit PolygonCore(const Polygon& polygon) { sides_.view_rows(polygon.sides(), polygon.side_count()); }

    std::uint32_t count() const { return sides_.count; }
    /// The number that the shape gives a corner; and back.
    std::uint32_t number(std::uint32_t i) const { return i; }
    std::uint32_t after(std::uint32_t i) const { return sides_.after(i); }
    std::uint32_t before(std::uint32_t i) const { return sides_.before(i); }
    Double2 corner(std::uint32_t i) const { return lanes::double2(sides_.x[i], sides_.y[i]); }
    Double2 normal(std::uint32_t side) const { return lanes::double2(sides_.normal_x[side], sides_.normal_y[side]); }
    double offset(std::uint32_t side) const { return sides_.offset[side]; }
    /// How large its numbers are.
    double size() const { return std::abs(sides_.x[0]) + std::abs(sides_.y[0]) + 2 * sides_.size; }
    /// At least how far it reaches from the origin of its own frame.
    double radius() const { return size(); }
    /// The least of dot(direction, corner).
    double lowest(Double2 direction) const {
        const Double2 x = lanes::first(direction), y = lanes::second(direction);
        Double2 least = lanes::double2(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < sides_.count; i += 2)
            least = lanes::lesser(x * lanes::at(sides_.x + i) + y * lanes::at(sides_.y + i), least);
        return std::min(least[0], least[1]);
    }
    /// Whether no corner lies farther in that direction: it is between the normals of the corner's two sides.
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        const std::uint32_t last = (i == 0 ? sides_.count : i) - 1;
        return lanes::bits(turned(lanes::double2(sides_.normal_x[i], sides_.normal_x[last]),
                                  lanes::double2(sides_.normal_y[i], sides_.normal_y[last]), lanes::first(direction),
                                  lanes::second(direction)) <= Double2{0, 0}) == 3;
    }
    Beside beside(std::uint32_t side, Double2 point) const {
        const std::uint32_t end = after(side);
        const Double2 crosses = turned(lanes::double2(sides_.normal_x[side]), lanes::double2(sides_.normal_y[side]),
                                       lanes::first(point) - lanes::double2(sides_.x[end], sides_.x[side]),
                                       lanes::second(point) - lanes::double2(sides_.y[end], sides_.y[side]));
        return static_cast<Beside>(lanes::bits(crosses <= Double2{0, 0}) ^ 3);
    }
    /// Of the two sides at a corner the one that looks most along a direction, the one after it of equals.
    std::uint32_t facing(std::uint32_t corner, Double2 direction) const {
        const std::uint32_t last = (corner == 0 ? sides_.count : corner) - 1;
        const Double2 looks = lanes::double2(sides_.normal_x[corner], sides_.normal_x[last]) * lanes::first(direction) +
                              lanes::double2(sides_.normal_y[corner], sides_.normal_y[last]) * lanes::second(direction);
        const std::uint32_t before = lanes::bits(looks < lanes::swapped(looks)) & 1;
        return corner ^ ((corner ^ last) & (0u - before));
    }
    /// The ends of a side, one in each lane.
    Double2 ends_x(std::uint32_t side) const { return lanes::double2(sides_.x[side], sides_.x[after(side)]); }
    Double2 ends_y(std::uint32_t side) const { return lanes::double2(sides_.y[side], sides_.y[after(side)]); }
    /// What contacts call a corner.
    std::uint32_t contact_number(std::uint32_t i) const { return i; }
    bool has_area() const { return true; }
    /// About half the diagonal of the box around it.
    double extent() const { return sides_.size; }
    const PolygonSoa& sides() const { return sides_; }

private:
    /// Not above zero: clockwise from the first, or along it; counter-clockwise from the second.
    static Double2 turned(Double2 normal_x, Double2 normal_y, Double2 x, Double2 y) {
        return (normal_x * y - normal_y * x) * Double2{1, -1};
    }

    PolygonSoa sides_;
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
    Beside beside(std::uint32_t side, Double2 point) const {
        const Double2 across = normal(side), along = lanes::swapped(across) * Double2{-1, 1};
        const double place = lanes::dot(along, point)[0], end = half_[side & 1];
        return static_cast<Beside>((place > end ? 1u : 0u) | (place < -end ? 2u : 0u));
    }
    std::uint32_t facing(std::uint32_t corner, Double2 direction) const {
        // By turns, the side before a corner looks along x or along y.
        const Double2 looks = direction * quadrant(corner);
        const std::uint32_t is_last = lanes::bits(looks > lanes::swapped(looks)) >> (corner & 1) & 1;
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
    DVec<2> half() const { return {half_[0], half_[1]}; }
    Double2 half_lanes() const { return half_; }

private:
    static Double2 quadrant(std::uint32_t i) {
        alignas(16) static constexpr double quadrants[8] = {1, 1, -1, 1, -1, -1, 1, -1};
        return lanes::at(quadrants + 2 * i);
    }

    Double2 half_;
};

/// How a shape is placed, by the numbers of its pose: a turned vector is as long as they are until it is scaled.
struct Placing {
    Double2 position, turn;
    Double2 cos, sin;  ///< sine and minus sine
    Double2 scale;

    Placing(const Polygon&, const Pose2* pose) : Placing(pose_or_none(pose)) {}
    explicit Placing(const Rigid2& place)
        : position(lanes::double2(place.x, place.y)), turn(lanes::double2(place.cos, place.sin)) {}
    Placing(const Box2& box, const Pose2*)
        : position(lanes::loaded(&box.center.x)), turn(lanes::loaded(&box.rotation.cos)) {}

    void set_scale(Double2 inverse_length) {
        cos = lanes::first(turn);
        sin = lanes::second(turn) * Double2{1, -1};
        scale = inverse_length;
    }
    Double2 vector(Double2 v) const { return cos * v - sin * lanes::swapped(v); }
    Double2 back(Double2 v) const { return cos * v + sin * lanes::swapped(v); }

private:
    explicit Placing(const Pose2& pose)
        : position(lanes::loaded(&pose.position.x)), turn(lanes::loaded(&pose.rotation.cos)) {}
};

inline bool set_scales(Placing& a, Placing& b) {
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
    Placing place;

    explicit Placed(const ShapeRef<2>& given) : Placed(given.as<typename Core::Shape>(), given.pose) {}
    Placed(const typename Core::Shape& shape, const Pose2* pose) : core(shape), place(shape, pose) {}
    Placed(const Core& known, const Rigid2& where) : core(known), place(where) {}
};

inline constexpr double without_end = std::numeric_limits<double>::infinity();

inline void name_corner(std::uint32_t number, Feature& feature) {
    feature.index = number;
    feature.kind = FeatureKind::vertex;
}

template <class Core>
inline void name_side(const Core& core, std::uint32_t side, Feature& feature) {
    feature.index = edge_index(core.number(side), core.number(core.after(side)));
    feature.kind = FeatureKind::edge;
}

/// A side of one and a corner of the other, both where they were placed.
template <class Core>
struct SideAndCorner {
    Double2 arm, normal;  ///< of the corner, from where it is placed; of the side, not yet scaled
    double gap;
    Beside beside;

    SideAndCorner(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t side, std::uint32_t corner) {
        arm = other.place.vector(other.core.corner(corner)) * other.place.scale;
        const Double2 offset = other.place.position - reference.place.position;
        const Double2 seen = reference.place.back(arm + offset) * reference.place.scale;
        const Double2 own_normal = reference.core.normal(side);
        normal = reference.place.vector(own_normal);
        gap = lanes::dot(own_normal, seen)[0] - reference.core.offset(side);
        beside = reference.core.beside(side, seen);
    }
};

/// How each sees the other.
template <class Core>
inline void set_seen(const Placed<Core>& a, const Placed<Core>& b, Rigid2 (&seen)[2]) {
    const Double2 turn = a.place.back(b.place.turn) * (a.place.scale * b.place.scale);
    const Double2 between = b.place.position - a.place.position;
    const Double2 from_a = a.place.back(between) * a.place.scale, from_b = b.place.back(-between) * b.place.scale;
    seen[0].cos = seen[1].cos = turn[0];
    seen[0].sin = turn[1];
    seen[1].sin = -turn[1];
    seen[0].x = from_a[0];
    seen[0].y = from_a[1];
    seen[1].x = from_b[0];
    seen[1].y = from_b[1];
}

inline void find_widest_gap(const PolygonCore& a, const PolygonCore& b, const Rigid2 (&seen)[2], double doubt,
                            EdgeGap& found) {
    widest_edge_gap(a.sides(), b.sides(), seen, without_end, doubt, found);
}
inline void find_widest_gap(const BoxCore& a, const BoxCore& b, const Rigid2 (&seen)[2], double doubt, EdgeGap& found) {
    gap_of_boxes(a.half(), b.half(), seen, doubt, found);
}

/// Of all sides the one that parts them most, and how each sees the other. False where a number isn't finite.
template <class Core>
inline bool find_widest(const Placed<Core>& a, const Placed<Core>& b, Rigid2 (&seen)[2], EdgeGap& widest) {
    set_seen(a, b, seen);
    const double size = std::abs(seen[0].x) + std::abs(seen[0].y) + a.core.size() + b.core.size();
    if (!(size < without_end)) return false;
    find_widest_gap(a.core, b.core, seen, 1e-14 * size, widest);
    return true;
}

/// Of sides that part them; the sides of what overlaps are all tried each time.
template <class Core>
inline void remember_side(const Placed<Core>& reference, const Placed<Core>& other, const EdgeGap& widest,
                          Cache& cache) {
    auto &of_reference = widest.of == 0 ? cache.corner_a : cache.corner_b,
         &of_other = widest.of == 0 ? cache.corner_b : cache.corner_a;
    cache.count = widest.gap > 0 ? 2 : 0;
    of_reference[0] = reference.core.number(widest.side);
    of_reference[1] = reference.core.number(reference.core.after(widest.side));
    of_other[0] = of_other[1] = other.core.number(widest.corner);
}

inline bool is_polygon(const ShapeRef<2>& given) {
    return given.kind == ShapeKind::polytope && given.as<Polygon>().sides() != nullptr;
}
inline bool is_box(const ShapeRef<2>& given) {
    return given.kind == ShapeKind::box && given.pose == nullptr;
}

}  // namespace abut::placed_sides
