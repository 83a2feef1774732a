#include <abut/convex/toi/moving_polygon2.hpp>
#include <abut/query/direct_sweep.hpp>
#include <abut/query/given_outline.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/placed_sides.hpp>
#include <abut/query/sweep_doubts.hpp>

namespace abut {
namespace {

using namespace placed_sides;

/// What closes by a smaller part of the motion skims by.
constexpr double least_slope = 1e-6;

/// Any shape of the plane by an outline with four sides or those that it has: a circle as a box of no size, a capsule
/// and a segment as one of no width, so that their ends are sides too. Their corners are in one place two by two, or
/// all four.
class OutlineCore : public PolygonCore {
public:
    OutlineCore(ShapeKind kind, const PolygonSoa& sides) : PolygonCore(sides), kind_(kind) {}

    std::uint32_t number(std::uint32_t i) const {
        if (kind_ == ShapeKind::ball) return 0;
        const std::uint32_t number = sides().corner_number(i);
        return is_stick() ? ~number & 1 : number;
    }
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        if (kind_ == ShapeKind::ball) return true;
        return is_stick() ? direction[0] * corner(i)[0] >= 0 : PolygonCore::is_farthest(i, direction);
    }

private:
    bool is_stick() const { return kind_ == ShapeKind::capsule || kind_ == ShapeKind::segment; }

    ShapeKind kind_;
};

template <class Core>
struct Moving {
    Placed<Core> shape;
    Double2 motion;
    double radius = 0;

    Moving(const ShapeRef<2>& given, const Vec2& moves) : shape(given), motion(lanes::loaded(&moves.x)) {}
    Moving(ShapeKind kind, const PlacedPolygon& outline, const Vec2& moves)
        : shape(Core(kind, outline.sides), outline.place), motion(lanes::loaded(&moves.x)), radius(outline.radius) {}

    Double2 arm(std::uint32_t corner) const {
        return shape.place.vector(shape.core.corner(corner)) * shape.place.scale;
    }
    Double2 seen(Double2 vector) const { return shape.place.back(vector) * shape.place.scale; }
};

/// The motion, as A makes it and B sees it, and what is looked for.
struct Way {
    Double2 motion;
    double length;
    double most;    ///< up to which part of it they may come to touch
    double radius;  ///< of both balls
    Doubts doubts;

    double sure_depth() const { return beyond_sliding * doubts.slide; }
};

inline bool find_passage(const PolygonCore& a, const PolygonCore& b, const Rigid2 (&seen)[2],
                         const Double2 (&coming)[2], const Way& way, Passage& passage) {
    const DVec<2> ways[2] = {{coming[0][0], coming[0][1]}, {coming[1][0], coming[1][1]}};
    return passage_of_polygons(a.sides(), b.sides(), seen, ways, way.radius, way.sure_depth(), way.most, passage);
}
inline bool find_passage(const BoxCore& a, const BoxCore& b, const Rigid2 (&seen)[2], const Double2 (&coming)[2],
                         const Way& way, Passage& passage) {
    const Double2 half[2] = {a.half_lanes(), b.half_lanes()};
    const Double2 place[2] = {lanes::double2(seen[0].x, seen[0].y), lanes::double2(seen[1].x, seen[1].y)};
    return passage_of_boxes(half, lanes::double2(seen[0].cos, seen[0].sin), place, coming, way.radius, way.sure_depth(),
                            way.most, passage);
}

/// Of two that come to touch at `enters`: whether they do on the way, where a time makes `closing` of distance.
inline DirectAnswer is_on_way(double enters, double closing, const Way& way) {
    if (!(enters * closing > way.doubts.touch)) return DirectAnswer::unknown;
    const double late = enters - way.most;
    if (late * closing > way.doubts.touch) return DirectAnswer::no;
    // All but there at the end, they are nearest elsewhere than where they would touch.
    return late * way.length > way.doubts.touch ? DirectAnswer::unknown : DirectAnswer::yes;
}

/// Whether two that come together so fast get in for sure: around each point of the difference of the cores there is a
/// ball in the difference, and this is how deep a line comes into that.
inline bool enters_balls(double closing, const Way& way) {
    return 0.5 * closing * closing * way.radius > way.doubts.slide * way.length * way.length;
}

/// Where a point comes to another one with a ball of both radii around.
struct RoundTouch {
    double enters = 0;
    double closing = 0;
    Double2 normal{0, 0};  ///< from the one that moves
};

/// `between`: to the other; the point moves by `motion`. No: it passes on one side, which `normal` tells, of no certain
/// length. Nothing is divided by the length of the motion before it must be: areas are compared, of the motion and what
/// is across it.
inline DirectAnswer find_touch(Double2 between, Double2 motion, const Way& way, RoundTouch& touch) {
    const double square = lanes::dot(motion, motion)[0], per_square = 1 / square, per_radius = 1 / way.radius;
    const Double2 crossed = motion * lanes::swapped(between);
    const double across = crossed[0] - crossed[1], ahead = lanes::dot(between, motion)[0];
    const double passes = way.radius + way.sure_depth();
    if (across * across > passes * passes * square) {
        touch.normal = lanes::swapped(motion) * lanes::double2(-across, across);
        return DirectAnswer::no;
    }
    const double chord = way.radius * way.radius * square - across * across;
    if (!(0.5 * chord > way.doubts.slide * way.radius * square)) return DirectAnswer::unknown;
    const double half = std::sqrt(chord);
    touch.enters = (ahead - half) * per_square;
    touch.closing = half * per_radius;
    touch.normal = (between - motion * lanes::double2(touch.enters)) * lanes::double2(per_radius);
    return DirectAnswer::yes;
}

/// `normal`: from A.
inline void write(double time, const Way& way, Double2 point, Double2 normal, Hit<2>& hit) {
    hit.fraction = static_cast<float>(time);
    hit.distance = static_cast<float>(time * way.length);
    lanes::store(point, &hit.point.x);
    lanes::store(-normal, &hit.normal.x);
}

/// A touch found by a side of one, `reference`.
template <class Core>
class SideTouch {
public:
    SideTouch(const Moving<Core>& reference, const Moving<Core>& other, const Passage& passage, const Way& way)
        : reference_(reference), other_(other), passage_(passage), way_(way) {}

