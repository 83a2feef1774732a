#include <abut/convex/feature.hpp>
#include <abut/convex/side_gaps.hpp>
#include <abut/math/lanes-inl.h>
#include <abut/query/polygons2.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>

namespace abut {
namespace {

using lanes::Both;

/// By bits. What is not a number is past both ends.
enum class Beside : std::uint32_t { within = 0, past_end = 1, before_start = 2, nowhere = 3 };

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
    /// How large its numbers are.
    double size() const { return std::abs(sides_.x[0]) + std::abs(sides_.y[0]) + 2 * sides_.size; }
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
    /// Where a point is along a side.
    Beside beside(std::uint32_t side, Both point) const {
        const std::uint32_t end = after(side);
        const Both crosses = turned(lanes::both(sides_.normal_x[side]), lanes::both(sides_.normal_y[side]),
                                    lanes::first(point) - lanes::both(sides_.x[end], sides_.x[side]),
                                    lanes::second(point) - lanes::both(sides_.y[end], sides_.y[side]));
        return static_cast<Beside>(lanes::bits(crosses <= Both{0, 0}) ^ 3);
    }
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
    Both corner(std::uint32_t i) const { return half_ * quadrant(i); }
    Both normal(std::uint32_t side) const {
        alignas(16) static constexpr double normals[8] = {0, 1, -1, 0, 0, -1, 1, 0};
        return lanes::at(normals + 2 * side);
    }
    double offset(std::uint32_t side) const { return half_[1 - (side & 1)]; }
    double size() const { return 3 * (half_[0] + half_[1]); }
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
    DVec<2> half() const { return {half_[0], half_[1]}; }

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

inline bool set_scales(Placing& a, Placing& b) {
    Both scales;
    if (!lanes::inverse_lengths(a.turn, b.turn, scales)) return false;
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
};

inline void name_corner(std::uint32_t number, Feature& feature) {
    feature.index = number;
    feature.kind = FeatureKind::vertex;
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

template <class Core>
inline void write(const SideAndCorner<Core>& found, const Placed<Core>& reference, const Placed<Core>& other,
                  std::uint32_t side, std::uint32_t corner, bool reference_is_a, Closest<2>& result) {
    const Both out = found.normal * reference.place.scale, on_other = other.place.position + found.arm;
    static constexpr double towards_b[2] = {-1, 1};
    result.distance = static_cast<float>(found.gap);
    lanes::store(out * lanes::both(towards_b[reference_is_a ? 1 : 0]), &result.normal.x);
    lanes::store(on_other - out * lanes::both(found.gap), reference_is_a ? &result.on_a.x : &result.on_b.x);
    lanes::store(on_other, reference_is_a ? &result.on_b.x : &result.on_a.x);
    Feature& of_reference = reference_is_a ? result.feature_a : result.feature_b;
    of_reference.index = edge_index(reference.core.number(side), reference.core.number(reference.core.after(side)));
    of_reference.kind = FeatureKind::edge;
    name_corner(other.core.number(corner), reference_is_a ? result.feature_b : result.feature_a);
}

constexpr double without_end = std::numeric_limits<double>::infinity();

/// Two corners. False where they aren't apart, each the farthest in the direction of the other.
template <class Core>
bool closest_corners(const Placed<Core>& a, const Placed<Core>& b, std::uint32_t corner_a, std::uint32_t corner_b,
                     Closest<2>& result) {
    const Both arm_a = a.place.vector(a.core.corner(corner_a)) * a.place.scale;
    const Both arm_b = b.place.vector(b.core.corner(corner_b)) * b.place.scale;
    const Both between = (b.place.position - a.place.position) + (arm_b - arm_a);
    const double square = lanes::dot(between, between)[0];
    if (!(square > 0 && square < without_end && a.core.is_farthest(corner_a, a.place.back(between)) &&
          b.core.is_farthest(corner_b, -b.place.back(between))))
        return false;
    // The root and the quotient side by side, not one after the other.
    const double gap = std::sqrt(square), per_gap = gap * (1 / square);
    result.distance = static_cast<float>(gap);
    lanes::store(between * lanes::both(per_gap), &result.normal.x);
    lanes::store(a.place.position + arm_a, &result.on_a.x);
    lanes::store(b.place.position + arm_b, &result.on_b.x);
    name_corner(a.core.number(corner_a), result.feature_a);
    name_corner(b.core.number(corner_b), result.feature_b);
    return true;
}

/// What was nearest last time is so still: the same corner before the same side, or the same two corners.
template <class Core>
inline bool closest_again(const Placed<Core>& a, const Placed<Core>& b, const Cache& cache, Closest<2>& result) {
    const std::uint32_t number_a = cache.corner_a[0], number_b = cache.corner_b[0];
    if (cache.count == 0 || cache.count > 2 || number_a >= a.core.count() || number_b >= b.core.count()) return false;
    const std::uint32_t of_a = a.core.number(number_a), of_b = b.core.number(number_b);
    if (cache.count == 1) return closest_corners(a, b, of_a, of_b, result);
    const bool a_is_reference = number_a != cache.corner_a[1];
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    const std::uint32_t side = a_is_reference ? of_a : of_b, corner = a_is_reference ? of_b : of_a;
    const SideAndCorner<Core> found(reference, other, side, corner);
    if (!(found.beside == Beside::within && found.gap > 0 && found.gap < without_end &&
          other.core.is_farthest(corner, -other.place.back(found.normal))))
        return false;
    write(found, reference, other, side, corner, a_is_reference, result);
    return true;
}

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

inline void remember(std::uint32_t count, std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1,
                     Cache& cache) {
    cache.count = count;
    cache.corner_a[0] = a0;
    cache.corner_a[1] = a1;
    cache.corner_b[0] = b0;
    cache.corner_b[1] = b1;
}

/// From the side with the widest gap: the other's lowest corner is before it, or before one of its ends. Where they
/// overlap, the least move apart is along that side's normal.
template <class Core>
inline bool closest_anew(const Placed<Core>& a, const Placed<Core>& b, Cache* cache, Closest<2>& result) {
    Rigid2 seen[2];
    set_seen(a, b, seen);
    const double size = std::abs(seen[0].x) + std::abs(seen[0].y) + a.core.size() + b.core.size();
    if (!(size < without_end)) return false;
    SideGap widest;
    find_widest_gap(a.core, b.core, seen, 1e-14 * size, widest);
    const bool a_is_reference = widest.of == 0;
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    const SideAndCorner<Core> found(reference, other, widest.side, widest.corner);
    const std::uint32_t after = reference.core.after(widest.side);
    if (found.beside == Beside::within) {
        write(found, reference, other, widest.side, widest.corner, a_is_reference, result);
        if (cache == nullptr) return true;
        const std::uint32_t start = reference.core.number(widest.side), end = reference.core.number(after),
                            corner = other.core.number(widest.corner);
        // The sides of what overlaps are all tried each time.
        remember(found.gap > 0 ? 2 : 0, a_is_reference ? start : corner, a_is_reference ? end : corner,
                 a_is_reference ? corner : start, a_is_reference ? corner : end, *cache);
        return true;
    }
    if (!(found.gap > 0)) return false;
    const std::uint32_t end = found.beside == Beside::before_start ? widest.side : after;
    const std::uint32_t of_a = a_is_reference ? end : widest.corner, of_b = a_is_reference ? widest.corner : end;
    if (!closest_corners(a, b, of_a, of_b, result)) return false;
    if (cache != nullptr)
        remember(1, a.core.number(of_a), a.core.number(of_a), b.core.number(of_b), b.core.number(of_b), *cache);
    return true;
}

template <class Core>
bool closest_of(const Given<2>& given_a, const Given<2>& given_b, Cache* cache, Closest<2>& result) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return false;
    if (!(cache != nullptr && closest_again(a, b, *cache, result)) && !closest_anew(a, b, cache, result)) return false;
    if (cache != nullptr) cache->axis = {result.normal.x, result.normal.y, 0};
    return true;
}

template <class Core>
bool parted(const Given<2>& given_a, const Given<2>& given_b, const Cache& cache, double reach) {
    Placed<Core> a(given_a), b(given_b);
    const bool a_is_reference = cache.corner_a[0] != cache.corner_a[1];
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    const std::uint32_t number = a_is_reference ? cache.corner_a[0] : cache.corner_b[0];
    if (number >= reference.core.count() || !set_scales(a.place, b.place)) return false;
    const std::uint32_t side = reference.core.number(number);
    const Both normal = reference.place.vector(reference.core.normal(side));
    const Both between = other.place.position - reference.place.position;
    const double lowest =
        other.core.lowest(other.place.back(normal)) * (reference.place.scale[0] * other.place.scale[0]);
    const double away = lanes::dot(normal, between)[0] * reference.place.scale[0];
    const double doubt = 1e-14 * (std::abs(between[0]) + std::abs(between[1]) + a.core.size() + b.core.size());
    return away + lowest - reference.core.offset(side) > reach + doubt;
}

bool is_polygon(const Given<2>& given) {
    return given.kind == ShapeKind::polytope && given.as<Polygon>().sides() != nullptr;
}
bool is_box(const Given<2>& given) {
    return given.kind == ShapeKind::box && given.pose == nullptr;
}

}  // namespace

bool closest_polygons(const Given<2>& a, const Given<2>& b, Cache* cache, Closest<2>& result) {
    if (is_polygon(a) && is_polygon(b)) return closest_of<PolygonCore>(a, b, cache, result);
    return is_box(a) && is_box(b) && closest_of<BoxCore>(a, b, cache, result);
}

bool parted_again(const Given<2>& a, const Given<2>& b, const Cache& cache, double reach) {
    if (cache.count != 2) return false;
    if (is_polygon(a) && is_polygon(b)) return parted<PolygonCore>(a, b, cache, reach);
    return is_box(a) && is_box(b) && parted<BoxCore>(a, b, cache, reach);
}

}  // namespace abut
