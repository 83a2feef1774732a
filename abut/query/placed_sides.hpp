#pragma once

// Polygons of few sides and boxes of the plane, placed, as lanes of their own numbers: what is asked of two of one kind
// stays in registers. For .cpp files.

#include <abut/convex/cache.hpp>
#include <abut/convex/side_gaps.hpp>
#include <abut/math/lanes-inl.h>
#include <abut/query/feature.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>

#include <limits>

namespace abut::placed_sides {

using lanes::Both;

/// Where a point is along a side, by bits; where polygons can't tell, as of what is not a number, `nowhere`.
enum class Beside : std::uint32_t { within = 0, past_end = 1, before_start = 2, nowhere = 3 };

// Corners and sides of a shape in its own frame, counted as `Sides` does.

class PolygonCore {
public:
    using Shape = Polygon;
    explicit PolygonCore(const Sides& sides) : sides_(sides) {}
    explicit PolygonCore(const Polygon& polygon) { sides_.refer_to(polygon.sides(), polygon.side_count()); }

    std::uint32_t count() const { return sides_.count; }
    /// The number that the shape gives a corner; and back.
    std::uint32_t number(std::uint32_t i) const { return i; }
    std::uint32_t after(std::uint32_t i) const { return sides_.after(i); }
    std::uint32_t before(std::uint32_t i) const { return sides_.before(i); }
    Both corner(std::uint32_t i) const { return lanes::both(sides_.x[i], sides_.y[i]); }
    Both normal(std::uint32_t side) const { return lanes::both(sides_.normal_x[side], sides_.normal_y[side]); }
    double offset(std::uint32_t side) const { return sides_.offset[side]; }
    /// How large its numbers are.
    double size() const { return std::abs(sides_.x[0]) + std::abs(sides_.y[0]) + 2 * sides_.size; }
    /// At least how far it reaches from the origin of its own frame.
    double radius() const { return size(); }
    /// The least of dot(direction, corner).
    double lowest(Both direction) const {
        const Both x = lanes::first(direction), y = lanes::second(direction);
        Both least = lanes::both(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < sides_.count; i += 2)
            least = lanes::lesser(x * lanes::at(sides_.x + i) + y * lanes::at(sides_.y + i), least);
        return std::min(least[0], least[1]);
    }
    /// Whether no corner lies farther in that direction: it is between the normals of the corner's two sides.
    bool is_farthest(std::uint32_t i, Both direction) const {
        const std::uint32_t last = (i == 0 ? sides_.count : i) - 1;
        return lanes::bits(turned(lanes::both(sides_.normal_x[i], sides_.normal_x[last]),
                                  lanes::both(sides_.normal_y[i], sides_.normal_y[last]), lanes::first(direction),
                                  lanes::second(direction)) <= Both{0, 0}) == 3;
    }
    Beside beside(std::uint32_t side, Both point) const {
        const std::uint32_t end = after(side);
        const Both crosses = turned(lanes::both(sides_.normal_x[side]), lanes::both(sides_.normal_y[side]),
                                    lanes::first(point) - lanes::both(sides_.x[end], sides_.x[side]),
                                    lanes::second(point) - lanes::both(sides_.y[end], sides_.y[side]));
        return static_cast<Beside>(lanes::bits(crosses <= Both{0, 0}) ^ 3);
    }
    /// Of the two sides at a corner the one that looks most along a direction, the one after it of equals.
    std::uint32_t facing(std::uint32_t corner, Both direction) const {
        const std::uint32_t last = (corner == 0 ? sides_.count : corner) - 1;
        const Both looks = lanes::both(sides_.normal_x[corner], sides_.normal_x[last]) * lanes::first(direction) +
                           lanes::both(sides_.normal_y[corner], sides_.normal_y[last]) * lanes::second(direction);
        const std::uint32_t before = lanes::bits(looks < lanes::swapped(looks)) & 1;
        return corner ^ ((corner ^ last) & (0u - before));
    }
    /// The ends of a side, one in each lane.
    Both ends_x(std::uint32_t side) const { return lanes::both(sides_.x[side], sides_.x[after(side)]); }
    Both ends_y(std::uint32_t side) const { return lanes::both(sides_.y[side], sides_.y[after(side)]); }
    /// What contacts call a corner.
    std::uint32_t contact_number(std::uint32_t i) const { return i; }
    bool has_area() const { return true; }
    /// About half the diagonal of the box around it.
    double extent() const { return sides_.size; }
    const Sides& sides() const { return sides_; }

private:
    /// Not above zero: clockwise from the first, or along it; counter-clockwise from the second.
    static Both turned(Both normal_x, Both normal_y, Both x, Both y) {
        return (normal_x * y - normal_y * x) * Both{1, -1};
    }

