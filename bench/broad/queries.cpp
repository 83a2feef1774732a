// Region, ray and nearest-neighbour queries of static boxes.

#include "../../scenes/moving_boxes.hpp"
#include "box_queries.hpp"
#include "broad.hpp"

#include <memory>
#include <string>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t query_count = 1024;
constexpr std::size_t nearest_count = 8;

using Boxes = scenes::MovingBoxes<3>;

Vec3 random_point(oracle::Random& random, const Boxes& scene) {
    return {random.uniform_float(0, scene.side()), random.uniform_float(0, scene.side()),
            random.uniform_float(0, scene.side())};
}

/// Regions everywhere in the world, each of which overlaps about 15 boxes.
std::vector<Aabb3> random_regions(const Boxes& scene) {
    oracle::Random random(broad_seed);
    std::vector<Aabb3> result;
    while (result.size() < query_count) {
        const Vec3 center = random_point(random, scene);
        const Vec3 half{random.uniform_float(1.3, 2.3), random.uniform_float(1.3, 2.3), random.uniform_float(1.3, 2.3)};
        result.push_back({center - half, center + half});
    }
    return result;
}

/// Rays between random points.
std::vector<Ray3> random_rays(const Boxes& scene) {
    oracle::Random random(broad_seed);
    std::vector<Ray3> result;
    while (result.size() < query_count) {
        const Vec3 origin = random_point(random, scene);
        result.push_back({origin, to_float<3>(random.direction<3>()), 40});
    }
    return result;
}

std::vector<Vec3> random_points(const Boxes& scene) {
    oracle::Random random(broad_seed);
    std::vector<Vec3> result;
    while (result.size() < query_count) result.push_back(random_point(random, scene));
    return result;
}

// Queries of abut's structures.

template <class Phase>
double count_in_region(const Phase& phase, const Aabb3& region) {
    std::size_t found = 0;
    phase.each_overlapping(region, [&](std::uint32_t) { ++found; });
    return static_cast<double>(found);
}

template <class Phase>
double count_along(const Phase& phase, const Ray3& ray) {
    std::size_t found = 0;
    phase.raycast(ray, [&](std::uint32_t) { ++found; });
    return static_cast<double>(found);
}

template <class Phase>
double first_hit(const Phase& phase, std::span<const Aabb3> boxes, const Ray3& ray) {
    const RayToBox ray_to_box(ray);
    float reach = ray.length;
    phase.raycast(ray, [&](std::uint32_t item) { return reach = std::min(reach, entry(ray_to_box, boxes[item])); });
    return static_cast<double>(reach);
}

template <class Phase>
double distance_to_nearest(const Phase& phase, std::span<const Aabb3> boxes, const Vec3& point, std::size_t count) {
    Nearest nearest(count);
    phase.closest(point, [&](std::uint32_t item) {
        nearest.add(squared_distance(point, boxes[item]));
        return std::sqrt(nearest.farthest());
    });
    return nearest.sum_of_distances();
}

/// The library's sides: each structure answers by answer(phase, boxes, query).
template <class Query, class Answer>
Job query_all(const Boxes& scene, std::span<const Query> queries, double tolerance, Answer answer) {
    Job job{.items = query_count, .values = query_count, .tolerance = tolerance, .sides = {}};
    const auto boxes = std::make_shared<const std::vector<Aabb3>>(scene.boxes().begin(), scene.boxes().end());
    each_side<3, ForQueries<3>>([&]<class Phase>(const Structure<Phase>& structure, std::string who) {
        if (boxes->size() > structure.limits.queries) return;
        const auto phase = std::make_shared<Phase>();
        set_history(*phase, {.moved = 0, .queries = 1});
        phase->build(*boxes);
        job.sides.push_back(each_query(std::move(who), queries, [phase, boxes, answer](const Query& query) {
            return answer(std::as_const(*phase), std::span<const Aabb3>(*boxes), query);
        }));
    });
    return job;
}

constexpr double exact = 0, to_rounding = 1e-3;

Job regions(std::size_t count) {
    const Boxes scene(count, broad_seed);
    const std::vector<Aabb3> queries = random_regions(scene);
    Job job = query_all<Aabb3>(scene, queries, exact, [](const auto& phase, auto, const Aabb3& region) {
        return count_in_region(phase, region);
    });
    job.sides.push_back(bullet_regions(scene.boxes(), queries));
    job.sides.push_back(fcl_regions(scene.boxes(), queries));
    return job;
}

/// Visits all boxes that each ray hits.
Job rays(std::size_t count) {
    const Boxes scene(count, broad_seed);
    const std::vector<Ray3> queries = random_rays(scene);
    Job job = query_all<Ray3>(scene, queries, exact,
                              [](const auto& phase, auto, const Ray3& ray) { return count_along(phase, ray); });
    job.sides.push_back(bullet_rays(scene.boxes(), queries));
    return job;
}

Job first_hits(std::size_t count) {
    const Boxes scene(count, broad_seed);
    const std::vector<Ray3> queries = random_rays(scene);
    Job job = query_all<Ray3>(scene, queries, to_rounding, [](const auto& phase, auto boxes, const Ray3& ray) {
        return first_hit(phase, boxes, ray);
    });
    job.sides.push_back(bullet_first_hits(scene.boxes(), queries));
    job.sides.push_back(embree_first_hits(scene.boxes(), queries));
    return job;
}

Job nearest(std::size_t count, std::size_t wanted) {
    const Boxes scene(count, broad_seed);
    const std::vector<Vec3> queries = random_points(scene);
    Job job = query_all<Vec3>(scene, queries, to_rounding, [wanted](const auto& phase, auto boxes, const Vec3& point) {
        return distance_to_nearest(phase, boxes, point, wanted);
    });
    job.sides.push_back(fcl_nearest(scene.boxes(), queries, wanted));
    job.sides.push_back(embree_nearest(scene.boxes(), queries, wanted));
    return job;
}

}  // namespace

std::vector<Bench> box_query_benches() {
    return {
        {"broad/region/3d/100000", [] { return regions(100'000); }},
        {"broad/first_hit/3d/100", [] { return first_hits(100); }},
        {"broad/nearest/3d/100", [] { return nearest(100, 1); }},
        {"broad/ray/3d/100000", [] { return rays(100'000); }},
        {"broad/first_hit/3d/100000", [] { return first_hits(100'000); }},
        {"broad/nearest/3d/100000", [] { return nearest(100'000, 1); }},
        {"broad/nearest_8/3d/100000", [] { return nearest(100'000, nearest_count); }},
    };
}

}  // namespace abut::bench
