#include <abut/convex/pairs/pair2.hpp>
#include <abut/math/simd/compiler-inl.h>
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

/// A circle and another shape, which may be a circle as well. The shape is A if `of` is 0, and B if it is 1.
template <std::uint32_t of>
struct CircleAndShape {
    template <class T>
    static T& of_shape(T& of_a, T& of_b) {
        return of == 0 ? of_a : of_b;
    }
    template <class T>
    static T& of_circle(T& of_a, T& of_b) {
        return of == 0 ? of_b : of_a;
    }
    /// From A to B, from the normal out of the shape.
    static Double2 from_a(Double2 out) { return of == 0 ? out : -out; }
    static std::uint32_t contact_feature(std::uint32_t corner_name) { return corner_name << 8 * (1 - of); }
    template <class Core, class Answer>
    static void name_features(const Core& core, const PointFeatures2& found, Answer& answer) {
        name_end_or_edge(core.number(found.first), core.number(found.second), 0,
                         of_shape(answer.feature_a, answer.feature_b));
        of_circle(answer.feature_a, answer.feature_b).kind = FeatureKind::vertex;
    }

    /// Calls writer.write(*this, core, point, closest features) if the distance is at most `reach`. `kind` is that of
    /// the shape.
    template <ShapeKind kind, class Writer>
    [[gnu::always_inline]] static PairAnswer closest(const ShapeRef<2>& a, const ShapeRef<2>& b, double reach,
                                                     const Writer& writer) {
        const ShapeRef<2>& circle = of_circle(a, b);
        const Double2 center = placed_center(circle);
        const double radius = static_cast<double>(circle.as<Circle>().radius);
        const auto query = [&](const auto& core, const ScaledPoint& local) ABUT_INLINE_LAMBDA {
            const RoundPoint point{center, radius, local};
            PointFeatures2 found;
            const PairAnswer answer = closest_to_point(core, point, reach, found);
            if (answer == PairAnswer::yes) writer.write(CircleAndShape(), core, point, found);
            return answer;
        };
        return with_core<kind>(of_shape(a, b), center, query);
    }
};

/// If one of the shapes is a circle, calls query<of, kind>() with the kind of the other. `triangle` stands for the rare
/// kinds.
template <class Query, class Otherwise>
[[gnu::always_inline]] inline auto with_circle(const ShapeRef<2>& a, const ShapeRef<2>& b, const Query& query,
                                               const Otherwise& otherwise) {
    using enum ShapeKind;
    const auto with_kind = [&]<std::uint32_t of>(ShapeKind kind) ABUT_INLINE_LAMBDA {
        switch (kind) {
            case polytope:
                return query.template operator()<of, polytope>();
            case box:
                return query.template operator()<of, box>();
            default:
                return query.template operator()<of, triangle>();
        }
    };
    if (b.kind == ball)
        return a.kind == ball ? query.template operator()<0, ball>() : with_kind.template operator()<0>(a.kind);
    return a.kind == ball ? with_kind.template operator()<1>(b.kind) : otherwise();
}

struct OverlapWriter {
    template <class Order, class Core>
    void write(Order, const Core&, const RoundPoint&, const PointFeatures2&) const {}
};

struct ClosestWriter {
    Closest<2>& result;

