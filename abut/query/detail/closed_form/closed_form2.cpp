#include <abut/convex/pairs/pair2.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/write_answer.hpp>

namespace abut::detail {
namespace {

/// Both shapes as placed polygons.
struct PolygonsOfShapes {
    PlacedPolygon a, b;
    bool known;

    PolygonsOfShapes(const ShapeRef<2>& first, const ShapeRef<2>& second)
        : known(set_placed_polygon(first, a) && set_placed_polygon(second, b)) {}
};

/// Which of A and B is the shape and which the circle.
struct PairOrder {
    std::uint32_t of;  ///< of the shape. 0: A; 1: B

    /// From A to B, from the normal out of the shape.
    Double2 from_a(Double2 out) const {
        static constexpr double towards_b[2] = {1, -1};
        return out * lanes::double2(towards_b[of]);
    }
    template <class T>
    T& of_shape(T& of_a, T& of_b) const {
        return of == 0 ? of_a : of_b;
    }
    template <class T>
    T& of_circle(T& of_a, T& of_b) const {
        return of == 0 ? of_b : of_a;
    }
    std::uint32_t contact_feature(std::uint32_t corner_name) const { return corner_name << 8 * (1 - of); }
    template <class Core, class Answer>
    void name_features(const Core& core, const PointFeatures2& found, Answer& answer) const {
        name_end_or_edge(core.number(found.first), core.number(found.second), 0,
                         of_shape(answer.feature_a, answer.feature_b));
        of_circle(answer.feature_a, answer.feature_b).kind = FeatureKind::vertex;
    }
};

/// A circle and another shape, which may be a circle as well.
class CircleAndShape {
public:
    CircleAndShape(const ShapeRef<2>& a, const ShapeRef<2>& b)
        : of_(b.kind == ShapeKind::ball ? 0 : 1), shape_(of_ == 0 ? a : b), circle_(of_ == 0 ? b : a) {}

    static bool exists(const ShapeRef<2>& a, const ShapeRef<2>& b) {
        return a.kind == ShapeKind::ball || b.kind == ShapeKind::ball;
    }

    /// Calls writer.write(order, core, point, closest features) if the distance is at most `reach`.
    template <class Writer>
    [[gnu::always_inline]] PairAnswer closest(double reach, const Writer& writer) const {
        const Circle& circle = circle_.as<Circle>();
        Double2 center = lanes::loaded(&circle.center.x);
        if (circle_.pose != nullptr) center = lane_pose(*circle_.pose).point(center);
        const double radius = static_cast<double>(circle.radius);
        if (shape_.kind != ShapeKind::polytope) return closest_of_other(shape_, of_, center, radius, reach, writer);
        const Polygon& own = shape_.as<Polygon>();
        if (own.sides() == nullptr) return PairAnswer::unknown;
        const Pose2& pose = pose_or_none(shape_.pose);
        const ScaledTurn turn(pose.rotation);
        PlacedPolygon polygon;
        polygon.radius = 0;
        polygon.place.position = lanes::loaded(&pose.position.x);
        polygon.place.set_turn(turn.turn);
        const Double2 local = polygon.place.back(center - polygon.place.position);
        polygon.place.set_turn(turn.unit_turn());
        polygon.set_rows(own.sides(), own.side_count());
        return closest_to(ListedCore(polygon), {center, radius, {local, turn.scale}}, of_, reach, writer);
    }

private:
    template <class Core, class Writer>
    [[gnu::always_inline]] static PairAnswer closest_to(const Core& core, const RoundPoint& point, std::uint32_t of,
                                                        double reach, const Writer& writer) {
        PointFeatures2 found;
        const PairAnswer answer = closest_to_point(core, point, reach, found);
        if (answer == PairAnswer::yes) writer.write(PairOrder{of}, core, point, found);
        return answer;
    }
    template <class Writer>
    [[gnu::noinline]] static PairAnswer closest_of_other(const ShapeRef<2>& given, std::uint32_t of, Double2 center,
                                                         double radius, double reach, Writer writer) {
        PlacedPolygon shape;
        if (!set_placed_polygon(given, shape)) return PairAnswer::unknown;
        return with_core(shape, center, radius, [&](const auto& core, const RoundPoint& point) {
            return closest_to(core, point, of, reach, writer);
        });
    }

    std::uint32_t of_;
    const ShapeRef<2>&shape_, &circle_;
};

struct OverlapWriter {
    template <class Core>
    void write(const PairOrder&, const Core&, const RoundPoint&, const PointFeatures2&) const {}
};

struct ClosestWriter {
    Closest<2>& result;

    template <class Core>
    [[gnu::always_inline]] void write(const PairOrder& order, const Core& core, const RoundPoint& point,
                                      const PointFeatures2& found) const {
        result.distance = static_cast<float>(found.gap - core.radius() - point.radius);
        lanes::store(order.from_a(found.normal), &result.normal.x);
        lanes::store(found.on_core(core, point.center) + found.normal * lanes::double2(core.radius()),
                     &order.of_shape(result.on_a, result.on_b).x);
        lanes::store(point.center - found.normal * lanes::double2(point.radius),
                     &order.of_circle(result.on_a, result.on_b).x);
        order.name_features(core, found, result);
    }
};

struct ContactWriter {
    Contact<2>& result;

