#include <abut/convex/toi/moving_polygon2.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/detail/closed_form/polygon_cores2.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/sweep/tolerances.hpp>

namespace abut::detail {
namespace {

using namespace polygon_cores;

/// A motion that approaches by less than this fraction grazes.
constexpr double min_slope = 1e-6;

/// Any shape of the plane as a polygon: a circle is a box of size 0, a capsule or segment is a box of width 0, so that
/// their ends are edges too. Two or all four of their vertices coincide.
class PlacedPolygonCore : public PolygonCore {
public:
    PlacedPolygonCore(ShapeKind kind, const PolygonSoa& sides) : PolygonCore(sides), kind_(kind) {}

    std::uint32_t number(std::uint32_t i) const {
        if (kind_ == ShapeKind::ball) return 0;
        const std::uint32_t number = sides().corner_number(i);
        return is_degenerate() ? ~number & 1 : number;
    }
    bool is_farthest(std::uint32_t i, Double2 direction) const {
        if (kind_ == ShapeKind::ball) return true;
        return is_degenerate() ? direction[0] * corner(i)[0] >= 0 : PolygonCore::is_farthest(i, direction);
    }

private:
    bool is_degenerate() const { return kind_ == ShapeKind::capsule || kind_ == ShapeKind::segment; }

    ShapeKind kind_;
};

template <class Core>
struct Moving {
    Placed<Core> shape;
    Double2 motion;
    double radius = 0;

    Moving(const ShapeRef<2>& given, const Vec2& motion_of_shape)
        : shape(given), motion(lanes::loaded(&motion_of_shape.x)) {}
    Moving(ShapeKind kind, const PlacedPolygon& polygon, const Vec2& motion_of_shape)
        : shape(Core(kind, polygon.sides), polygon.place),
          motion(lanes::loaded(&motion_of_shape.x)),
          radius(polygon.radius) {}

    Double2 offset(std::uint32_t corner) const {
        return shape.place.vector(shape.core.corner(corner)) * shape.place.scale;
    }
    Double2 to_local(Double2 vector) const { return shape.place.back(vector) * shape.place.scale; }
};

/// The motion of A relative to B, and the tolerances.
struct RelativeMotion {
    Double2 motion;
    double length;
    double max_fraction;  ///< the fraction of the motion up to which they may touch
    double radius;        ///< the sum of both radii
    SweepTolerances tolerances;

