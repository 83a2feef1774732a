// All pairs of boxes that move little against their spacing: a broad phase in each frame, and one that waits until
// something can have happened.

#include "../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/broad_phase/temporal.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

template <class Inner>
struct PlainPairs {
    explicit PlainPairs(std::span<const Aabb3> boxes) { phase.build(boxes); }

    std::size_t count(std::span<const Aabb3> boxes) {
        phase.update(boxes);
        std::size_t pairs = 0;
        phase.each_pair([&pairs](std::uint32_t, std::uint32_t) { ++pairs; });
        return pairs;
    }

    Inner phase;
};

template <class Inner>
struct TemporalPairs {
    TemporalPairs(std::span<const Aabb3> boxes, const std::vector<float>& top_speeds) {
        phase.build(boxes, top_speeds);
    }

    std::size_t count(std::span<const Aabb3> boxes) {
        phase.update(boxes, 1);
        std::size_t pairs = 0;
        phase.each_pair([&pairs](std::uint32_t, std::uint32_t) { ++pairs; });
        return pairs;
    }

    Temporal<3, Inner> phase;
};

/// `step`: the mean way of a box in a frame, in parts of the spacing: the side of the room that each box has.
Job slow_boxes(std::size_t count, double step) {
    scenes::MovingBoxesOptions options;
    const double spacing = 2.5 / std::cbrt(options.overlaps);
    constexpr double mean_way = 0.96;  // of steps that are uniform in a cube, in halves of its side
    options.speed = step * spacing / mean_way;
    options.fineness = 1 << 17;  // so that all sums are exact in the world of 10,000
    std::vector<float> top_speeds;
    const scenes::MovingBoxes<3> first(count, broad_seed, options);
    for (const Vec3& way : first.last_steps())
        top_speeds.push_back(std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}));
    const MakeScene<3> scene = scene_of<3, scenes::MovingBoxes>(count, broad_seed, options);
    return {.items = count,
            .values = 1,
            .rounds = 8,
            .frames = 100,
            .tolerance = 0,
            .sides = {count_pairs<TemporalPairs<Grid<3>>>("abut", scene, top_speeds),
                      count_pairs<TemporalPairs<Bvh<3>>>("abut, over Bvh", scene, top_speeds),
                      count_pairs<PlainPairs<Grid<3>>>("abut plain Grid", scene),
                      count_pairs<PlainPairs<Bvh<3>>>("abut plain Bvh", scene)}};
}

}  // namespace

std::vector<Bench> temporal_benches() {
    std::vector<Bench> result;
    for (const double step : {1e-4, 1e-3, 1e-2, 0.06, 0.3}) {
        std::ostringstream name;
        name << "broad/temporal/3d/10000/" << step;
        result.push_back({name.str(), [step] { return slow_boxes(10'000, step); }});
    }
    return result;
}

}  // namespace abut::bench
