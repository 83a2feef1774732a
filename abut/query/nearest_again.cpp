#include <abut/convex/feature.hpp>
#include <abut/convex/sides.hpp>
#include <abut/math/lanes-inl.h>
#include <abut/query/nearest_again.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>

namespace abut {
namespace {

using lanes::Both;

// Corners and sides of a shape in its own frame, counted as `Sides` does.

class PolygonCore {
public:
    using Shape = Polygon;
    explicit PolygonCore(const Polygon& polygon) { sides_.refer_to(polygon.sides(), polygon.side_count()); }

    std::uint32_t count() const { return sides_.count; }
    /// The number that the shape gives a corner; and back.
    std::uint32_t number(std::uint32_t i) const { return i; }
    std::uint32_t after(std::uint32_t i) const { return sides_.after(i); }
    Both corner(std::uint32_t i) const { return lanes::both(sides_.x[i], sides_.y[i]); }
    Both normal(std::uint32_t side) const { return lanes::both(sides_.normal_x[side], sides_.normal_y[side]); }
    double offset(std::uint32_t side) const { return sides_.offset[side]; }
    /// Whether no corner lies farther in that direction: it is between the normals of the corner's two sides.
    bool is_farthest(std::uint32_t i, Both direction) const {
        const std::uint32_t last = (i == 0 ? sides_.count : i) - 1;
        return between(lanes::both(sides_.normal_x[i], sides_.normal_x[last]),
                       lanes::both(sides_.normal_y[i], sides_.normal_y[last]), lanes::first(direction),
                       lanes::second(direction));
    }
    /// Whether a point is before or behind a side, and past neither end.
    bool faces(std::uint32_t side, Both point) const {
        const std::uint32_t end = after(side);
        return between(lanes::both(sides_.normal_x[side]), lanes::both(sides_.normal_y[side]),
                       lanes::first(point) - lanes::both(sides_.x[end], sides_.x[side]),
                       lanes::second(point) - lanes::both(sides_.y[end], sides_.y[side]));
    }

private:
    /// Clockwise from the first or along it, and counter-clockwise from the second.
    static bool between(Both normal_x, Both normal_y, Both x, Both y) {
        return lanes::bits((normal_x * y - normal_y * x) * Both{1, -1} <= Both{0, 0}) == 3;
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
    Both corner(std::uint32_t i) const { return half_ * quadrant(i); }
    Both normal(std::uint32_t side) const {
        alignas(16) static constexpr double normals[8] = {0, 1, -1, 0, 0, -1, 1, 0};
        return lanes::at(normals + 2 * side);
    }
    double offset(std::uint32_t side) const { return half_[1 - (side & 1)]; }
    bool is_farthest(std::uint32_t i, Both direction) const {
        return lanes::bits(direction * quadrant(i) >= Both{0, 0}) == 3;
    }
    bool faces(std::uint32_t side, Both point) const {
        return (lanes::bits(lanes::magnitude(point) <= half_) >> (side & 1) & 1) != 0;
    }

private:
    static Both quadrant(std::uint32_t i) {
        alignas(16) static constexpr double quadrants[8] = {1, 1, -1, 1, -1, -1, 1, -1};
        return lanes::at(quadrants + 2 * i);
    }

    Both half_;
};

constexpr Pose2 nowhere;

/// How a shape is placed, by the numbers of its pose: a turned vector is as long as they are until it is scaled.
struct Placing {
    Both position, turn;
    Both cos, sin;  ///< sine and minus sine
    Both scale;

    Placing(const Polygon&, const Pose2* pose) : Placing(pose != nullptr ? *pose : nowhere) {}
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

template <class Core>
struct Placed {
    Core core;
    Placing place;

