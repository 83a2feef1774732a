// Pairs of boxes that move slowly relative to their spacing: a broad phase per frame, and a temporal one that skips
// pairs which can't have come close.

#include "../../scenes/moving_boxes.hpp"
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
struct PairsAlone {
    explicit PairsAlone(std::span<const Aabb3> boxes) { phase.build(boxes); }

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

/// `step`: the mean motion of a box per frame, relative to the spacing of boxes.
Job slow_boxes(std::size_t count, double step) {
    scenes::MovingBoxesOptions options;
    const double spacing = 2.5 / std::cbrt(options.overlaps);
    constexpr double mean_step_length = 0.96;  // mean length of a uniform step in a cube, in half edges
    options.speed = step * spacing / mean_step_length;
    options.fineness = 1 << 17;  // makes all sums exact in the world of 10,000
    std::vector<float> top_speeds;
    const scenes::MovingBoxes<3> first(count, broad_seed, options);
    for (const Vec3& motion : first.last_steps())
        top_speeds.push_back(std::max({std::abs(motion.x), std::abs(motion.y), std::abs(motion.z)}));
    const MakeScene<3> scene = scene_of<3, scenes::MovingBoxes>(count, broad_seed, options);
    return {.items = count,
            .values = 1,
            .rounds = 8,
            .frames = 100,
            .tolerance = 0,
            .sides = {count_pairs<TemporalPairs<Grid<3>>>("abut", scene, top_speeds),
                      count_pairs<TemporalPairs<Bvh<3>>>("abut, over Bvh", scene, top_speeds),
                      count_pairs<PairsAlone<Grid<3>>>("abut Grid alone", scene),
                      count_pairs<PairsAlone<Bvh<3>>>("abut Bvh alone", scene)}};
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
