#include <abut/convex/pairs/box3.hpp>
#include <abut/convex/pairs/box_point-inl.h>
#include <abut/convex/pairs/round3.hpp>
#include <abut/convex/pairs/round3_simd-inl.h>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/simd/rotation-inl.h>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <bit>

namespace abut::detail {
namespace {

/// Tests the bits, in parallel to the floating point work.
inline bool is_finite(float number) {
    return std::bit_cast<std::uint32_t>(number) << 1 < 0xff000000u;
}

/// The corners, edges and faces of a box, by two sets of bits: the fixed axes, plus 8 times the fixed axes at their low
/// end.
constexpr std::array<Feature, 64> box_features = [] {
    std::array<Feature, 64> result{};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t fixed = i & 7u, low = i >> 3 & fixed;
        const int count = std::popcount(fixed);
        if (count == 1) result[i] = {0, (fixed & 6u) + (low != 0 ? 1u : 0u), FeatureKind::face};
        if (count == 2) result[i] = {0, edge_index(low, low | (fixed ^ 7u)), FeatureKind::edge};
        if (count == 3) result[i] = {0, low, FeatureKind::vertex};
    }
    return result;
}();

/// Indexed by the location on a segment.
constexpr Feature segment_features[3] = {
    {0, 0, FeatureKind::vertex}, {0, edge_index(0, 1), FeatureKind::edge}, {0, 1, FeatureKind::vertex}};

inline bool closest_of_segments(const SegmentPair& pair, Closest<3>& result) {
    SegmentClosest closest;
    if (!closest_on_segments(pair, closest)) return false;
    result.distance = static_cast<float>(closest.distance[0]);
    lanes::store(closest.normal, result.normal);
    lanes::store(closest.on_a, result.on_a);
    lanes::store(closest.on_a + closest.normal * closest.distance, result.on_b);
    result.feature_a = segment_features[closest.place_a];
    result.feature_b = segment_features[closest.place_b];
    return true;
}

/// The end points, placed like `convex(capsule, pose)`.
SegmentPair placed_segments_of(const ShapeRef<3>& a, const ShapeRef<3>& b) {
    const Capsule3 &first = a.as<Capsule3>(), &second = b.as<Capsule3>();
    Affine<3> place_a, place_b;
    if (a.pose != nullptr) set_affine(place_a, *a.pose);
    if (b.pose != nullptr) set_affine(place_b, *b.pose);
    return {lanes::double3(place_a.point(DVec<3>(first.a))),
            lanes::double3(place_a.point(DVec<3>(first.b))),
            lanes::double3(place_b.point(DVec<3>(second.a))),
            lanes::double3(place_b.point(DVec<3>(second.b))),
            lanes::loaded_twice(first.radius),
            lanes::loaded_twice(second.radius)};
}
[[gnu::noinline]] bool closest_of_placed_capsules(const ShapeRef<3>& a, const ShapeRef<3>& b, Closest<3>& result) {
    return is_finite(a.as<Capsule3>().radius) && is_finite(b.as<Capsule3>().radius) &&
           closest_of_segments(placed_segments_of(a, b), result);
}

bool closest_of_capsules(const ShapeRef<3>& a, const ShapeRef<3>& b, Closest<3>& result) {
    if (a.pose != nullptr || b.pose != nullptr) return closest_of_placed_capsules(a, b, result);
    const Capsule3 &first = a.as<Capsule3>(), &second = b.as<Capsule3>();
    if (!is_finite(first.radius) || !is_finite(second.radius)) return false;
    return closest_of_segments(
        {lanes::loaded(first.a), lanes::loaded(first.b), lanes::loaded(second.a), lanes::loaded(second.b),
         lanes::loaded_twice(first.radius), lanes::loaded_twice(second.radius)},
        result);
}

inline DVec<3> center_of(const ShapeRef<3>& ball) {
    const DVec<3> center(ball.as<Sphere>().center);
    return ball.pose == nullptr ? center : placed<3>(center, *ball.pose);
}

bool closest_of_balls(const ShapeRef<3>& a, const ShapeRef<3>& b, Closest<3>& result) {
    SignedDistance<3> distance;
    distance_of_points(center_of(a), static_cast<double>(a.as<Sphere>().radius), center_of(b),
                       static_cast<double>(b.as<Sphere>().radius), distance);
    if (!std::isfinite(distance.distance)) return false;
    write(distance, result);
    result.feature_a.kind = result.feature_b.kind = FeatureKind::vertex;
    return true;
}

/// Out of line, to keep the fast path small.
[[gnu::noinline]] void place_by(const Box3& box, const Pose3& pose, Affine<3>& place) {
    place = convex(box, pose).place;
}
inline void set_place(const Box3& box, const Pose3* pose, Affine<3>& place) {
    if (pose == nullptr)
        set_affine(place, Pose3{box.center, box.rotation});
    else
        place_by(box, *pose, place);
}

/// A sum that is finite only if all its terms are.
double sum_of(const DVec<3>& v) {
    return v.x + v.y + v.z;
}

/// `on_box` and `normal` go from the box to the ball; the distance is in both lanes.
inline void write(const lanes::Double3& on_box, const lanes::Double3& normal, lanes::Double2 distance,
                  std::size_t place, bool ball_is_a, Closest<3>& result) {
    using namespace lanes;
    const Double3 on_ball = on_box + normal * distance;
    const Feature& feature = box_features[place];
    result.distance = static_cast<float>(distance[0]);
    if (ball_is_a) {
        store(normal * double2(-1), result.normal);
        store(on_ball, result.on_a);
        store(on_ball - normal * distance, result.on_b);
        result.feature_a.kind = FeatureKind::vertex;
        result.feature_b = feature;
    } else {
        store(normal, result.normal);
        store(on_box, result.on_a);
        store(on_ball, result.on_b);
        result.feature_a = feature;
        result.feature_b.kind = FeatureKind::vertex;
    }
}
inline std::size_t place_of(const BoxClosestPoint& place) {
    return place.fixed + 8 * place.low;
}

/// For shapes with poses, or a ball whose centre is in the box.
[[gnu::noinline]] bool closest_of_any_ball_and_box(const ShapeRef<3>& ball, const ShapeRef<3>& box_given,
                                                   bool ball_is_a, Closest<3>& result) {
    const Box3& box = box_given.as<Box3>();
    Affine<3> place;
    set_place(box, box_given.pose, place);
    const DVec<3> center = center_of(ball), half(box.half), local = place.transposed(center - place.offset);
    const double radius = static_cast<double>(ball.as<Sphere>().radius);
    if (!std::isfinite(sum_of(local) + sum_of(half) + radius)) return false;
    BoxClosestPoint nearest;
    const bool outside = nearest_from_outside(lanes::double3(half), lanes::double3(local), nearest);
    if (!outside) nearest_from_inside(half, local, nearest);
    const DVec<3> offset = place.vector(lanes::vector(nearest.offset));
    const DVec<3> on_box = center - (outside ? offset : offset * nearest.distance[0]);
    write(lanes::double3(on_box), lanes::double3(offset) * nearest.per_length,
          nearest.distance - lanes::double2(radius), place_of(nearest), ball_is_a, result);
    return true;
}

bool closest_of_ball_and_box(const ShapeRef<3>& ball_given, const ShapeRef<3>& box_given, bool ball_is_a,
                             Closest<3>& result) {
    using namespace lanes;
    const Sphere& ball = ball_given.as<Sphere>();
    const Box3& box = box_given.as<Box3>();
    if (ball_given.pose == nullptr && box_given.pose == nullptr && is_finite(ball.radius) && is_finite(box.half.x) &&
        is_finite(box.half.y) && is_finite(box.half.z)) {
        const Double3 center = loaded(ball.center), half = loaded(box.half);
        const Turned turn = turned(box.rotation);
        BoxClosestPoint nearest;
        if (nearest_from_outside(half, turn.transposed(center - loaded(box.center)), nearest)) {
            const Double3 offset = turn.vector(nearest.offset);
            write(center - offset, offset * nearest.per_length, nearest.distance - loaded_twice(ball.radius),
                  place_of(nearest), ball_is_a, result);
            return true;
        }
    }
    return closest_of_any_ball_and_box(ball_given, box_given, ball_is_a, result);
}

bool are_boxes(const ShapeRef<3>& a, const ShapeRef<3>& b) {
    return a.kind == ShapeKind::box && b.kind == ShapeKind::box;
}

inline PlacedBox placed_box(const ShapeRef<3>& given) {
    const Box3& box = given.as<Box3>();
    if (given.pose == nullptr) return {box.center, box.half, box.rotation};
    Affine<3> place;
    place_by(box, *given.pose, place);
    return {place, 1, box.half};
}

template <class Answer>
void write_box_features(const BoxClosest& closest, Answer& result) {
    result.feature_a = box_features[(closest.part_a.free ^ 7u) + 8 * closest.part_a.low];
    result.feature_b = box_features[(closest.part_b.free ^ 7u) + 8 * closest.part_b.low];
}

bool closest_of_boxes(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result) {
    BoxesDistance boxes;
    if (distance_of_boxes(placed_box(a), placed_box(b), cache, boxes) == BoxAnswer::unknown) return false;
    write(boxes.distance, result);
    write_box_features(boxes.closest, result);
    return true;
}

bool contact_of_boxes(const ShapeRef<3>& a, const ShapeRef<3>& b, double margin, Cache* cache, Contact<3>& result) {
    BoxesDistance boxes;
    Manifold<3> points;
    const BoxAnswer answer = contact_of_boxes(placed_box(a), placed_box(b), margin, margin, cache, boxes, points);
    if (answer == BoxAnswer::yes) {
        write(boxes.distance, points, result);
        write_box_features(boxes.closest, result);
    }
    return answer != BoxAnswer::unknown;
}

/// A ball around a shape, by its radius, or by its square alone if the radius would take a root; and a sum that is
/// finite only if all numbers are.
struct BallAround {
    DVec<3> center;
    double radius, square, sum;
    bool has_radius;
};

double sum_of(const glm::quat& q) {
    return static_cast<double>(q.w + q.x + q.y + q.z);
}

void set_radius(BallAround& ball, const DVec<3>& center, double radius) {
    ball.center = center;
    ball.radius = radius;
    ball.square = radius * radius;
    ball.sum = 0;
    ball.has_radius = true;
}

/// For boxes, spheres and polyhedra.
bool set_ball(const ShapeRef<3>& given, BallAround& ball) {
    if (given.kind == ShapeKind::box) {
        const Box3& box = given.as<Box3>();
        ball.center = DVec<3>(box.center);
        ball.has_radius = false;
        ball.square = length_squared(DVec<3>(box.half));
        ball.sum = sum_of(box.rotation);
    } else if (given.kind == ShapeKind::polytope) {
        const BoundingBall<3> own = given.as<Polyhedron>().ball();
        set_radius(ball, own.center, own.radius);
    } else if (given.kind == ShapeKind::ball) {
        const Sphere& sphere = given.as<Sphere>();
        set_radius(ball, DVec<3>(sphere.center), static_cast<double>(sphere.radius));
    } else {
        return false;
    }
    if (given.pose != nullptr) {
        ball.center = placed<3>(ball.center, *given.pose);
        ball.sum += sum_of(given.pose->rotation);
    }
    return true;
}

/// Whether the bounding spheres are farther apart than `reach`, which rejects most pairs at once.
bool bounding_balls_apart(const ShapeRef<3>& a, const ShapeRef<3>& b, double reach) {
    BallAround first{}, second{};
    if (!(reach >= 0) || !set_ball(a, first) || !set_ball(b, second)) return false;
    // (r + s)^2 is at most 2 (r^2 + s^2), and (r + s + t)^2 at most 3 (r^2 + s^2 + t^2).
    const double radii = first.radius + second.radius + reach;
    const double max_square = first.has_radius && second.has_radius
                                  ? radii * radii
                                  : (first.square + second.square + reach * reach) * (reach == 0 ? 2 : 3);
    const double square = length_squared(second.center - first.center);
    return square > max_square * (1 + 1e-12) && std::isfinite(square + (first.sum + second.sum));
}

}  // namespace