    explicit Placed(const Given<2>& given) : Placed(given.as<typename Core::Shape>(), given.pose) {}
    Placed(const typename Core::Shape& shape, const Pose2* pose) : core(shape), place(shape, pose) {}
};

inline void name_corner(std::uint32_t number, Feature& feature) {
    feature.index = number;
    feature.kind = FeatureKind::vertex;
}

/// The corner of one before the side of the other.
template <class Reference, class Other>
inline bool side_again(const Placed<Reference>& reference, const Placed<Other>& other, std::uint32_t side_number,
                       std::uint32_t corner_number, bool reference_is_a, Closest<2>& result) {
    if (side_number >= reference.core.count() || corner_number >= other.core.count()) return false;
    const std::uint32_t side = reference.core.number(side_number), corner = other.core.number(corner_number);
    const Both arm = other.place.vector(other.core.corner(corner)) * other.place.scale;
    const Both offset = other.place.position - reference.place.position;
    const Both seen = reference.place.back(arm + offset) * reference.place.scale;
    const Both normal = reference.core.normal(side), turned = reference.place.vector(normal);
    const double gap = lanes::dot(normal, seen)[0] - reference.core.offset(side);
    if (!(gap > 0 && gap < std::numeric_limits<double>::infinity() && reference.core.faces(side, seen) &&
          other.core.is_farthest(corner, -other.place.back(turned))))
        return false;
    const Both out = turned * reference.place.scale, on_other = other.place.position + arm;
    static constexpr double towards_b[2] = {-1, 1};
    result.distance = static_cast<float>(gap);
    lanes::store(out * lanes::both(towards_b[reference_is_a ? 1 : 0]), &result.normal.x);
    lanes::store(on_other - out * lanes::both(gap), reference_is_a ? &result.on_a.x : &result.on_b.x);
    lanes::store(on_other, reference_is_a ? &result.on_b.x : &result.on_a.x);
    Feature& of_reference = reference_is_a ? result.feature_a : result.feature_b;
    of_reference.index = edge_index(side_number, reference.core.number(reference.core.after(side)));
    of_reference.kind = FeatureKind::edge;
    name_corner(corner_number, reference_is_a ? result.feature_b : result.feature_a);
    return true;
}

/// Two corners, each in the direction of the other.
template <class A, class B>
inline bool corners_again(const Placed<A>& a, const Placed<B>& b, const Cache& cache, Closest<2>& result) {
    const std::uint32_t number_a = cache.corner_a[0], number_b = cache.corner_b[0];
    if (number_a >= a.core.count() || number_b >= b.core.count()) return false;
    const std::uint32_t corner_a = a.core.number(number_a), corner_b = b.core.number(number_b);
    const Both arm_a = a.place.vector(a.core.corner(corner_a)) * a.place.scale;
    const Both arm_b = b.place.vector(b.core.corner(corner_b)) * b.place.scale;
    const Both between = (b.place.position - a.place.position) + (arm_b - arm_a);
    const double square = lanes::dot(between, between)[0];
    if (!(square > 0 && square < std::numeric_limits<double>::infinity() &&
          a.core.is_farthest(corner_a, a.place.back(between)) && b.core.is_farthest(corner_b, -b.place.back(between))))
        return false;
    // The root and the quotient side by side, not one after the other.
    const double gap = std::sqrt(square), per_gap = gap * (1 / square);
    result.distance = static_cast<float>(gap);
    lanes::store(between * lanes::both(per_gap), &result.normal.x);
    lanes::store(a.place.position + arm_a, &result.on_a.x);
    lanes::store(b.place.position + arm_b, &result.on_b.x);
    name_corner(number_a, result.feature_a);
    name_corner(number_b, result.feature_b);
    return true;
}

template <class A, class B>
bool again(const Given<2>& given_a, const Given<2>& given_b, Cache& cache, Closest<2>& result) {
    Placed<A> a(given_a);
    Placed<B> b(given_b);
    Both scales;
    if (!lanes::inverse_lengths(a.place.turn, b.place.turn, scales)) return false;
    a.place.set_scale(lanes::first(scales));
    b.place.set_scale(lanes::second(scales));
    const bool found = cache.count == 1 ? corners_again(a, b, cache, result)
                       : cache.corner_a[0] != cache.corner_a[1]
                           ? side_again(a, b, cache.corner_a[0], cache.corner_b[0], true, result)
                           : side_again(b, a, cache.corner_b[0], cache.corner_a[0], false, result);
    if (!found) return false;
    cache.axis = {result.normal.x, result.normal.y, 0};
    return true;
}

bool is_polygon(const Given<2>& given) {
    return given.kind == ShapeKind::polytope && given.as<Polygon>().sides() != nullptr;
}
bool is_box(const Given<2>& given) {
    return given.kind == ShapeKind::box && given.pose == nullptr;
}

}  // namespace

bool nearest_again(const Given<2>& a, const Given<2>& b, Cache& cache, Closest<2>& result) {
    if (cache.count == 0 || cache.count > 2) return false;
    if (is_polygon(a)) {
        if (is_polygon(b)) return again<PolygonCore, PolygonCore>(a, b, cache, result);
        return is_box(b) && again<PolygonCore, BoxCore>(a, b, cache, result);
    }
    if (!is_box(a)) return false;
    if (is_box(b)) return again<BoxCore, BoxCore>(a, b, cache, result);
    return is_polygon(b) && again<BoxCore, PolygonCore>(a, b, cache, result);
}

}  // namespace abut