    DirectAnswer tell(std::optional<Hit<2>>& result) const {
        const Placed<Core>& shape = reference_.shape;
        const Double2 velocity = other_.motion - reference_.motion;
        const Double2 out = shape.place.vector(shape.core.normal(passage_.side)) * shape.place.scale;
        const double closing = -lanes::dot(out, velocity)[0];
        if (!(closing > least_slope * way_.length)) return DirectAnswer::unknown;
        const DirectAnswer on_way = is_on_way(passage_.enters, closing, way_);
        if (on_way != DirectAnswer::yes) return on_way;
        const double time = std::min(passage_.enters, way_.most);

        const Double2 arm = other_.arm(passage_.corner);
        const Double2 between = (other_.shape.place.position - shape.place.position) + velocity * lanes::double2(time);
        const Double2 seen = reference_.seen(arm + between);
        const Beside beside = shape.core.beside(passage_.side, seen);
        if (beside == Beside::within) {
            if (way_.radius > 0 && !enters_balls(closing, way_)) return DirectAnswer::unknown;
            tell_at_corner(time, arm, out, result.emplace());
            return DirectAnswer::yes;
        }
        const bool before = beside == Beside::before_start;
        const std::uint32_t end = before ? passage_.side : shape.core.after(passage_.side);
        const std::uint32_t next =
            before ? other_.shape.core.before(passage_.corner) : other_.shape.core.after(passage_.corner);
        if (!end_touches(seen, end, reference_.seen(other_.arm(next) + between)))
            return way_.radius > 0 ? tell_round(end, result) : DirectAnswer::unknown;
        if (way_.radius > 0 && !enters_balls(closing, way_)) return DirectAnswer::unknown;
        tell_at_end(time, end, next, out, result.emplace());
        return DirectAnswer::yes;
    }

private:
    bool a_is_reference() const { return passage_.of == 0; }
    Double2 from_a(Double2 out) const {
        static constexpr double towards_b[2] = {1, -1};
        return out * lanes::double2(towards_b[passage_.of]);
    }
    /// By the two corners, or the one told twice, of a place on B.
    static void name(const Moving<Core>& b, std::uint32_t i, std::uint32_t j, Hit<2>& hit) {
        name_end_or_edge<2>({b.shape.core.number(i), b.shape.core.number(j)}, 0, hit.feature);
    }

    void tell_at_corner(double time, Double2 arm, Double2 out, Hit<2>& hit) const {
        const Double2 point = other_.shape.place.position + arm + other_.motion * lanes::double2(time);
        write(time, way_, point - out * lanes::double2(other_.radius), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, passage_.corner, hit);
        else
            name(reference_, passage_.side, reference_.shape.core.after(passage_.side), hit);
    }

