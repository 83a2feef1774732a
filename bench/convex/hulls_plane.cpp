// Hulls of many points in 2D, few or all of which are vertices; and hulls with a vertex limit, in 2D and 3D. No peer
// among the Debian packages computes the latter such that they contain all points.

#include "hulls_plane.hpp"

#include "../../test/oracle/random.hpp"
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cmath>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::uint64_t seed = 1;

template <class Make>
SharedPoints2 drawn(std::size_t count, Make make) {
    oracle::Random random(seed);
    auto result = std::make_shared<std::vector<Vec2>>();
    result->reserve(count);
    for (std::size_t i = 0; i < count; ++i) result->push_back(make(random));
    return result;
}

SharedPoints2 in_a_disc(std::size_t count) {
    return drawn(count, [](oracle::Random& random) {
        const DVec<2> direction = random.direction<2>();
        return to_float(direction * std::sqrt(random.unit()));
    });
}
SharedPoints2 on_a_circle(std::size_t count) {
    return drawn(count, [](oracle::Random& random) { return to_float(random.direction<2>()); });
}
SharedPoints2 on_a_grid(std::size_t count) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count)));
    return drawn(count, [side](oracle::Random& random) {
        const auto x = static_cast<float>(random.below(side));
        return Vec2(x, static_cast<float>(random.below(side)));
    });
}
/// Exactly collinear, so that the rank is detected.
SharedPoints2 on_a_line(std::size_t count) {
    return drawn(count, [](oracle::Random& random) {
        const auto x = static_cast<float>(random.below(1u << 20));
        return Vec2(x, 4 * x);
    });
}

Job plane_job(const SharedPoints2& points, bool has_area) {
    const auto run = [points](std::span<double> values) {
        const Polygon hull = *Polygon::build(*points);
        const std::span<const Vec2> corners = hull.points();
        write_loop(
            corners.size(), [&](std::size_t i) { return DVec<2>(corners[i]); }, values);
    };
    Job job{.items = points->size(), .values = 2, .tolerance = 1e-5, .sides = {{"abut", run}}};
    job.sides.push_back(cgal_hull_2(points));
    job.sides.push_back(cgal_akl_toussaint(points));
    // It rejects collinear points.
    if (has_area) job.sides.push_back(qhull_hull_2(points));
    return job;
}

/// Writes the fraction that the limit adds.
template <class Shape, class Points, class Size>
Job limited_job(const Points& points, std::uint32_t limit, Size size) {
    const double full = size(*Shape::build(*points));
    const auto run = [=](std::span<double> values) {
        const Shape limited = *Shape::build(*points, {.max_vertices = limit});
        values[0] = size(limited) / full - 1;
    };
    return {.items = points->size(), .values = 1, .sides = {{"abut", run}}};
}

Job limited_sphere(std::size_t count, std::uint32_t limit) {
    oracle::Random random(seed);
    auto points = std::make_shared<std::vector<Vec3>>();
    for (std::size_t i = 0; i < count; ++i) points->push_back(to_float(random.direction<3>()));
    return limited_job<Polyhedron>(points, limit, [](const Polyhedron& shape) { return shape.volume(); });
}

Job limited_circle(std::size_t count, std::uint32_t limit) {
    return limited_job<Polygon>(on_a_circle(count), limit, [](const Polygon& shape) { return shape.area(); });
}

}  // namespace

std::vector<Bench> convex_hull_plane_benches() {
    return {{"convex/hull/2d/disc/100000", [] { return plane_job(in_a_disc(100'000), true); }},
            {"convex/hull/2d/disc/1000000", [] { return plane_job(in_a_disc(1'000'000), true); }},
            {"convex/hull/2d/circle/100000", [] { return plane_job(on_a_circle(100'000), true); }},
            {"convex/hull/2d/circle/1000000", [] { return plane_job(on_a_circle(1'000'000), true); }},
            {"convex/hull/2d/grid/100000", [] { return plane_job(on_a_grid(100'000), true); }},
            {"convex/hull/2d/grid/1000000", [] { return plane_job(on_a_grid(1'000'000), true); }},
            {"convex/hull/2d/line/100000", [] { return plane_job(on_a_line(100'000), false); }},
            {"convex/hull/2d/line/1000000", [] { return plane_job(on_a_line(1'000'000), false); }},
            {"convex/hull/limited/circle/1000/16", [] { return limited_circle(1000, 16); }},
            {"convex/hull/limited/sphere/1000/32", [] { return limited_sphere(1000, 32); }},
            {"convex/hull/limited/sphere/1000/64", [] { return limited_sphere(1000, 64); }},
            {"convex/hull/limited/sphere/100000/32", [] { return limited_sphere(100'000, 32); }}};
}

}  // namespace abut::bench
