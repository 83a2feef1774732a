// Ways over hills: from corner to corner, and between places at random.

#include "../test/oracle/random.hpp"
#include "walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace abut::bench {

namespace {

SharedWalkWays corner_to_corner(std::uint32_t columns) {
    WalkWays ways{walk_scene(columns), {}, {}};
    const auto last = static_cast<std::uint32_t>(ways.scene->triangles.size() - 1);
    const Vec3 middle(1.0f / 3);
    ways.from = {{0, middle}, {2 * columns - 1, middle}};
    ways.to = {{last, middle}, {last + 1 - 2 * columns, middle}};
    return std::make_shared<const WalkWays>(std::move(ways));
}

SharedWalkWays at_random(std::uint32_t columns, std::size_t count) {
    constexpr std::uint64_t seed = 4;
    oracle::Random random(seed);
    WalkWays ways{walk_scene(columns), {}, {}};
    for (std::size_t i = 0; i < 2 * count; ++i) {
        const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(ways.scene->triangles.size()));
        const double first = random.unit(), second = (1 - first) * random.unit();
        (i % 2 == 0 ? ways.from : ways.to).push_back({triangle, Vec3(DVec<3>(first, second, 1 - first - second))});
    }
    return std::make_shared<const WalkWays>(std::move(ways));
}

/// Each side finds ways of its own: they are compared by how long they are.
Job paths(const SharedWalkWays& ways, bool with_shortest) {
    Job job;
    job.items = job.values = ways->from.size();
    job.sides.push_back({"abut", [ways](std::span<double> values) {
                             for (std::size_t i = 0; i < values.size(); ++i)
                                 values[i] = ways->scene->mesh.find_path(ways->from[i], ways->to[i])->length;
                         }});
    job.sides.push_back(detour_ways(ways));
    if (with_shortest) job.sides.push_back(cgal_ways(ways));

    // Of the shortest that any side finds.
    std::vector<double> least(job.values, std::numeric_limits<double>::infinity());
    std::vector<std::vector<double>> all;
    for (const Side& side : job.sides) {
        std::vector<double>& lengths = all.emplace_back(job.values);
        side.ask(lengths);
        for (std::size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], lengths[i]);
    }
    for (std::size_t s = 0; s < all.size(); ++s) {
        double sum = 0, reached = 0;
        for (std::size_t i = 0; i < least.size(); ++i) {
            if (std::isinf(all[s][i])) continue;
            sum += all[s][i] / least[i];
            ++reached;
        }
        const double longer = reached > 0 ? sum / reached - 1 : 0;
        std::vector<Figure> figures{{"longer by", longer}};
        const double lost = 1 - reached / static_cast<double>(least.size());
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
        // The shortest ways take seconds each.
        const bool with_shortest = columns == 71;
        result.push_back(
            {"walk/path/across/" + count, [=] { return paths(corner_to_corner(columns), with_shortest); }});
        result.push_back({"walk/path/random/" + count,
                          [=] { return paths(at_random(columns, with_shortest ? 16 : 64), with_shortest); }});
    }
    return result;
}

}  // namespace abut::bench