    double certain_depth() const { return beyond_sliding * tolerances.slide; }
};

inline bool find_passage(const PolygonCore& a, const PolygonCore& b, const Rigid2 (&relative_places)[2],
                         const Double2 (&coming)[2], const RelativeMotion& relative, Passage& passage) {
    const DVec<2> directions[2] = {{coming[0][0], coming[0][1]}, {coming[1][0], coming[1][1]}};
    return passage_of_polygons(a.sides(), b.sides(), relative_places, directions, relative.radius,
                               relative.certain_depth(), relative.max_fraction, passage);
}
inline bool find_passage(const BoxCore& a, const BoxCore& b, const Rigid2 (&relative_places)[2],
                         const Double2 (&coming)[2], const RelativeMotion& relative, Passage& passage) {
    const Double2 half[2] = {a.half_lanes(), b.half_lanes()};
    const Double2 place[2] = {lanes::double2(relative_places[0].x, relative_places[0].y),
                              lanes::double2(relative_places[1].x, relative_places[1].y)};
    return passage_of_boxes(half, lanes::double2(relative_places[0].cos, relative_places[0].sin), place, coming,
                            relative.radius, relative.certain_depth(), relative.max_fraction, passage);
}

/// Whether two shapes that touch at the time `enters` do so within the motion, if they approach by `closing` per unit
/// of time.
inline ClosedFormAnswer is_within_motion(double enters, double closing, const RelativeMotion& relative) {
    if (!(enters * closing > relative.tolerances.touch)) return ClosedFormAnswer::unknown;
    const double late = enters - relative.max_fraction;
    if (late * closing > relative.tolerances.touch) return ClosedFormAnswer::no;
    // They almost touch at the end, where the closest points are not yet those of the impact.
    return late * relative.length > relative.tolerances.touch ? ClosedFormAnswer::unknown : ClosedFormAnswer::yes;
}

/// Whether two shapes that approach this fast certainly penetrate: around each point of the difference of the cores the
/// Minkowski difference contains a ball, and a line goes this deep into the ball.
inline bool enters_balls(double closing, const RelativeMotion& relative) {
    return 0.5 * closing * closing * relative.radius > relative.tolerances.slide * relative.length * relative.length;
}

/// The impact of a point with a ball of both radii around another point.
struct RoundImpact {
    double enters = 0;
    double closing = 0;
    Double2 normal{0, 0};  ///< from the moving one
};

/// `between` goes to the other point; the point moves by `motion`. `no` means that it passes on one side; `normal` then
/// points to that side, with any length. The code divides by the length of the motion as late as possible: it compares
/// areas of the motion and the offset across it.
inline ClosedFormAnswer find_round_impact(Double2 between, Double2 motion, const RelativeMotion& relative,
                                          RoundImpact& impact) {
    const double square = lanes::dot(motion, motion)[0], per_square = 1 / square, per_radius = 1 / relative.radius;
    const Double2 crossed = motion * lanes::swapped(between);
    const double across = crossed[0] - crossed[1], ahead = lanes::dot(between, motion)[0];
    const double passes = relative.radius + relative.certain_depth();
    if (across * across > passes * passes * square) {
        impact.normal = lanes::swapped(motion) * lanes::double2(-across, across);
        return ClosedFormAnswer::no;
    }
    const double chord = relative.radius * relative.radius * square - across * across;
    if (!(0.5 * chord > relative.tolerances.slide * relative.radius * square)) return ClosedFormAnswer::unknown;
    const double half = std::sqrt(chord);
    impact.enters = (ahead - half) * per_square;
    impact.closing = half * per_radius;
    impact.normal = (between - motion * lanes::double2(impact.enters)) * lanes::double2(per_radius);
    return ClosedFormAnswer::yes;
}

/// `normal` points out of A.
inline void write(double time, const RelativeMotion& relative, Double2 point, Double2 normal, Hit<2>& hit) {
    hit.fraction = static_cast<float>(time);
    hit.distance = static_cast<float>(time * relative.length);
    lanes::store(point, &hit.point.x);
    lanes::store(-normal, &hit.normal.x);
}

/// An impact found on an edge of one shape, `reference`.
template <class Core>
class EdgeImpact {
public:
    EdgeImpact(const Moving<Core>& reference, const Moving<Core>& other, const Passage& passage,
               const RelativeMotion& relative)
        : reference_(reference), other_(other), passage_(passage), relative_(relative) {}

