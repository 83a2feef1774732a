// Closest points on hills: of points near their last positions, of points above, and of distant points.

#include "../../test/oracle/random.hpp"
#include "walk.hpp"
#include <abut/math/dvec.hpp>

#include <string>
#include <utility>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t point_count = 4096;

WalkPoint random_place(const WalkScene& scene, oracle::Random& random) {
    const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(scene.triangles.size()));
    const double first = random.unit(), second = (1 - first) * random.unit();
    return {triangle, Vec3(DVec<3>(first, second, 1 - first - second))};
}

/// Points up to `away` from the surface, each near a surface point.
WalkPoints points_near(std::uint32_t columns, float away, std::vector<WalkPoint>& places) {
    constexpr std::uint64_t seed = 3;
    oracle::Random random(seed);
    WalkPoints result{walk_scene(columns), {}, away + 0.01f};
    for (std::size_t i = 0; i < point_count; ++i) {
        places.push_back(random_place(*result.scene, random));
        const DVec<3> direction = random.direction<3>() * (random.unit() * static_cast<double>(away));
        result.points.push_back(to_float(DVec<3>(result.scene->mesh.to_world(places.back())) + direction));
    }
    return result;
}

double distance(const WalkPoints& points, std::size_t i, const WalkPoint& place) {
    return length(DVec<3>(points.scene->mesh.to_world(place)) - DVec<3>(points.points[i]));
}

/// `places`: start points of local searches.
Job nearest(std::uint32_t columns, float away, bool near_last) {
    std::vector<WalkPoint> places;
    const auto points = std::make_shared<const WalkPoints>(points_near(columns, away, places));
    const WalkMesh& mesh = points->scene->mesh;
    Job job;
    job.items = job.values = point_count;
    job.tolerance = 1e-3;
    const Side anywhere{"abut, any distance", [points, &mesh](std::span<double> values) {
                            for (std::size_t i = 0; i < values.size(); ++i)
                                values[i] = distance(*points, i, mesh.nearest(points->points[i]));
                        }};
    const Side from_last{"abut, last", [points, &mesh, places](std::span<double> values) {
                             for (std::size_t i = 0; i < values.size(); ++i)
                                 values[i] = distance(*points, i, mesh.nearest(points->points[i], places[i]));
                         }};
    const Side in_reach{"abut", [points, &mesh](std::span<double> values) {
                            for (std::size_t i = 0; i < values.size(); ++i)
                                values[i] = distance(*points, i, *mesh.nearest(points->points[i], points->reach));
                        }};
    if (near_last) {
        job.sides = {from_last, in_reach, anywhere};
    } else {
        job.sides = {in_reach, anywhere};
    }
    Side detour = detour_nearest(points);
    detour.strays = 1;  // prefers the polygon below a point, and its heights are rounded
    job.sides.push_back(std::move(detour));
    job.sides.push_back(embree_nearest(points));
    job.sides.push_back(cgal_nearest(points));
    return job;
}

}  // namespace

std::vector<Bench> walk_nearest_benches() {
    std::vector<Bench> result;
    for (const std::uint32_t columns : {71u, 157u, 226u}) {
        const std::string count = std::to_string(2 * columns * columns);
        result.push_back({"walk/nearest/last/" + count, [=] { return nearest(columns, 0.25f, true); }});
        result.push_back({"walk/nearest/small reach/" + count, [=] { return nearest(columns, 1, false); }});
        result.push_back({"walk/nearest/wide reach/" + count, [=] { return nearest(columns, 30, false); }});
    }
    return result;
}

}  // namespace abut::bench
