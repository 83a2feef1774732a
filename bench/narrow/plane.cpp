// 2D: distances, overlap tests, contacts and intersections.

#include "narrow.hpp"
#include <abut/query/intersection.hpp>

namespace abut::bench {

namespace {

constexpr Gaps apart{0.01, 1}, mixed{-0.3, 0.3}, shallow{-0.03, -0.01}, deep{-0.3, -0.1};

inline constexpr Kind<Polygon> octagons{[](oracle::Random& random) { return scenes::random_polygon(random, 8); },
                                        pair_count};

template <class S>
Job closest_with(const ConvexPairs<2>& scene, Frames frames) {
    return job(scene, {abut_closest<S, S>(scene), box2d_closest(scene, frames)});
}
template <class S>
Job closest_apart(const Kind<S>& kind) {
    return closest_with<S>(resting(kind, kind, apart), Frames::unlike);
}
template <class S>
Job closest_coherent(const Kind<S>& kind) {
    return closest_with<S>(moving(kind, kind, always_apart), Frames::coherent);
}

template <class S>
Job overlap_of(const Kind<S>& kind, const Gaps& gaps) {
    const ConvexPairs<2> scene = resting(kind, kind, gaps);
    return job(scene, {abut_overlaps<S, S>(scene), box2d_overlaps(scene)});
}

/// Box2D misses one contact of 65,536.
template <class S>
Job contact_with(const ConvexPairs<2>& scene) {
    return job(scene, {abut_contact<S, S>(scene), straying(box2d_contact_of_polygons(scene), 2e-5)});
}
template <class S>
Job contact_at(const Kind<S>& kind, const Gaps& gaps, std::size_t count = pair_count) {
    return contact_with<S>(resting(kind, kind, gaps, count));
}
template <class S>
Job contact_moving(const Kind<S>& kind, const Course& course) {
    return contact_with<S>(moving(kind, kind, course));
}
Job polygon_and_circle_at(const Gaps& gaps, std::size_t count = pair_count) {
    const ConvexPairs<2> scene = resting(polygons, circles, gaps, count);
    return job(scene, {abut_contact<Polygon, Circle>(scene), box2d_contact_of_polygon_and_circle(scene)});
}

/// The area of the intersection.
Job intersection_of_polygons() {
    const ConvexPairs<2> scene = resting(octagons, octagons, mixed);
    const Side ours = abut_side<Polygon, Polygon>(
        scene, [out = Polygon()](const auto& a, const auto& b, const auto& options) mutable -> double {
            return intersection(a, b, out, options) ? out.area() : 0;
        });
    return job(scene, {ours});
}

}  // namespace

std::vector<Bench> plane_benches() {
    return {
        {"narrow/closest/box2-box2/apart", [] { return closest_apart(boxes<2>); }},
        {"narrow/closest/box2-box2/coherent", [] { return closest_coherent(boxes<2>); }},
        {"narrow/closest/polygon3-8/apart", [] { return closest_apart(polygons); }},
        {"narrow/closest/polygon3-8/coherent", [] { return closest_coherent(polygons); }},
        {"narrow/overlaps/box2-box2/apart", [] { return overlap_of(boxes<2>, apart); }},
        {"narrow/overlaps/box2-box2/mixed", [] { return overlap_of(boxes<2>, mixed); }},
        {"narrow/overlaps/box2-box2/deep", [] { return overlap_of(boxes<2>, deep); }},
        {"narrow/overlaps/polygon3-8/apart", [] { return overlap_of(polygons, apart); }},
        {"narrow/overlaps/polygon3-8/mixed", [] { return overlap_of(polygons, mixed); }},
        {"narrow/overlaps/polygon3-8/deep", [] { return overlap_of(polygons, deep); }},
        {"narrow/contact/polygon3-8-circle/shallow", [] { return polygon_and_circle_at(shallow); }},
        {"narrow/contact/polygon3-8-circle/mixed", [] { return polygon_and_circle_at(mixed); }},
        {"narrow/contact/polygon3-8-circle/shallow-many", [] { return polygon_and_circle_at(shallow, many); }},
        {"narrow/contact/polygon3-8-circle/mixed-many", [] { return polygon_and_circle_at(mixed, many); }},
        {"narrow/contact/box2-box2/shallow", [] { return contact_at(boxes<2>, shallow); }},
        {"narrow/contact/box2-box2/deep", [] { return contact_at(boxes<2>, deep); }},
        {"narrow/contact/box2-box2/coherent-touching", [] { return contact_moving(boxes<2>, touching); }},
        {"narrow/contact/box2-box2/coherent-apart", [] { return contact_moving(boxes<2>, mostly_apart); }},
        {"narrow/contact/polygon3-8/shallow", [] { return contact_at(polygons, shallow); }},
        {"narrow/contact/polygon3-8/shallow-many", [] { return contact_at(polygons, shallow, many); }},
        {"narrow/contact/polygon3-8/deep", [] { return contact_at(polygons, deep); }},
        {"narrow/contact/polygon3-8/coherent-touching", [] { return contact_moving(polygons, touching); }},
        {"narrow/contact/polygon3-8/coherent-apart", [] { return contact_moving(polygons, mostly_apart); }},
        {"narrow/intersection/polygon8", intersection_of_polygons},
    };
}

}  // namespace abut::bench