    Sides sides_;
};

class BoxCore {
public:
    using Shape = Box2;
    explicit BoxCore(const Box2& box) : half_(lanes::loaded(&box.half.x)) {}

    std::uint32_t count() const { return 4; }
    std::uint32_t number(std::uint32_t i) const { return i ^ i >> 1; }
    std::uint32_t after(std::uint32_t i) const { return (i + 1) & 3; }
    std::uint32_t before(std::uint32_t i) const { return (i + 3) & 3; }
    Both corner(std::uint32_t i) const { return half_ * quadrant(i); }
    Both normal(std::uint32_t side) const {
        alignas(16) static constexpr double normals[8] = {0, 1, -1, 0, 0, -1, 1, 0};
        return lanes::at(normals + 2 * side);
    }
    double offset(std::uint32_t side) const { return half_[1 - (side & 1)]; }
    double size() const { return 3 * (half_[0] + half_[1]); }
    double radius() const { return half_[0] + half_[1]; }
    double lowest(Both direction) const {
        const Both reach = lanes::magnitude(direction) * half_;
        return -(reach[0] + reach[1]);
    }
    bool is_farthest(std::uint32_t i, Both direction) const {
        return lanes::bits(direction * quadrant(i) >= Both{0, 0}) == 3;
    }
    Beside beside(std::uint32_t side, Both point) const {
        const Both across = normal(side), along = lanes::swapped(across) * Both{-1, 1};
        const double place = lanes::dot(along, point)[0], end = half_[side & 1];
        return static_cast<Beside>((place > end ? 1u : 0u) | (place < -end ? 2u : 0u));
    }
    std::uint32_t facing(std::uint32_t corner, Both direction) const {
        // By turns, the side before a corner looks along x or along y.
        const Both looks = direction * quadrant(corner);
        const std::uint32_t is_last = lanes::bits(looks > lanes::swapped(looks)) >> (corner & 1) & 1;
        return (corner + 3 * is_last) & 3;
    }
    Both ends_x(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, -1, -1, -1, -1, 1, 1, 1};
        return lanes::first(half_) * lanes::at(signs + 2 * side);
    }
    Both ends_y(std::uint32_t side) const {
        alignas(16) static constexpr double signs[8] = {1, 1, 1, -1, -1, -1, -1, 1};
        return lanes::second(half_) * lanes::at(signs + 2 * side);
    }
    std::uint32_t contact_number(std::uint32_t i) const { return (i + 2) & 3; }
    bool has_area() const { return lanes::bits(half_ > Both{0, 0}) == 3; }
    double extent() const { return half_[0] + half_[1]; }
    DVec<2> half() const { return {half_[0], half_[1]}; }
    Both half_lanes() const { return half_; }

private:
    static Both quadrant(std::uint32_t i) {
        alignas(16) static constexpr double quadrants[8] = {1, 1, -1, 1, -1, -1, 1, -1};
        return lanes::at(quadrants + 2 * i);
    }

    Both half_;
};

/// How a shape is placed, by the numbers of its pose: a turned vector is as long as they are until it is scaled.
struct Placing {
    Both position, turn;
    Both cos, sin;  ///< sine and minus sine
    Both scale;

    Placing(const Polygon&, const Pose2* pose) : Placing(pose_or_none(pose)) {}
    explicit Placing(const Rigid2& place)
        : position(lanes::both(place.x, place.y)), turn(lanes::both(place.cos, place.sin)) {}
    Placing(const Box2& box, const Pose2*)
        : position(lanes::loaded(&box.center.x)), turn(lanes::loaded(&box.rotation.cos)) {}