    /// Where faces meet face to face, the corner that was found may lie past an end of the side; then that end touches
    /// the edge from the corner to the next.
    bool end_touches(Double2 corner, std::uint32_t end, Double2 next) const {
        const Core& core = reference_.shape.core;
        const Double2 out = core.normal(passage_.side), along = lanes::swapped(out) * Double2{-1, 1};
        const double here = lanes::dot(along, corner - core.corner(end))[0],
                     there = lanes::dot(along, next - core.corner(end))[0];
        const double part = here / (here - there), rises = lanes::dot(out, next - corner)[0];
        return part >= 0 && part <= 1 && part * rises <= 0.25 * way_.doubts.touch;
    }
    void tell_at_end(double time, std::uint32_t end, std::uint32_t next, Double2 out, Hit<2>& hit) const {
        const Double2 point =
            reference_.shape.place.position + reference_.arm(end) + reference_.motion * lanes::double2(time);
        write(time, way_, point + out * lanes::double2(reference_.radius), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, next, hit);
        else
            name(reference_, end, end, hit);
    }

    /// Past the end of a side the shapes are round about two corners. That these are the farthest along the normal
    /// proves what is told: a plane parts the two until then, or all the time.
    DirectAnswer tell_round(std::uint32_t end, std::optional<Hit<2>>& result) const {
        const Double2 end_arm = reference_.arm(end), corner_arm = other_.arm(passage_.corner);
        const Double2 between =
            (other_.shape.place.position - reference_.shape.place.position) + (corner_arm - end_arm);
        RoundTouch touch;
        const DirectAnswer found = find_touch(between, reference_.motion - other_.motion, way_, touch);
        if (found == DirectAnswer::unknown || !reference_.shape.core.is_farthest(end, reference_.seen(touch.normal)) ||
            !other_.shape.core.is_farthest(passage_.corner, other_.seen(-touch.normal)))
            return DirectAnswer::unknown;
        if (found == DirectAnswer::no) return found;
        const DirectAnswer on_way = is_on_way(touch.enters, touch.closing, way_);
        if (on_way != DirectAnswer::yes) return on_way;
        const double time = std::min(touch.enters, way_.most);
        const Double2 point = reference_.shape.place.position + end_arm + reference_.motion * lanes::double2(time);
        Hit<2>& hit = result.emplace();
        write(time, way_, point + touch.normal * lanes::double2(reference_.radius), from_a(touch.normal), hit);
        const std::uint32_t of_b = a_is_reference() ? passage_.corner : end;
        name(a_is_reference() ? other_ : reference_, of_b, of_b, hit);
        return DirectAnswer::yes;
    }