    template <class Core>
    [[gnu::always_inline]] void write(const PairOrder& order, const Core& core, const RoundPoint& point,
                                      const PointFeatures2& found) const {
        const double depth = core.radius() + point.radius - found.gap;
        const Double2 position = found.midway(point.center, point.radius, depth);
        lanes::store(order.from_a(found.normal), &result.normal.x);
        result.depth = static_cast<float>(depth);
        result.points.push_back({{static_cast<float>(position[0]), static_cast<float>(position[1])},
                                 static_cast<float>(depth),
                                 order.contact_feature(found.corner_name(core))});
        order.name_features(core, found, result);
    }
};

template <class Answer>
void name_features(const ClosestFeatures2& closest, Answer& answer) {
    name_end_or_edge(closest.corners[0][0], closest.corners[0][1], 0, answer.feature_a);
    name_end_or_edge(closest.corners[1][0], closest.corners[1][1], 0, answer.feature_b);
}

}  // namespace

PairAnswer closed_form_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    if (CircleAndShape::exists(a, b)) return CircleAndShape(a, b).closest(0, OverlapWriter());
    PolygonsOfShapes polygons(a, b);
    if (!polygons.known) return PairAnswer::unknown;
    return pair2_within(polygons.a, polygons.b, 0, cache);
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

// Out of line, to keep the fast path small.

[[gnu::noinline]] void closest_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Closest<2>& result) {
    result = closest(convex_of(a), convex_of(b), options);
}
[[gnu::noinline]] void contact_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    result = contact(convex_of(a), convex_of(b), options);
}

// The results are written in place: a copy right after the writes would stall. Each kind of pair has a function of its
// own, so that each saves only its own registers.

[[gnu::noinline]] Closest<2> closest_of_circle(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                               const QueryOptions<2>& options) {
    Closest<2> result;
    const PairAnswer answer =
        CircleAndShape(a, b).closest(std::numeric_limits<double>::infinity(), ClosestWriter{result});
    if (answer == PairAnswer::unknown) closest_of_views(a, b, options, result);
    return result;
}
[[gnu::noinline]] Contact<2> contact_of_circle(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                               const QueryOptions<2>& options) {
    Contact<2> result = no_contact<2>();
    const PairAnswer answer = CircleAndShape(a, b).closest(static_cast<double>(options.margin), ContactWriter{result});
    if (answer == PairAnswer::unknown) contact_of_views(a, b, options, result);
    return result;
}
[[gnu::noinline]] Closest<2> closest_of_cores(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                              const QueryOptions<2>& options) {
    Closest<2> result;
    PolygonsOfShapes polygons(a, b);
    ClosestFeatures2 found;
    if (options.trace == nullptr && polygons.known &&
        pair2_closest(polygons.a, polygons.b, options.cache, found) != PairAnswer::unknown) {
        const Double2 out = found.from_a();
        result.distance = static_cast<float>(found.gap - polygons.a.radius - polygons.b.radius);
        lanes::store(out, &result.normal.x);
        lanes::store(found.on_a() + out * lanes::double2(polygons.a.radius), &result.on_a.x);
        lanes::store(found.on_b() - out * lanes::double2(polygons.b.radius), &result.on_b.x);
        name_features(found, result);
    } else {
        closest_of_views(a, b, options, result);
    }
    return result;
}
[[gnu::noinline]] Contact<2> contact_of_cores(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                              const QueryOptions<2>& options) {
    Contact<2> result = no_contact<2>();
    PolygonsOfShapes polygons(a, b);
    ClosestFeatures2 found;
    ContactLanes points;
    const double margin = static_cast<double>(options.margin);
    const PairAnswer answer = options.trace != nullptr || !polygons.known
                                  ? PairAnswer::unknown
                                  : pair2_contact(polygons.a, polygons.b, margin, margin, options.cache, found, points);
    if (answer == PairAnswer::unknown) contact_of_views(a, b, options, result);
    if (answer == PairAnswer::yes) {
        lanes::store(found.from_a(), &result.normal.x);
        result.depth = static_cast<float>(polygons.a.radius + polygons.b.radius - found.gap);
        for (std::uint32_t i = 0; i < 2; ++i)
            if ((points.mask >> i & 1u) != 0)
                result.points.push_back({{static_cast<float>(points.x[i]), static_cast<float>(points.y[i])},
                                         static_cast<float>(points.depth[i]),
                                         points.features[i]});
        name_features(found, result);
    }
    return result;
}

}  // namespace

template <>
Closest<2> closest(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    const bool circle = CircleAndShape::exists(a, b) && options.trace == nullptr;
    return circle ? closest_of_circle(a, b, options) : closest_of_cores(a, b, options);
}

template <>
Contact<2> contact(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    const bool circle = CircleAndShape::exists(a, b) && options.trace == nullptr;
    return circle ? contact_of_circle(a, b, options) : contact_of_cores(a, b, options);
}

}  // namespace abut