    void set_scale(Both inverse_length) {
        cos = lanes::first(turn);
        sin = lanes::second(turn) * Both{1, -1};
        scale = inverse_length;
    }
    Both vector(Both v) const { return cos * v - sin * lanes::swapped(v); }
    Both back(Both v) const { return cos * v + sin * lanes::swapped(v); }

private:
    explicit Placing(const Pose2& pose)
        : position(lanes::loaded(&pose.position.x)), turn(lanes::loaded(&pose.rotation.cos)) {}
};

inline bool set_scales(Placing& a, Placing& b) {
    const Both squares = lanes::squared_lengths(a.turn, b.turn);
    if (!lanes::are_near_one(squares)) return false;
    const Both scales = lanes::inverse_root(squares);
    a.set_scale(lanes::first(scales));
    b.set_scale(lanes::second(scales));
    return true;
}

template <class Core>
struct Placed {
    Core core;
    Placing place;

    explicit Placed(const Given<2>& given) : Placed(given.as<typename Core::Shape>(), given.pose) {}
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
    Both arm, normal;  ///< of the corner, from where it is placed; of the side, not yet scaled
    double gap;
    Beside beside;

    SideAndCorner(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t side, std::uint32_t corner) {
        arm = other.place.vector(other.core.corner(corner)) * other.place.scale;
        const Both offset = other.place.position - reference.place.position;
        const Both seen = reference.place.back(arm + offset) * reference.place.scale;
        const Both own_normal = reference.core.normal(side);
        normal = reference.place.vector(own_normal);
        gap = lanes::dot(own_normal, seen)[0] - reference.core.offset(side);
        beside = reference.core.beside(side, seen);
    }
};

/// How each sees the other.
template <class Core>
inline void set_seen(const Placed<Core>& a, const Placed<Core>& b, Rigid2 (&seen)[2]) {
    const Both turn = a.place.back(b.place.turn) * (a.place.scale * b.place.scale);
    const Both between = b.place.position - a.place.position;
    const Both from_a = a.place.back(between) * a.place.scale, from_b = b.place.back(-between) * b.place.scale;
    seen[0].cos = seen[1].cos = turn[0];
    seen[0].sin = turn[1];
    seen[1].sin = -turn[1];
    seen[0].x = from_a[0];
    seen[0].y = from_a[1];
    seen[1].x = from_b[0];
    seen[1].y = from_b[1];
}

inline void find_widest_gap(const PolygonCore& a, const PolygonCore& b, const Rigid2 (&seen)[2], double doubt,
                            SideGap& found) {
    widest_gap(a.sides(), b.sides(), seen, without_end, doubt, found);
}
inline void find_widest_gap(const BoxCore& a, const BoxCore& b, const Rigid2 (&seen)[2], double doubt, SideGap& found) {
    gap_of_boxes(a.half(), b.half(), seen, doubt, found);
}

/// Of all sides the one that parts them most, and how each sees the other. False where a number isn't finite.
template <class Core>
inline bool find_widest(const Placed<Core>& a, const Placed<Core>& b, Rigid2 (&seen)[2], SideGap& widest) {
    set_seen(a, b, seen);
    const double size = std::abs(seen[0].x) + std::abs(seen[0].y) + a.core.size() + b.core.size();
    if (!(size < without_end)) return false;
    find_widest_gap(a.core, b.core, seen, 1e-14 * size, widest);
    return true;
}

/// Of sides that part them; the sides of what overlaps are all tried each time.
template <class Core>
inline void remember_side(const Placed<Core>& reference, const Placed<Core>& other, const SideGap& widest,
                          Cache& cache) {
    auto &of_reference = widest.of == 0 ? cache.corner_a : cache.corner_b,
         &of_other = widest.of == 0 ? cache.corner_b : cache.corner_a;
    cache.count = widest.gap > 0 ? 2 : 0;
    of_reference[0] = reference.core.number(widest.side);
    of_reference[1] = reference.core.number(reference.core.after(widest.side));
    of_other[0] = of_other[1] = other.core.number(widest.corner);
}

inline bool is_polygon(const Given<2>& given) {
    return given.kind == ShapeKind::polytope && given.as<Polygon>().sides() != nullptr;
}
inline bool is_box(const Given<2>& given) {
    return given.kind == ShapeKind::box && given.pose == nullptr;
}

}  // namespace abut::placed_sides
