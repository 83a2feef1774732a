#include <abut/convex/moving_sides.hpp>
#include <abut/math/set_affine.hpp>
#include <abut/query/direct_sweep.hpp>
#include <abut/query/placed_sides.hpp>
#include <abut/query/sweep_doubts.hpp>
#include <abut/shape/ball.hpp>

namespace abut {
namespace {

using namespace placed_sides;

/// What closes by a smaller part of the motion skims by.
constexpr double least_slope = 1e-6;

template <class Core>
struct Mover {
    Placed<Core> shape;
    Both motion;

    Mover(const Given<2>& given, const Vec2& moves) : shape(given), motion(lanes::loaded(&moves.x)) {}
};

inline bool find_passage(const PolygonCore& a, const PolygonCore& b, const Rigid2 (&seen)[2], const Both (&coming)[2],
                         double depth, double most, Passage& passage) {
    const DVec<2> ways[2] = {{coming[0][0], coming[0][1]}, {coming[1][0], coming[1][1]}};
    return passage_of_sides(a.sides(), b.sides(), seen, ways, 0, depth, most, passage);
}
inline bool find_passage(const BoxCore& a, const BoxCore& b, const Rigid2 (&seen)[2], const Both (&coming)[2],
                         double depth, double most, Passage& passage) {
    const Both half[2] = {a.half_lanes(), b.half_lanes()};
    const Both place[2] = {lanes::both(seen[0].x, seen[0].y), lanes::both(seen[1].x, seen[1].y)};
    return passage_of_boxes(half, lanes::both(seen[0].cos, seen[0].sin), place, coming, 0, depth, most, passage);
}

/// The moment at which a side of one comes to touch a corner of the other.
struct Moment {
    double time;  ///< in parts of the motion
    double length;
    double touch;  ///< what may be rounding
};

/// Where faces meet face to face, the corner that was found may lie past an end of the side; then that end touches the
/// edge at the corner. False where it doesn't.
template <class Core>
bool end_touches(const Placed<Core>& reference, const Placed<Core>& other, Both between, const Passage& passage,
                 Both seen_corner, std::uint32_t end, std::uint32_t next, double touch) {
    const Both arm = other.place.vector(other.core.corner(next)) * other.place.scale;
    const Both seen_next = reference.place.back(arm + between) * reference.place.scale;
    const Both out = reference.core.normal(passage.side), along = lanes::swapped(out) * Both{-1, 1};
    const Both from = reference.core.corner(end);
    const double here = lanes::dot(along, seen_corner - from)[0], there = lanes::dot(along, seen_next - from)[0];
    const double rises = lanes::dot(out, seen_next - seen_corner)[0];
    const double part = here / (here - there);
    return part >= 0 && part <= 1 && part * rises <= 0.25 * touch;
}

/// What is told of a touch found by a side of `reference`.
template <class Core>
DirectAnswer tell(const Mover<Core>& reference, const Mover<Core>& other, const Passage& passage, double length,
                  double most, double touch, std::optional<Hit<2>>& result) {
    const Placed<Core>&side_of = reference.shape, &corner_of = other.shape;
    const Both velocity = other.motion - reference.motion;
    const Both out = side_of.place.vector(side_of.core.normal(passage.side)) * side_of.place.scale;
    const double closing = -lanes::dot(out, velocity)[0];
    if (!(closing > least_slope * length && passage.enters * closing > touch)) return DirectAnswer::unknown;
    const double late = passage.enters - most;
    if (late * closing > touch) return DirectAnswer::no;
    // All but there at the end, they are nearest elsewhere than where they would touch.
    if (late * length > touch) return DirectAnswer::unknown;
    const double time = std::min(passage.enters, most);

    const Both arm = corner_of.place.vector(corner_of.core.corner(passage.corner)) * corner_of.place.scale;
    const Both between = (corner_of.place.position - side_of.place.position) + velocity * lanes::both(time);
    const Both seen = side_of.place.back(arm + between) * side_of.place.scale;
    const Beside beside = side_of.core.beside(passage.side, seen);
    const bool a_is_reference = passage.of == 0;
    Both point;
    Feature feature;
    if (beside == Beside::within) {
        point = corner_of.place.position + arm + other.motion * lanes::both(time);
        if (a_is_reference)
            name_corner(corner_of.core.number(passage.corner), feature);
        else
            name_side(side_of.core, passage.side, feature);
    } else {
        const bool before = beside == Beside::before_start;
        const std::uint32_t end = before ? passage.side : side_of.core.after(passage.side);
        const std::uint32_t next =
            before ? corner_of.core.before(passage.corner) : corner_of.core.after(passage.corner);
        if (!end_touches(side_of, corner_of, between, passage, seen, end, next, touch)) return DirectAnswer::unknown;
        point = side_of.place.position + side_of.place.vector(side_of.core.corner(end)) * side_of.place.scale +
                reference.motion * lanes::both(time);
        if (a_is_reference)
            name_side(corner_of.core, before ? next : passage.corner, feature);
        else
            name_corner(side_of.core.number(end), feature);
    }
    Hit<2>& hit = result.emplace();
    static constexpr double towards_a[2] = {-1, 1};
    hit.fraction = static_cast<float>(time);
    hit.distance = static_cast<float>(time * length);
    lanes::store(point, &hit.point.x);
    lanes::store(out * lanes::both(towards_a[passage.of]), &hit.normal.x);
    hit.feature.index = feature.index;
    hit.feature.kind = feature.kind;
    return DirectAnswer::yes;
}

template <class Core>
DirectAnswer sweep_cores(const Given<2>& given_a, const Vec2& motion_a, const Given<2>& given_b, const Vec2& motion_b,
                         std::optional<Hit<2>>& result) {
    Mover<Core> a(given_a, motion_a), b(given_b, motion_b);
    if (!set_scales(a.shape.place, b.shape.place)) return DirectAnswer::unknown;
    Rigid2 seen[2];
    set_seen(a.shape, b.shape, seen);
    const Both way = a.motion - b.motion;
    const double length = std::sqrt(lanes::dot(way, way)[0]);
    // When they have moved as far as this, there is nothing before them any more.
    const double far = 2 * (std::abs(seen[0].x) + std::abs(seen[0].y) + a.shape.core.size() + b.shape.core.size());
    if (!(length > 0 && length < without_end && far < without_end)) return DirectAnswer::unknown;
    const double most = length > far ? far / length : 1;
    const Doubts doubts({a.shape.core.extent(), 0}, {b.shape.core.extent(), 0}, far);
    const Both coming[2] = {a.shape.place.back(way) * a.shape.place.scale,
                            b.shape.place.back(-way) * b.shape.place.scale};
    Passage passage;
    if (!find_passage(a.shape.core, b.shape.core, seen, coming, beyond_sliding * doubts.slide, most, passage))
        return DirectAnswer::no;
    if (!passage.gets_deep()) return DirectAnswer::unknown;
    return passage.of == 0 ? tell(a, b, passage, length, most, doubts.touch, result)
                           : tell(b, a, passage, length, most, doubts.touch, result);
}

inline Both center_of(const Given<2>& given) {
    const Circle& circle = given.as<Circle>();
    if (given.pose == nullptr) return lanes::loaded(&circle.center.x);
    const DVec<2> center = placed<2>(DVec<2>(circle.center), *given.pose);
    return lanes::both(center.x, center.y);
}

/// The center of one on its way to a circle of both radii around that of the other. Nothing is divided by the length of
/// the motion before it is told: areas are compared, of the motion and what is across it.
DirectAnswer sweep_circles(const Given<2>& given_a, const Vec2& motion_a, const Given<2>& given_b, const Vec2& motion_b,
                           std::optional<Hit<2>>& result) {
    const double radius_a = static_cast<double>(given_a.as<Circle>().radius),
                 radius_b = static_cast<double>(given_b.as<Circle>().radius), radius = radius_a + radius_b;
    const Both center = center_of(given_a), moves_a = lanes::loaded(&motion_a.x), moves_b = lanes::loaded(&motion_b.x);
    const Both between = center_of(given_b) - center, way = moves_a - moves_b;
    const Both crossed = way * lanes::swapped(between);
    const double across = crossed[0] - crossed[1], ahead = lanes::dot(between, way)[0];
    const double square = lanes::dot(way, way)[0], distance_square = lanes::dot(between, between)[0];
    const double length = std::sqrt(square), per_square = 1 / square;
    const double far = 2 * (std::abs(between[0]) + std::abs(between[1]) + radius);
    const Doubts doubts({radius_a, 0}, {radius_b, 0}, far);
    const double outside = radius + doubts.touch, passes = radius + beyond_sliding * doubts.slide;
    if (!(radius > 0 && square > 0 && square < without_end && distance_square > outside * outside &&
          distance_square < without_end))
        return DirectAnswer::unknown;
    if (!(ahead > 0) || across * across > passes * passes * square) return DirectAnswer::no;
    // How deep the line comes into the circle; half of the square of its closing at the least, in parts of the radius.
    const double chord = radius * radius * square - across * across;
    if (!(0.5 * chord > doubts.slide * radius * square)) return DirectAnswer::unknown;
    const double half = std::sqrt(chord), enters = (ahead - half) * per_square, late = enters - 1;
    if (late > 0) {
        // It closes by half / (radius * length) of the length.
        if (late * half > doubts.touch * radius) return DirectAnswer::no;
        if (late * length > doubts.touch) return DirectAnswer::unknown;
    }
    if (!(enters * half > doubts.touch * radius)) return DirectAnswer::unknown;
    const double time = std::min(enters, 1.0);
    const Both normal = (between - way * lanes::both(time)) * lanes::both(1 / radius);
    Hit<2>& hit = result.emplace();
    hit.fraction = static_cast<float>(time);
    hit.distance = static_cast<float>(time * length);
    lanes::store(center + moves_a * lanes::both(time) + normal * lanes::both(radius_a), &hit.point.x);
    lanes::store(-normal, &hit.normal.x);
    hit.feature.kind = FeatureKind::vertex;
    return DirectAnswer::yes;
}

}  // namespace

DirectAnswer direct_sweep(const Given<2>& a, const Vec2& motion_a, const Given<2>& b, const Vec2& motion_b,
                          std::optional<Hit<2>>& result) {
    if (is_polygon(a) && is_polygon(b)) return sweep_cores<PolygonCore>(a, motion_a, b, motion_b, result);
    if (is_box(a) && is_box(b)) return sweep_cores<BoxCore>(a, motion_a, b, motion_b, result);
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::ball) return sweep_circles(a, motion_a, b, motion_b, result);
    return DirectAnswer::unknown;
}

}  // namespace abut