    ClosedFormAnswer report(std::optional<Hit<2>>& result) const {
        const Placed<Core>& shape = reference_.shape;
        const Double2 velocity = other_.motion - reference_.motion;
        const Double2 out = shape.place.vector(shape.core.normal(passage_.side)) * shape.place.scale;
        const double closing = -lanes::dot(out, velocity)[0];
        if (!(closing > min_slope * relative_.length)) return ClosedFormAnswer::unknown;
        const ClosedFormAnswer within_motion = is_within_motion(passage_.enters, closing, relative_);
        if (within_motion != ClosedFormAnswer::yes) return within_motion;
        const double time = std::min(passage_.enters, relative_.max_fraction);

        const Double2 offset = other_.offset(passage_.corner);
        const Double2 between = (other_.shape.place.position - shape.place.position) + velocity * lanes::double2(time);
        const Double2 local_corner = reference_.to_local(offset + between);
        const EdgeRegion region = shape.core.voronoi_region(passage_.side, local_corner);
        if (region == EdgeRegion::within) {
            if (relative_.radius > 0 && !enters_balls(closing, relative_)) return ClosedFormAnswer::unknown;
            report_at_vertex(time, offset, out, result.emplace());
            return ClosedFormAnswer::yes;
        }
        const bool before = region == EdgeRegion::before_start;
        const std::uint32_t end = before ? passage_.side : shape.core.after(passage_.side);
        const std::uint32_t next =
            before ? other_.shape.core.before(passage_.corner) : other_.shape.core.after(passage_.corner);
        if (!end_touches(local_corner, end, reference_.to_local(other_.offset(next) + between)))
            return relative_.radius > 0 ? report_round(end, result) : ClosedFormAnswer::unknown;
        if (relative_.radius > 0 && !enters_balls(closing, relative_)) return ClosedFormAnswer::unknown;
        report_at_end(time, end, next, out, result.emplace());
        return ClosedFormAnswer::yes;
    }

private:
    bool a_is_reference() const { return passage_.of == 0; }
    Double2 from_a(Double2 out) const {
        static constexpr double towards_b[2] = {1, -1};
        return out * lanes::double2(towards_b[passage_.of]);
    }
    /// Names the feature of B by its two vertices, or one vertex given twice.
    static void name(const Moving<Core>& b, std::uint32_t i, std::uint32_t j, Hit<2>& hit) {
        name_end_or_edge<2>({b.shape.core.number(i), b.shape.core.number(j)}, 0, hit.feature);
    }

    void report_at_vertex(double time, Double2 offset, Double2 out, Hit<2>& hit) const {
        const Double2 point = other_.shape.place.position + offset + other_.motion * lanes::double2(time);
        write(time, relative_, point - out * lanes::double2(other_.radius), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, passage_.corner, hit);
        else
            name(reference_, passage_.side, reference_.shape.core.after(passage_.side), hit);
    }

    /// If two faces meet, the vertex found may lie beyond an end of the edge. Then that end touches the edge from the
    /// vertex to the next one.
    bool end_touches(Double2 corner, std::uint32_t end, Double2 next) const {
        const Core& core = reference_.shape.core;
        const Double2 out = core.normal(passage_.side), along = lanes::swapped(out) * Double2{-1, 1};
        const double corner_along = lanes::dot(along, corner - core.corner(end))[0],
                     next_along = lanes::dot(along, next - core.corner(end))[0];
        const double part = corner_along / (corner_along - next_along), rises = lanes::dot(out, next - corner)[0];
        return part >= 0 && part <= 1 && part * rises <= 0.25 * relative_.tolerances.touch;
    }
    void report_at_end(double time, std::uint32_t end, std::uint32_t next, Double2 out, Hit<2>& hit) const {
        const Double2 point =
            reference_.shape.place.position + reference_.offset(end) + reference_.motion * lanes::double2(time);
        write(time, relative_, point + out * lanes::double2(reference_.radius), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, next, hit);
        else
            name(reference_, end, end, hit);
    }

    /// Beyond the end of an edge the shapes are round around two vertices. The answer is proven if these are the
    /// farthest along the normal: a plane separates the shapes until then, or all the time.
    ClosedFormAnswer report_round(std::uint32_t end, std::optional<Hit<2>>& result) const {
        const Double2 end_offset = reference_.offset(end), corner_offset = other_.offset(passage_.corner);
        const Double2 between =
            (other_.shape.place.position - reference_.shape.place.position) + (corner_offset - end_offset);
        RoundImpact impact;
        const ClosedFormAnswer found = find_round_impact(between, reference_.motion - other_.motion, relative_, impact);
        if (found == ClosedFormAnswer::unknown ||
            !reference_.shape.core.is_farthest(end, reference_.to_local(impact.normal)) ||
            !other_.shape.core.is_farthest(passage_.corner, other_.to_local(-impact.normal)))
            return ClosedFormAnswer::unknown;
        if (found == ClosedFormAnswer::no) return found;
        const ClosedFormAnswer within_motion = is_within_motion(impact.enters, impact.closing, relative_);
        if (within_motion != ClosedFormAnswer::yes) return within_motion;
        const double time = std::min(impact.enters, relative_.max_fraction);
        const Double2 point = reference_.shape.place.position + end_offset + reference_.motion * lanes::double2(time);
        Hit<2>& hit = result.emplace();
        write(time, relative_, point + impact.normal * lanes::double2(reference_.radius), from_a(impact.normal), hit);
        const std::uint32_t of_b = a_is_reference() ? passage_.corner : end;
        name(a_is_reference() ? other_ : reference_, of_b, of_b, hit);
        return ClosedFormAnswer::yes;
    }