    const Moving<Core>&reference_, &other_;
    const Passage& passage_;
    const Way& way_;
};

template <class Core>
DirectAnswer sweep_moving(Moving<Core>& a, Moving<Core>& b, std::optional<Hit<2>>& result) {
    if (!set_scales(a.shape.place, b.shape.place)) return DirectAnswer::unknown;
    Rigid2 seen[2];
    set_seen(a.shape, b.shape, seen);
    Way way;
    way.motion = a.motion - b.motion;
    way.length = std::sqrt(lanes::dot(way.motion, way.motion)[0]);
    way.radius = a.radius + b.radius;
    // When they have moved as far as this, there is nothing before them any more.
    const double far = 2 * (std::abs(seen[0].x) + std::abs(seen[0].y) + a.shape.core.size() + b.shape.core.size() +
                            std::abs(way.radius));
    if (!(way.length > 0 && way.length < without_end && far < without_end)) return DirectAnswer::unknown;
    way.most = way.length > far ? far / way.length : 1;
    way.doubts = Doubts({a.shape.core.extent() + a.radius, 0}, {b.shape.core.extent() + b.radius, 0}, far);
    const Double2 coming[2] = {a.seen(way.motion), b.seen(-way.motion)};
    Passage passage;
    if (!find_passage(a.shape.core, b.shape.core, seen, coming, way, passage)) return DirectAnswer::no;
    if (!passage.penetrates()) return DirectAnswer::unknown;
    return passage.of == 0 ? SideTouch<Core>(a, b, passage, way).tell(result)
                           : SideTouch<Core>(b, a, passage, way).tell(result);
}

template <class Core>
DirectAnswer sweep_cores(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                         const Vec2& motion_b, std::optional<Hit<2>>& result) {
    Moving<Core> a(given_a, motion_a), b(given_b, motion_b);
    return sweep_moving(a, b, result);
}

/// A box of no width about a segment, or of no size about a point.
void set_stick(const DVec<2>& a, const DVec<2>& b, PlacedPolygon& outline) {
    const DVec<2> middle = 0.5 * (a + b), along = normalized(b - a);
    outline.place = {along.x, along.y, middle.x, middle.y};
    outline.set_box({0.5 * length(b - a), 0});
}

bool set_moving_outline(const ShapeRef<2>& given, PlacedPolygon& outline) {
    outline.radius = 0;
    switch (given.kind) {
        case ShapeKind::ball: {
            const DVec<2> center = place_of(given).point(DVec<2>(given.as<Circle>().center));
            set_stick(center, center, outline);
            outline.radius = static_cast<double>(given.as<Circle>().radius);
            return true;
        }
        case ShapeKind::capsule: {
            const Capsule2& capsule = given.as<Capsule2>();
            set_stick(place_of(given).point(DVec<2>(capsule.a)), place_of(given).point(DVec<2>(capsule.b)), outline);
            outline.radius = static_cast<double>(capsule.radius);
            return true;
        }
        case ShapeKind::segment: {
            const Segment2& segment = given.as<Segment2>();
            set_stick(place_of(given).point(DVec<2>(segment.a)), place_of(given).point(DVec<2>(segment.b)), outline);
            return true;
        }
        default:
            return set_placed_polygon(given, outline);
    }
}

DirectAnswer sweep_outlines(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                            const Vec2& motion_b, std::optional<Hit<2>>& result) {
    PlacedPolygon outline_a, outline_b;
    if (!set_moving_outline(given_a, outline_a) || !set_moving_outline(given_b, outline_b))
        return DirectAnswer::unknown;
    Moving<OutlineCore> a(given_a.kind, outline_a, motion_a), b(given_b.kind, outline_b, motion_b);
    return sweep_moving(a, b, result);
}

inline Double2 center_of(const ShapeRef<2>& given) {
    const Circle& circle = given.as<Circle>();
    if (given.pose == nullptr) return lanes::loaded(&circle.center.x);
    const DVec<2> center = placed<2>(DVec<2>(circle.center), *given.pose);
    return lanes::double2(center.x, center.y);
}

DirectAnswer sweep_circles(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                           const Vec2& motion_b, std::optional<Hit<2>>& result) {
    const double radius_a = static_cast<double>(given_a.as<Circle>().radius),
                 radius_b = static_cast<double>(given_b.as<Circle>().radius);
    const Double2 center = center_of(given_a), moves_a = lanes::loaded(&motion_a.x);
    const Double2 between = center_of(given_b) - center;
    const double far = 2 * (std::abs(between[0]) + std::abs(between[1]) + std::abs(radius_a + radius_b));
    Way way;
    way.motion = moves_a - lanes::loaded(&motion_b.x);
    way.length = std::sqrt(lanes::dot(way.motion, way.motion)[0]);
    way.most = 1;
    way.radius = radius_a + radius_b;
    way.doubts = Doubts({radius_a, 0}, {radius_b, 0}, far);
    const double outside = way.radius + way.doubts.touch;
    if (!(way.radius > 0 && way.length > 0 && way.length < without_end && far < without_end &&
          lanes::dot(between, between)[0] > outside * outside))
        return DirectAnswer::unknown;
    if (!(lanes::dot(between, way.motion)[0] > 0)) return DirectAnswer::no;
    RoundTouch touch;
    const DirectAnswer found = find_touch(between, way.motion, way, touch);
    if (found != DirectAnswer::yes) return found;
    const DirectAnswer on_way = is_on_way(touch.enters, touch.closing, way);
    if (on_way != DirectAnswer::yes) return on_way;
    const double time = std::min(touch.enters, way.most);
    Hit<2>& hit = result.emplace();
    const Double2 point = center + moves_a * lanes::double2(time) + touch.normal * lanes::double2(radius_a);
    write(time, way, point, touch.normal, hit);
    hit.feature.kind = FeatureKind::vertex;
    return DirectAnswer::yes;
}

}  // namespace

DirectAnswer direct_sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                          std::optional<Hit<2>>& result) {
    if (is_polygon(a) && is_polygon(b)) return sweep_cores<PolygonCore>(a, motion_a, b, motion_b, result);
    if (is_box(a) && is_box(b)) return sweep_cores<BoxCore>(a, motion_a, b, motion_b, result);
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::ball) return sweep_circles(a, motion_a, b, motion_b, result);
    return sweep_outlines(a, motion_a, b, motion_b, result);
}

}  // namespace abut
