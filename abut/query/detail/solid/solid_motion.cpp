#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/solid/convex_depth.hpp>
#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/query/detail/solid/solid_motion.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/shape/ball.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

constexpr int max_advances = 64;

/// A motion of at most this slope relative to the normal slides.
constexpr double slide_slope = 1e-6;

/// A hit of shapes that overlap at the start and go further in.
Hit<3> hit_inside(const Closest<3>& nearest) {
    Hit<3> hit;
    hit.point = to_float((DVec<3>(nearest.on_a) + DVec<3>(nearest.on_b)) * 0.5);
    hit.normal = -nearest.normal;
    hit.started_inside = true;
    hit.feature = nearest.feature_b;
    return hit;
}

}  // namespace

std::optional<Hit<3>> sweep_solid(const View<3>& a, const View<3>& b, double max_speed, double length,
                                  FunctionRef<Closest<3>(double time)> closest_at,
                                  FunctionRef<double(const Closest<3>& nearest)> closing,
                                  FunctionRef<std::optional<Hit<3>>(double time)> surface_hit) {
    if (!overlaps(bounds(a), bounds(b)) || !(max_speed > 0)) return surface_hit(0);
    const Closest<3> nearest = closest_at(0);
    const double tolerance = solid_tolerance(a, b);
    double depth = -static_cast<double>(nearest.distance), time = 0;
    if (!(depth > tolerance)) return surface_hit(0);
    if (closing(nearest) > slide_slope * max_speed) return hit_inside(nearest);
    for (int i = 0; i < max_advances && depth > tolerance && time < 1; ++i) {
        time += depth / max_speed;
        if (time < 1) depth = -static_cast<double>(closest_at(time).distance);
    }
    if (time >= 1) return std::nullopt;
    std::optional<Hit<3>> hit = surface_hit(time);
    if (hit) {
        hit->fraction = static_cast<float>(std::min(time + (1 - time) * static_cast<double>(hit->fraction), 1.0));
        hit->distance = static_cast<float>(time * length) + hit->distance;
    }
    return hit;
}

bool enter_solid(const DRay<3>& beam, const Composite<3>& solid,
                 FunctionRef<bool(const DRay<3>& beam, PartHit<3>& first)> surface_hit, PartHit<3>& first) {
    if (beam.rests()) return false;
    const Vec3 origin = to_float(beam.origin);
    const Aabb3 box = bounds(solid);
    const double tolerance =
        sixteen_ulp * std::max(largest(DVec<3>(box.min) - beam.origin), largest(DVec<3>(box.max) - beam.origin));
    if (!overlaps(grown(box, static_cast<float>(2 * tolerance)), Aabb3{origin, origin}))
        return surface_hit(beam, first);
    const View<3> shape(solid);
    const PlacedSolid placed(shape);
    const auto is_inside = [&](const DVec<3>& point) { return placed.side_of(point) == PointSide::inside; };
    const auto hit_at_start = [&](const Closest<3>& nearest, const DVec<3>& normal, bool started_inside) {
        first = {0, normal, started_inside, nearest.feature_a};
        return true;
    };

    const auto front_of = [&](std::uint32_t triangle) {
        const Corners t = placed.corners(triangle);
        return normalized<3>(cross(t[1] - t[0], t[2] - t[0]));
    };
    const View<3> point(view(Ball<3>{origin, 0}));
    const Closest<3> surface = closest(surface_view(shape), point);
    if (static_cast<double>(surface.distance) <= tolerance) {
        if (is_inside(beam.at(std::min(4 * tolerance, beam.length)))) {
            const DVec<3> normal = front_of(surface.feature_a.part);
            return hit_at_start(surface, dot(normal, beam.direction) < 0 ? normal : -beam.direction, false);
        }
    } else if (!is_inside(beam.origin)) {
        return surface_hit(beam, first);
    } else {
        Closest<3> depth = surface;
        find_convex_depth(shape, std::get<Convex<3>>(point), depth);
        if (dot(DVec<3>(depth.normal), beam.direction) < -slide_slope)
            return hit_at_start(depth, DVec<3>(depth.normal), true);
    }
    // A hit where the ray leaves or slides isn't an entry, nor is one inside of a component that overlaps another.
    double passed = 0;
    for (int i = 0; i < max_advances; ++i) {
        const DRay<3> rest{beam.at(passed), beam.direction, beam.length - passed};
        if (!surface_hit(rest, first)) return false;
        first.along += passed;
        if (dot(front_of(first.feature.part), beam.direction) < 0 && !is_inside(beam.at(first.along - 2 * tolerance)))
            return true;
        passed = std::max(first.along, std::nextafter(passed, beam.length)) + tolerance;
        if (!(passed < beam.length)) return false;
    }
    return false;
}

}  // namespace abut::detail
