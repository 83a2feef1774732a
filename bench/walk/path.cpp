// Paths over hills: from corner to corner, and between random points.

#include "../../test/oracle/random.hpp"
#include "walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace abut::bench {

namespace {

SharedWalkPaths corner_to_corner(std::uint32_t columns) {
    WalkPaths paths_to_find{walk_scene(columns), {}, {}};
    const auto last = static_cast<std::uint32_t>(paths_to_find.scene->triangles.size() - 1);
    const Vec3 middle(1.0f / 3);
    paths_to_find.from = {{0, middle}, {2 * columns - 1, middle}};
    paths_to_find.to = {{last, middle}, {last + 1 - 2 * columns, middle}};
    return std::make_shared<const WalkPaths>(std::move(paths_to_find));
}

SharedWalkPaths at_random(std::uint32_t columns, std::size_t count) {
    constexpr std::uint64_t seed = 4;
    oracle::Random random(seed);
    WalkPaths paths_to_find{walk_scene(columns), {}, {}};
    for (std::size_t i = 0; i < 2 * count; ++i) {
        const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(paths_to_find.scene->triangles.size()));
        const double first = random.unit(), second = (1 - first) * random.unit();
        (i % 2 == 0 ? paths_to_find.from : paths_to_find.to)
            .push_back({triangle, Vec3(detail::DVec<3>(first, second, 1 - first - second))});
    }
    return std::make_shared<const WalkPaths>(std::move(paths_to_find));
}

/// Sides find different paths: their lengths are compared.
Job paths(const SharedWalkPaths& paths_to_find, bool with_shortest) {
    Job job;
    job.items = job.values = paths_to_find->from.size();
    job.sides.push_back(
        {"abut", [paths_to_find](std::span<double> values) {
             for (std::size_t i = 0; i < values.size(); ++i)
                 values[i] = paths_to_find->scene->mesh.find_path(paths_to_find->from[i], paths_to_find->to[i])->length;
         }});
    job.sides.push_back(detour_paths(paths_to_find));
    if (with_shortest) job.sides.push_back(cgal_paths(paths_to_find));

    // Relative to the shortest path of any side.
    std::vector<double> shortest_lengths(job.values, std::numeric_limits<double>::infinity());
    std::vector<std::vector<double>> all;
    for (const Side& side : job.sides) {
        std::vector<double>& lengths = all.emplace_back(job.values);
        side.run(lengths);
        for (std::size_t i = 0; i < shortest_lengths.size(); ++i)
            shortest_lengths[i] = std::min(shortest_lengths[i], lengths[i]);
    }
    for (std::size_t s = 0; s < all.size(); ++s) {
        double sum = 0, reached = 0;
        for (std::size_t i = 0; i < shortest_lengths.size(); ++i) {
            if (std::isinf(all[s][i])) continue;
            sum += all[s][i] / shortest_lengths[i];
            ++reached;
        }
        const double longer = reached > 0 ? sum / reached - 1 : 0;
        std::vector<Figure> figures{{"longer by", longer}};
        const double lost = 1 - reached / static_cast<double>(shortest_lengths.size());
        if (lost > 0) figures.push_back({"not reached", lost});
        job.sides[s].figures = [figures] { return figures; };
        job.sides[s].strays = 1;
    }
    return job;
}

}  // namespace

std::vector<Bench> walk_path_benches() {
    std::vector<Bench> result;
    for (const std::uint32_t columns : {71u, 157u, 226u}) {
        const std::string count = std::to_string(2 * columns * columns);
        // Exact shortest paths take seconds each.
        const bool with_shortest = columns == 71;
        result.push_back(
            {"walk/path/across/" + count, [=] { return paths(corner_to_corner(columns), with_shortest); }});
        result.push_back({"walk/path/random/" + count,
                          [=] { return paths(at_random(columns, with_shortest ? 16 : 64), with_shortest); }});
    }
    return result;
}

}  // namespace abut::bench