    template <class Order, class Core>
    [[gnu::always_inline]] void write(Order order, const Core& core, const RoundPoint& point,
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

    template <class Order, class Core>
    [[gnu::always_inline]] void write(Order order, const Core& core, const RoundPoint& point,
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
    return with_circle(
        a, b,
        [&]<std::uint32_t of, ShapeKind kind>() {
            return CircleAndShape<of>::template closest<kind>(a, b, 0, OverlapWriter());
        },
        [&] {
            PolygonsOfShapes polygons(a, b);
            return polygons.known ? pair2_within(polygons.a, polygons.b, 0, cache) : PairAnswer::unknown;
        });
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

/// The closest points of two shapes, as a question.
struct ClosestQuestion {
    using Answer = Closest<2>;
    using Writer = ClosestWriter;

    static Answer none() { return {}; }
    static double reach(const QueryOptions<2>&) { return std::numeric_limits<double>::infinity(); }
    // Out of line, to keep the fast path small.
    [[gnu::noinline]] static void of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                           Answer& result) {
        result = closest(convex_of(a), convex_of(b), options);
    }
    static PairAnswer of_polygons(PolygonsOfShapes& polygons, const QueryOptions<2>& options, Answer& result) {
        ClosestFeatures2 found;
        const PairAnswer answer = pair2_closest(polygons.a, polygons.b, options.cache, found);
        if (answer == PairAnswer::unknown) return answer;
        const Double2 out = found.from_a();
        result.distance = static_cast<float>(found.gap - polygons.a.radius - polygons.b.radius);
        lanes::store(out, &result.normal.x);
        lanes::store(found.on_a() + out * lanes::double2(polygons.a.radius), &result.on_a.x);
        lanes::store(found.on_b() - out * lanes::double2(polygons.b.radius), &result.on_b.x);
        name_features(found, result);
        return answer;
    }
};

struct ContactQuestion {
    using Answer = Contact<2>;
    using Writer = ContactWriter;

    static Answer none() { return no_contact<2>(); }
    static double reach(const QueryOptions<2>& options) { return static_cast<double>(options.margin); }
    [[gnu::noinline]] static void of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                           Answer& result) {
        result = contact(convex_of(a), convex_of(b), options);
    }
    static PairAnswer of_polygons(PolygonsOfShapes& polygons, const QueryOptions<2>& options, Answer& result) {
        ClosestFeatures2 found;
        ContactLanes points;
        const double margin = reach(options);
        const PairAnswer answer = pair2_contact(polygons.a, polygons.b, margin, margin, options.cache, found, points);
        if (answer != PairAnswer::yes) return answer;
        lanes::store(found.from_a(), &result.normal.x);
        result.depth = static_cast<float>(polygons.a.radius + polygons.b.radius - found.gap);
        for (std::uint32_t i = 0; i < 2; ++i)
            if ((points.mask >> i & 1u) != 0)
                result.points.push_back({{static_cast<float>(points.x[i]), static_cast<float>(points.y[i])},
                                         static_cast<float>(points.depth[i]),
                                         points.features[i]});
        name_features(found, result);
        return answer;
    }
};

// The results are written in place: a copy right after the writes would stall. Each kind of pair has a function of its
// own, so that each saves only its own registers.

template <class Question, std::uint32_t of, ShapeKind kind>
[[gnu::noinline]] typename Question::Answer answer_of_circle(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                                             const QueryOptions<2>& options) {
    typename Question::Answer result = Question::none();
    const PairAnswer answer =
        CircleAndShape<of>::template closest<kind>(a, b, Question::reach(options), typename Question::Writer{result});
    if (answer == PairAnswer::unknown) Question::of_views(a, b, options, result);
    return result;
}
template <class Question>
[[gnu::noinline]] typename Question::Answer answer_of_cores(const ShapeRef<2>& a, const ShapeRef<2>& b,
                                                            const QueryOptions<2>& options) {
    typename Question::Answer result = Question::none();
    PolygonsOfShapes polygons(a, b);
    if (options.trace != nullptr || !polygons.known ||
        Question::of_polygons(polygons, options, result) == PairAnswer::unknown)
        Question::of_views(a, b, options, result);
    return result;
}
template <class Question>
typename Question::Answer answer_of(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    const auto of_cores = [&] { return answer_of_cores<Question>(a, b, options); };
    if (options.trace != nullptr) return of_cores();
    return with_circle(
        a, b, [&]<std::uint32_t of, ShapeKind kind>() { return answer_of_circle<Question, of, kind>(a, b, options); },
        of_cores);
}

}  // namespace

template <>
Closest<2> closest(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    return answer_of<ClosestQuestion>(a, b, options);
}

template <>
Contact<2> contact(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    return answer_of<ContactQuestion>(a, b, options);
}

}  // namespace abut