    const Moving<Core>&reference_, &other_;
    const Passage& passage_;
    const RelativeMotion& relative_;
};

template <class Core>
ClosedFormAnswer sweep_moving(Moving<Core>& a, Moving<Core>& b, std::optional<Hit<2>>& result) {
    if (!set_scales(a.shape.place, b.shape.place)) return ClosedFormAnswer::unknown;
    Rigid2 relative_places[2];
    set_relative_places(a.shape, b.shape, relative_places);
    RelativeMotion relative;
    relative.motion = a.motion - b.motion;
    relative.length = std::sqrt(lanes::dot(relative.motion, relative.motion)[0]);
    relative.radius = a.radius + b.radius;
    // Beyond this length of motion nothing can be hit.
    const double far = 2 * (std::abs(relative_places[0].x) + std::abs(relative_places[0].y) + a.shape.core.size() +
                            b.shape.core.size() + std::abs(relative.radius));
    if (!(relative.length > 0 && relative.length < infinity && far < infinity)) return ClosedFormAnswer::unknown;
    relative.max_fraction = relative.length > far ? far / relative.length : 1;
    relative.tolerances =
        SweepTolerances({a.shape.core.extent() + a.radius, 0}, {b.shape.core.extent() + b.radius, 0}, far);
    const Double2 coming[2] = {a.to_local(relative.motion), b.to_local(-relative.motion)};
    Passage passage;
    if (!find_passage(a.shape.core, b.shape.core, relative_places, coming, relative, passage))
        return ClosedFormAnswer::no;
    if (!passage.penetrates()) return ClosedFormAnswer::unknown;
    return passage.of == 0 ? EdgeImpact<Core>(a, b, passage, relative).report(result)
                           : EdgeImpact<Core>(b, a, passage, relative).report(result);
}

template <class Core>
ClosedFormAnswer sweep_cores(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                             const Vec2& motion_b, std::optional<Hit<2>>& result) {
    Moving<Core> a(given_a, motion_a), b(given_b, motion_b);
    return sweep_moving(a, b, result);
}

/// A box of width 0 around a segment, or of size 0 around a point.
void set_degenerate_box(const DVec<2>& a, const DVec<2>& b, PlacedPolygon& polygon) {
    const DVec<2> middle = 0.5 * (a + b), along = normalized(b - a);
    polygon.place = {along.x, along.y, middle.x, middle.y};
    polygon.set_box({0.5 * length(b - a), 0});
}

bool set_moving_polygon(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    polygon.radius = 0;
    switch (given.kind) {
        case ShapeKind::ball: {
            const DVec<2> center = place_of(given).point(DVec<2>(given.as<Circle>().center));
            set_degenerate_box(center, center, polygon);
            polygon.radius = static_cast<double>(given.as<Circle>().radius);
            return true;
        }
        case ShapeKind::capsule: {
            const Capsule2& capsule = given.as<Capsule2>();
            set_degenerate_box(place_of(given).point(DVec<2>(capsule.a)), place_of(given).point(DVec<2>(capsule.b)),
                               polygon);
            polygon.radius = static_cast<double>(capsule.radius);
            return true;
        }
        case ShapeKind::segment: {
            const Segment2& segment = given.as<Segment2>();
            set_degenerate_box(place_of(given).point(DVec<2>(segment.a)), place_of(given).point(DVec<2>(segment.b)),
                               polygon);
            return true;
        }
        default:
            return set_placed_polygon(given, polygon);
    }
}

ClosedFormAnswer sweep_placed_polygons(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                                       const Vec2& motion_b, std::optional<Hit<2>>& result) {
    PlacedPolygon polygon_a, polygon_b;
    if (!set_moving_polygon(given_a, polygon_a) || !set_moving_polygon(given_b, polygon_b))
        return ClosedFormAnswer::unknown;
    Moving<PlacedPolygonCore> a(given_a.kind, polygon_a, motion_a), b(given_b.kind, polygon_b, motion_b);
    return sweep_moving(a, b, result);
}

inline Double2 center_of(const ShapeRef<2>& given) {
    const Circle& circle = given.as<Circle>();
    if (given.pose == nullptr) return lanes::loaded(&circle.center.x);
    const DVec<2> center = placed<2>(DVec<2>(circle.center), *given.pose);
    return lanes::double2(center.x, center.y);
}

ClosedFormAnswer sweep_circles(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                               const Vec2& motion_b, std::optional<Hit<2>>& result) {
    const double radius_a = static_cast<double>(given_a.as<Circle>().radius),
                 radius_b = static_cast<double>(given_b.as<Circle>().radius);
    const Double2 center = center_of(given_a), moves_a = lanes::loaded(&motion_a.x);
    const Double2 between = center_of(given_b) - center;
    const double far = 2 * (std::abs(between[0]) + std::abs(between[1]) + std::abs(radius_a + radius_b));
    RelativeMotion relative;
    relative.motion = moves_a - lanes::loaded(&motion_b.x);
    relative.length = std::sqrt(lanes::dot(relative.motion, relative.motion)[0]);
    relative.max_fraction = 1;
    relative.radius = radius_a + radius_b;
    relative.tolerances = SweepTolerances({radius_a, 0}, {radius_b, 0}, far);
    const double outside = relative.radius + relative.tolerances.touch;
    if (!(relative.radius > 0 && relative.length > 0 && relative.length < infinity && far < infinity &&
          lanes::dot(between, between)[0] > outside * outside))
        return ClosedFormAnswer::unknown;
    if (!(lanes::dot(between, relative.motion)[0] > 0)) return ClosedFormAnswer::no;
    RoundImpact impact;
    const ClosedFormAnswer found = find_round_impact(between, relative.motion, relative, impact);
    if (found != ClosedFormAnswer::yes) return found;
    const ClosedFormAnswer within_motion = is_within_motion(impact.enters, impact.closing, relative);
    if (within_motion != ClosedFormAnswer::yes) return within_motion;
    const double time = std::min(impact.enters, relative.max_fraction);
    Hit<2>& hit = result.emplace();
    const Double2 point = center + moves_a * lanes::double2(time) + impact.normal * lanes::double2(radius_a);
    write(time, relative, point, impact.normal, hit);
    hit.feature.kind = FeatureKind::vertex;
    return ClosedFormAnswer::yes;
}

}  // namespace

ClosedFormAnswer closed_form_sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b,
                                   const Vec2& motion_b, std::optional<Hit<2>>& result) {
    if (is_polygon(a) && is_polygon(b)) return sweep_cores<PolygonCore>(a, motion_a, b, motion_b, result);
    if (is_box(a) && is_box(b)) return sweep_cores<BoxCore>(a, motion_a, b, motion_b, result);
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::ball) return sweep_circles(a, motion_a, b, motion_b, result);
    return sweep_placed_polygons(a, motion_a, b, motion_b, result);
}

}  // namespace abut::detail
