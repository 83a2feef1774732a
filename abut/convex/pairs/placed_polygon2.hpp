#pragma once

// A convex shape of the plane for queries of pairs: a core in its own frame, its pose, and the ball around it. The core
// is a box or a polygon of few edges. A segment is a box without height, and a point is a box without size, so that
// circles, capsules, segments and boxes have one closed form. For .cpp files.

#include <abut/convex/polygon_soa.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/simd/double2-inl.h>

namespace abut::detail {

using lanes::Double2;

/// A rotation, then a translation.
struct LanePose {
    Double2 position;
    Double2 cos, sin;  ///< `sin` holds the sine and minus the sine

    void set_turn(Double2 cosine_sine) {
        cos = lanes::first(cosine_sine);
        sin = lanes::second(cosine_sine) * Double2{1, -1};
    }
    Double2 turn() const { return lanes::lower(cos, sin); }
    Double2 vector(Double2 v) const { return cos * v - sin * lanes::swapped(v); }
    Double2 point(Double2 p) const { return position + vector(p); }
    /// The inverse rotation.
    Double2 back(Double2 v) const { return cos * v + sin * lanes::swapped(v); }
};

inline DVec<2> vector_of(Double2 v) {
    return {v[0], v[1]};
}
inline Rigid2 rigid(const LanePose& pose) {
    return {pose.cos[0], pose.sin[0], pose.position[0], pose.position[1]};
}

/// The cosine and sine of a turn, to be multiplied by `scale`, which normalises them like `unit(turn)`. Queries that
/// scale late don't wait for it.
struct ScaledTurn {
    Double2 turn, scale;

    [[gnu::always_inline]] explicit ScaledTurn(const Turn& given) : turn(lanes::loaded(&given.cos)) {
        const Double2 squares = lanes::dot(turn, turn);
        scale = lanes::inverse_root(squares);
        if (!lanes::is_near_one(squares[0])) *this = normalised(turn);
    }
    Double2 unit_turn() const { return turn * scale; }

private:
    ScaledTurn(Double2 unit, Double2 one) : turn(unit), scale(one) {}
    static ScaledTurn normalised(Double2 turn);
};

/// The cosine and sine of a turn, normalised like `unit(turn)`.
[[gnu::always_inline]] inline Double2 unit_turn(const Turn& turn) {
    return ScaledTurn(turn).unit_turn();
}
[[gnu::always_inline]] inline LanePose lane_pose(const Pose2& pose) {
    LanePose result;
    result.position = lanes::loaded(&pose.position.x);
    result.set_turn(unit_turn(pose.rotation));
    return result;
}

/// The numbers that a shape gives to its corners, four bits each.
struct CornerNames {
    std::uint64_t number;   ///< of each corner
    std::uint64_t corner;   ///< of each number
    std::uint64_t contact;  ///< of each corner, in the features of contact points
};
inline constexpr std::uint64_t in_order = 0xfedcba9876543210u;
inline constexpr CornerNames listed_names{in_order, in_order, in_order}, box_names{0x2310, 0x2310, 0x1032},
    segment_names{0x1001, 0x02, 0x1001}, reversed_names{0x120, 0x120, 0x120}, point_names{0, 0, 0};

inline std::uint32_t name_in(std::uint64_t names, std::uint32_t i) {
    return static_cast<std::uint32_t>(names >> 4 * i) & 15u;
}

/// It refers to the shape, or to its own storage. There are no initialisers, because every query makes two of these.
struct PlacedPolygon {
    enum class Core : std::uint8_t { point, box, polygon };

    LanePose place;
    double radius;
    Double2 half;      ///< of a box
    PolygonSoa sides;  ///< of a polygon
    const CornerNames* names;
    Core core;
    SoaStorage storage;

    PlacedPolygon() = default;
    PlacedPolygon(const PlacedPolygon&) = delete;
    PlacedPolygon& operator=(const PlacedPolygon&) = delete;

    bool is_point() const { return core == Core::point; }

    void set_point(Double2 point) {
        place.position = point;
        place.set_turn(Double2{1, 0});
        half = Double2{0, 0};
        names = &point_names;
        core = Core::point;
    }
    /// A segment around `middle` as long as `along`.
    void set_segment(Double2 middle, Double2 along) {
        const Double2 square = lanes::dot(along, along);
        if (!(square[0] > 0)) return set_point(middle);
        // The root and the quotient run in parallel. In double no square of a difference of floats overflows.
        const Double2 length = lanes::root(square), per_length = length * (Double2{1, 1} / square);
        place.position = middle;
        place.set_turn(along * per_length);
        half = length * Double2{0.5, 0};
        names = &segment_names;
        core = Core::box;
    }
    /// `place` is set apart.
    void set_box(Double2 half_extents) {
        half = half_extents;
        names = &box_names;
        core = Core::box;
    }
    /// `place` is set apart.
    void set_rows(const double* numbers, std::uint32_t count) {
        sides.view_rows(numbers, count);
        names = &listed_names;
        core = Core::polygon;
    }
    /// `place` is set apart. Returns false if the triangle is so thin that its area may be rounding.
    bool set_triangle(const Vec2& a, const Vec2& b, const Vec2& c);

    /// The core as rows: a box has four edges, a segment two, a point none. Its corners may have new numbers.
    void make_rows();
};

/// Writes the rows of a box, with edges of length 0 if it has no height.
void write_box_rows(Double2 half, SoaStorage& storage, PolygonSoa& sides);

/// Converts a placed core: a point, a segment, a box, a triangle of some area, or a polygon with `sides`. Returns false
/// for other cores, and for placements that scale, shear or mirror, or that have an inner ball.
bool set_placed_polygon(const Convex<2>& convex, PlacedPolygon& polygon);

}  // namespace abut::detail