ClosedFormAnswer closed_form_overlap(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache) {
    if (are_boxes(a, b)) {
        const BoxAnswer answer = boxes_within(placed_box(a), placed_box(b), 0, cache);
        if (answer != BoxAnswer::unknown)
            return answer == BoxAnswer::yes ? ClosedFormAnswer::yes : ClosedFormAnswer::no;
    }
    return bounding_balls_apart(a, b, 0) ? ClosedFormAnswer::no : ClosedFormAnswer::unknown;
}

bool closed_form_closest(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result) {
    if (a.kind == ShapeKind::capsule && b.kind == ShapeKind::capsule) return closest_of_capsules(a, b, result);
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::ball) return closest_of_balls(a, b, result);
    if (a.kind == ShapeKind::ball && b.kind == ShapeKind::box) return closest_of_ball_and_box(a, b, true, result);
    if (a.kind == ShapeKind::box && b.kind == ShapeKind::ball) return closest_of_ball_and_box(b, a, false, result);
    return are_boxes(a, b) && closest_of_boxes(a, b, cache, result);
}

bool closed_form_contact(const ShapeRef<3>& a, const ShapeRef<3>& b, double margin, Cache* cache, Contact<3>& result) {
    if (are_boxes(a, b)) return contact_of_boxes(a, b, margin, cache, result);
    return bounding_balls_apart(a, b, margin);
}

}  // namespace abut::detail
