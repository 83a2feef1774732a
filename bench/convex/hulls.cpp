// Hulls of many points, few or all of which are vertices: balls and spheres are the extremes. Rings have two faces of
// thousands of vertices.
// Far from the origin, floats round the points to a coarse lattice, so that many are coplanar.

#include "hulls.hpp"

#include "../../test/oracle/random.hpp"
#include <abut/shape/polyhedron.hpp>

#include <cmath>
#include <numbers>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::uint64_t seed = 1;

template <class Make>
SharedPoints drawn(std::size_t count, Make make) {
    oracle::Random random(seed);
    auto result = std::make_shared<std::vector<Vec3>>();
    result->reserve(count);
    for (std::size_t i = 0; i < count; ++i) result->push_back(to_float(make(random)));
    return result;
}

SharedPoints in_a_ball(std::size_t count) {
    return drawn(count, [](oracle::Random& random) {
        for (;;) {
            const DVec<3> p = random.in_cube<3>();
            if (dot(p, p) <= 1) return p;
        }
    });
}
SharedPoints on_a_sphere(std::size_t count, const DVec<3>& center) {
    return drawn(count, [&](oracle::Random& random) { return center + random.direction<3>(); });
}
SharedPoints on_a_disc(std::size_t count) {
    return drawn(count, [](oracle::Random& random) {
        const DVec<2> p = random.direction<2>() * std::sqrt(random.unit());
        return DVec<3>(p.x, p.y, 0);
    });
}
/// Multiples of a rounded number: collinear up to the last bit only.
SharedPoints on_a_line(std::size_t count) {
    return drawn(count, [](oracle::Random& random) { return DVec<3>(0.1, 0.2, 0.3) * random.unit(); });
}
SharedPoints in_one_place(std::size_t count) {
    return drawn(count, [](oracle::Random&) { return DVec<3>(0.1, 0.2, 0.3); });
}
SharedPoints on_two_rings(std::size_t count) {
    auto result = std::make_shared<std::vector<Vec3>>();
    for (std::size_t i = 0; i < count / 2; ++i) {
        const double angle = 4 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
        result->insert(result->end(), {{x, y, -1.0f}, {x, y, 1.0f}});
    }
    return result;
}

Side ours(const SharedPoints& points) {
    return {"abut", [points](std::span<double> values) {
                const Polyhedron hull = *Polyhedron::build(*points);
                values[0] = hull.volume();
                values[1] = hull.area();
            }};
}

using Peer = Side (*)(const SharedPoints&);

Job hull_job(const SharedPoints& points, const std::vector<Peer>& peers) {
    Job job{.items = points->size(), .values = 2, .tolerance = 1e-5, .sides = {ours(points)}};
    for (const Peer peer : peers) job.sides.push_back(peer(points));
    return job;
}

}  // namespace

std::vector<Bench> convex_hull_benches() {
    const std::vector<Peer> all{qhull_hull, cgal_hull, bullet_hull};
    // The two coplanar rings take CGAL more than ten seconds. Coplanar points are no input for Qhull, and no polyhedron
    // for CGAL.
    return {
        {"convex/hull/ball/100", [=] { return hull_job(in_a_ball(100), all); }},
        {"convex/hull/ball/100000", [=] { return hull_job(in_a_ball(100'000), all); }},
        {"convex/hull/ball/1000000", [=] { return hull_job(in_a_ball(1'000'000), all); }},
        {"convex/hull/sphere/1000", [=] { return hull_job(on_a_sphere(1000, DVec<3>(0.0)), all); }},
        {"convex/hull/sphere/100000", [=] { return hull_job(on_a_sphere(100'000, DVec<3>(0.0)), all); }},
        {"convex/hull/sphere_far/10000", [=] { return hull_job(on_a_sphere(10'000, DVec<3>(1e5)), all); }},
        {"convex/hull/rings/10000",
         [] {
             return hull_job(on_two_rings(10'000), {qhull_hull, bullet_hull});
         }},
        {"convex/hull/disc/10000", [] { return hull_job(on_a_disc(10'000), {bullet_hull}); }},
        {"convex/hull/line/10000", [] { return hull_job(on_a_line(10'000), {bullet_hull}); }},
        {"convex/hull/one_place/10000", [] { return hull_job(in_one_place(10'000), {bullet_hull}); }},
    };
}

}  // namespace abut::bench
