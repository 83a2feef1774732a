#include <abut/convex/pairs/core_pair2.hpp>
#include <abut/convex/toi/moving_polygon2.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/sweep/tolerances.hpp>

namespace abut::detail {
namespace {

/// A motion that approaches by less than this fraction grazes.
constexpr double min_slope = 1e-6;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The motion of A relative to B, and the tolerances.
struct RelativeMotion {
    Double2 motion;
    double length;
    double max_fraction;  ///< the fraction of the motion up to which they may touch
    double radius;        ///< the sum of both radii
    SweepTolerances tolerances;

    double certain_depth() const { return beyond_sliding * tolerances.slide; }
};

inline bool find_passage(const CorePair<PolygonCore>& pair, const Double2 (&coming)[2], const RelativeMotion& relative,
                         Passage& passage) {
    const Rigid2 places[2] = {rigid(pair.seen_from(0)), rigid(pair.seen_from(1))};
    const DVec<2> directions[2] = {vector_of(coming[0]), vector_of(coming[1])};
    return passage_of_polygons(pair.shape(0).sides(), pair.shape(1).sides(), places, directions, relative.radius,
                               relative.certain_depth(), relative.max_fraction, passage);
}
inline bool find_passage(const CorePair<BoxCore>& pair, const Double2 (&coming)[2], const RelativeMotion& relative,
                         Passage& passage) {
    const Double2 half[2] = {pair.shape(0).half(), pair.shape(1).half()};
    const Double2 place[2] = {pair.seen_from(0).position, pair.seen_from(1).position};
    return passage_of_boxes(half, pair.seen_from(0).turn(), place, coming, relative.radius, relative.certain_depth(),
                            relative.max_fraction, passage);
}

/// Whether two shapes that touch at the time `enters` do so within the motion, if they approach by `closing` per unit
/// of time.
inline PairAnswer is_within_motion(double enters, double closing, const RelativeMotion& relative) {
    if (!(enters * closing > relative.tolerances.touch)) return PairAnswer::unknown;
    const double late = enters - relative.max_fraction;
    if (late * closing > relative.tolerances.touch) return PairAnswer::no;
    // They almost touch at the end, where the closest points are not yet those of the impact.
    return late * relative.length > relative.tolerances.touch ? PairAnswer::unknown : PairAnswer::yes;
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
inline PairAnswer find_round_impact(Double2 between, Double2 motion, const RelativeMotion& relative,
                                    RoundImpact& impact) {
    const double square = lanes::dot(motion, motion)[0], per_square = 1 / square, per_radius = 1 / relative.radius;
    const Double2 crossed = motion * lanes::swapped(between);
    const double across = crossed[0] - crossed[1], ahead = lanes::dot(between, motion)[0];
    const double passes = relative.radius + relative.certain_depth();
    if (across * across > passes * passes * square) {
        impact.normal = lanes::swapped(motion) * lanes::double2(-across, across);
        return PairAnswer::no;
    }
    const double chord = relative.radius * relative.radius * square - across * across;
    if (!(0.5 * chord > relative.tolerances.slide * relative.radius * square)) return PairAnswer::unknown;
    const double half = square_root(chord);
    impact.enters = (ahead - half) * per_square;
    impact.closing = half * per_radius;
    impact.normal = (between - motion * lanes::double2(impact.enters)) * lanes::double2(per_radius);
    return PairAnswer::yes;
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
    EdgeImpact(const CorePair<Core>& pair, const Double2 (&motions)[2], const Passage& passage,
               const RelativeMotion& relative)
        : reference_(pair.shape(passage.of)),
          other_(pair.shape(1 - passage.of)),
          reference_motion_(motions[passage.of]),
          other_motion_(motions[1 - passage.of]),
          passage_(passage),
          relative_(relative) {}

    PairAnswer report(std::optional<Hit<2>>& result) const {
        const Core &reference = reference_, &other = other_;
        const Double2 velocity = other_motion_ - reference_motion_;
        const Double2 out = reference_.place().vector(reference.normal(passage_.side));
        const double closing = -lanes::dot(out, velocity)[0];
        if (!(closing > min_slope * relative_.length)) return PairAnswer::unknown;
        const PairAnswer within_motion = is_within_motion(passage_.enters, closing, relative_);
        if (within_motion != PairAnswer::yes) return within_motion;
        const double time = std::min(passage_.enters, relative_.max_fraction);

        const Double2 offset = other_.place().vector(other_.corner(passage_.corner));
        const Double2 between =
            (other_.place().position - reference_.place().position) + velocity * lanes::double2(time);
        const Double2 local_corner = reference_.place().back(offset + between);
        const EdgeRegion region = reference.voronoi_region(passage_.side, local_corner);
        if (region == EdgeRegion::within) {
            if (relative_.radius > 0 && !enters_balls(closing, relative_)) return PairAnswer::unknown;
            report_at_vertex(time, offset, out, result.emplace());
            return PairAnswer::yes;
        }
        const bool before = region == EdgeRegion::before_start;
        const std::uint32_t end = before ? passage_.side : reference.after(passage_.side);
        const std::uint32_t next = before ? other.before(passage_.corner) : other.after(passage_.corner);
        if (!end_touches(local_corner, end,
                         reference_.place().back(other_.place().vector(other_.corner(next)) + between)))
            return relative_.radius > 0 ? report_round(end, result) : PairAnswer::unknown;
        if (relative_.radius > 0 && !enters_balls(closing, relative_)) return PairAnswer::unknown;
        report_at_end(time, end, next, out, result.emplace());
        return PairAnswer::yes;
    }

private:
    bool a_is_reference() const { return passage_.of == 0; }
    Double2 from_a(Double2 out) const {
        static constexpr double towards_b[2] = {1, -1};
        return out * lanes::double2(towards_b[passage_.of]);
    }
    /// Names the feature of B by its two vertices, or one vertex given twice.
    static void name(const Core& b, std::uint32_t i, std::uint32_t j, Hit<2>& hit) {
        name_end_or_edge(b.number(i), b.number(j), 0, hit.feature);
    }

    void report_at_vertex(double time, Double2 offset, Double2 out, Hit<2>& hit) const {
        const Double2 point = other_.place().position + offset + other_motion_ * lanes::double2(time);
        write(time, relative_, point - out * lanes::double2(other_.radius()), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, passage_.corner, hit);
        else
            name(reference_, passage_.side, reference_.after(passage_.side), hit);
    }

    /// If two faces meet, the vertex found may lie beyond an end of the edge. Then that end touches the edge from the
    /// vertex to the next one.
    bool end_touches(Double2 corner, std::uint32_t end, Double2 next) const {
        const Core& core = reference_;
        const Double2 out = core.normal(passage_.side), along = lanes::swapped(out) * Double2{-1, 1};
        const double corner_along = lanes::dot(along, corner - core.corner(end))[0],
                     next_along = lanes::dot(along, next - core.corner(end))[0];
        const double part = corner_along / (corner_along - next_along), rises = lanes::dot(out, next - corner)[0];
        return part >= 0 && part <= 1 && part * rises <= 0.25 * relative_.tolerances.touch;
    }
    void report_at_end(double time, std::uint32_t end, std::uint32_t next, Double2 out, Hit<2>& hit) const {
        const Double2 point = reference_.place().position + reference_.place().vector(reference_.corner(end)) +
                              reference_motion_ * lanes::double2(time);
        write(time, relative_, point + out * lanes::double2(reference_.radius()), from_a(out), hit);
        if (a_is_reference())
            name(other_, passage_.corner, next, hit);
        else
            name(reference_, end, end, hit);
    }

    /// Beyond the end of an edge the shapes are round around two vertices. The answer is proven if these are the
    /// farthest along the normal: a plane separates the shapes until then, or all the time.
    PairAnswer report_round(std::uint32_t end, std::optional<Hit<2>>& result) const {
        const Double2 end_offset = reference_.place().vector(reference_.corner(end)),
                      corner_offset = other_.place().vector(other_.corner(passage_.corner));
        const Double2 between = (other_.place().position - reference_.place().position) + (corner_offset - end_offset);
        RoundImpact impact;
        const PairAnswer found = find_round_impact(between, reference_motion_ - other_motion_, relative_, impact);
        if (found == PairAnswer::unknown || !reference_.is_farthest(end, reference_.place().back(impact.normal)) ||
            !other_.is_farthest(passage_.corner, other_.place().back(-impact.normal)))
            return PairAnswer::unknown;
        if (found == PairAnswer::no) return found;
        const PairAnswer within_motion = is_within_motion(impact.enters, impact.closing, relative_);
        if (within_motion != PairAnswer::yes) return within_motion;
        const double time = std::min(impact.enters, relative_.max_fraction);
        const Double2 point = reference_.place().position + end_offset + reference_motion_ * lanes::double2(time);
        Hit<2>& hit = result.emplace();
        write(time, relative_, point + impact.normal * lanes::double2(reference_.radius()), from_a(impact.normal), hit);
        const std::uint32_t of_b = a_is_reference() ? passage_.corner : end;
        name(a_is_reference() ? other_ : reference_, of_b, of_b, hit);
        return PairAnswer::yes;
    }

    const Core &reference_, &other_;
    Double2 reference_motion_, other_motion_;
    const Passage& passage_;
    const RelativeMotion& relative_;
};

template <class Core>
PairAnswer sweep_cores(const PlacedPolygon& polygon_a, const PlacedPolygon& polygon_b, const Double2 (&motions)[2],
                       std::optional<Hit<2>>& result) {
    CorePair<Core> pair(polygon_a, polygon_b);
    pair.set_relative_places();
    const Core &a = pair.shape(0), &b = pair.shape(1);
    RelativeMotion relative;
    relative.motion = motions[0] - motions[1];
    relative.length = square_root(lanes::dot(relative.motion, relative.motion)[0]);
    relative.radius = a.radius() + b.radius();
    // Beyond this length of motion nothing can be hit.
    const double far = 2 * (pair.scale() + std::abs(relative.radius));
    if (!(relative.length > 0 && relative.length < infinity && far < infinity)) return PairAnswer::unknown;
    relative.max_fraction = relative.length > far ? far / relative.length : 1;
    relative.tolerances = SweepTolerances({a.extent() + a.radius(), 0}, {b.extent() + b.radius(), 0}, far);
    const Double2 coming[2] = {a.place().back(relative.motion), b.place().back(-relative.motion)};
    Passage passage;
    if (!find_passage(pair, coming, relative, passage)) return PairAnswer::no;
    if (!passage.penetrates()) return PairAnswer::unknown;
    return EdgeImpact<Core>(pair, motions, passage, relative).report(result);
}

PairAnswer sweep_circles(const ShapeRef<2>& given_a, const Vec2& motion_a, const ShapeRef<2>& given_b,
                         const Vec2& motion_b, std::optional<Hit<2>>& result) {
    const double radius_a = static_cast<double>(given_a.as<Circle>().radius),
                 radius_b = static_cast<double>(given_b.as<Circle>().radius);
    const Double2 center = placed_center(given_a), moves_a = lanes::loaded(&motion_a.x);
    const Double2 between = placed_center(given_b) - center;
    const double far = 2 * (std::abs(between[0]) + std::abs(between[1]) + std::abs(radius_a + radius_b));
    RelativeMotion relative;
    relative.motion = moves_a - lanes::loaded(&motion_b.x);
    relative.length = square_root(lanes::dot(relative.motion, relative.motion)[0]);
    relative.max_fraction = 1;
    relative.radius = radius_a + radius_b;
    relative.tolerances = SweepTolerances({radius_a, 0}, {radius_b, 0}, far);
    const double outside = relative.radius + relative.tolerances.touch;
    if (!(relative.radius > 0 && relative.length > 0 && relative.length < infinity && far < infinity &&
          lanes::dot(between, between)[0] > outside * outside))
        return PairAnswer::unknown;
    if (!(lanes::dot(between, relative.motion)[0] > 0)) return PairAnswer::no;
    RoundImpact impact;
    const PairAnswer found = find_round_impact(between, relative.motion, relative, impact);
    if (found != PairAnswer::yes) return found;
    const PairAnswer within_motion = is_within_motion(impact.enters, impact.closing, relative);
    if (within_motion != PairAnswer::yes) return within_motion;
    const double time = std::min(impact.enters, relative.max_fraction);
    Hit<2>& hit = result.emplace();
    const Double2 point = center + moves_a * lanes::double2(time) + impact.normal * lanes::double2(radius_a);
    write(time, relative, point, impact.normal, hit);
    hit.feature.kind = FeatureKind::vertex;
    return PairAnswer::yes;
}

}  // namespace

PairAnswer closed_form_sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                             std::optional<Hit<2>>& result) {
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::ball) return sweep_circles(a, motion_a, b, motion_b, result);
    PlacedPolygon polygon_a, polygon_b;
    if (!set_placed_polygon(a, polygon_a) || !set_placed_polygon(b, polygon_b)) return PairAnswer::unknown;
    const Double2 motions[2] = {lanes::loaded(&motion_a.x), lanes::loaded(&motion_b.x)};
    if (polygon_a.core != PlacedPolygon::Core::polygon && polygon_b.core != PlacedPolygon::Core::polygon)
        return sweep_cores<BoxCore>(polygon_a, polygon_b, motions, result);
    polygon_a.make_rows();
    polygon_b.make_rows();
    return sweep_cores<PolygonCore>(polygon_a, polygon_b, motions, result);
}

}  // namespace abut::detail
