// All pairs of moving boxes, frame after frame.

#include "../../scenes/moving_boxes.hpp"
#include "../../scenes/plain_grid.hpp"
#include "../../scenes/skewed_boxes.hpp"
#include "broad.hpp"

#include <algorithm>
#include <string>

namespace abut::bench {

namespace {

// --- the sides ---

template <class Phase, int D>
struct PhasePairs {
    PhasePairs(std::span<const Aabb<D>> boxes, Upkeep how, double moved) : upkeep(how) {
        set_history(phase, {.moved = moved, .queries = 0});
        phase.build(boxes);
    }

    std::size_t count(std::span<const Aabb<D>> boxes) {
        upkeep == Upkeep::update ? phase.update(boxes) : phase.build(boxes);
        std::size_t pairs = 0;
        phase.each_pair([&pairs](std::uint32_t, std::uint32_t) { ++pairs; });
        return pairs;
    }

    Phase phase;
    Upkeep upkeep;
};

template <int D>
struct PlainGridPairs {
    PlainGridPairs(std::span<const Aabb<D>>, float cell) : grid(cell) {}

    std::size_t count(std::span<const Aabb<D>> boxes) {
        grid.build(boxes);
        std::size_t pairs = 0;
        grid.each_pair([&pairs](std::uint32_t, std::uint32_t) { ++pairs; });
        return pairs;
    }

    scenes::PlainGrid<D> grid;
};

template <int D>
Side plain_grid_pairs(const MakeScene<D>& make, bool skewed) {
    const float cell = skewed ? 8 : 2.5f;  // the best of several tried
    return count_pairs<PlainGridPairs<D>>("plain grid", make, cell);
}
constexpr Limits plain_grid_limits{.moving = 100'000, .scratch = 10'000};

template <int D>
struct Peer {
    Side (*pairs)(const MakeScene<D>& make, Upkeep upkeep);
    Limits limits;
};

constexpr Peer<3> peers3[] = {
    {bullet_tree_pairs, {.moving = 100'000}}, {bullet_sweep_pairs, {.moving = 10'000, .scratch = 0}},
    {fcl_tree_pairs, {.moving = 100'000}},    {fcl_sweep_pairs, {.moving = 1000, .scratch = 0}},
    {cgal_pairs<3>, {.moving = 100'000}},     {embree_pairs, {}},
};
constexpr Peer<2> peers2[] = {
    {box2d_pairs, {.moving = 100'000, .scratch = 0}},
    {cgal_pairs<2>, {.moving = 100'000}},
};
std::span<const Peer<2>> peers(const BoxFrames<2>&) {
    return peers2;
}
std::span<const Peer<3>> peers(const BoxFrames<3>&) {
    return peers3;
}

template <int D>
bool within(const Limits& limits, const BoxFrames<D>& frames) {
    return frames.count <= limits.moving && (!frames.skewed || frames.count <= limits.skewed) &&
           (frames.upkeep == Upkeep::update || frames.count <= limits.scratch);
}

// --- the scenes ---

template <int D>
BoxFrames<D> moving(std::size_t count) {
    return {count, scene_of<D, scenes::MovingBoxes>(count, broad_seed)};
}
BoxFrames<3> from_scratch(BoxFrames<3> frames) {
    frames.upkeep = Upkeep::scratch;
    return frames;
}
BoxFrames<3> tenth_moving(std::size_t count) {
    return {
        .count = count,
        .scene = scene_of<3, scenes::MovingBoxes>(count, broad_seed, scenes::MovingBoxesOptions{.one_in_moves = 10}),
        .moved = 0.1};
}
BoxFrames<3> skewed(std::size_t count) {
    return {.count = count, .scene = scene_of<3, scenes::SkewedBoxes>(count, broad_seed), .skewed = true};
}

}  // namespace

template <int D>
Job pairs_of_frames(const BoxFrames<D>& frames) {
    // This many frames are verified. They are also the first, in which peers with fattened boxes have least work.
    const std::size_t first = frames.count <= 100'000 ? 8 : 2;
    Job job{.items = frames.count, .values = 1, .rounds = first, .frames = 10, .tolerance = 0, .sides = {}};
    each_side<D, ForPairs<D>>([&]<class Phase>(const Structure<Phase>& structure, std::string who) {
        if (within(structure.limits, frames))
            job.sides.push_back(
                count_pairs<PhasePairs<Phase, D>>(std::move(who), frames.scene, frames.upkeep, frames.moved));
    });
    if (within(plain_grid_limits, frames)) job.sides.push_back(plain_grid_pairs(frames.scene, frames.skewed));
    for (const Peer<D>& peer : peers(frames))
        if (within(peer.limits, frames)) job.sides.push_back(peer.pairs(frames.scene, frames.upkeep));
    return job;
}

template Job pairs_of_frames(const BoxFrames<2>& frames);
template Job pairs_of_frames(const BoxFrames<3>& frames);

std::vector<Bench> frame_benches() {
    std::vector<Bench> result;
    const auto add = [&](const std::string& name, const auto& frames) {
        result.push_back(
            {"broad/" + name + "/" + std::to_string(frames.count), [frames] { return pairs_of_frames(frames); }});
    };
    for (const std::size_t count : {60u, 120u, 1'000u, 10'000u, 100'000u, 1'000'000u})
        add("moving/3d", moving<3>(count));
    for (const std::size_t count : {1'000u, 10'000u, 100'000u, 1'000'000u})
        add("scratch/3d", from_scratch(moving<3>(count)));
    for (const std::size_t count : {10'000u, 100'000u, 1'000'000u}) add("tenth/3d", tenth_moving(count));
    add("skewed/moving/3d", skewed(100'000));
    add("skewed/scratch/3d", from_scratch(skewed(100'000)));
    for (const std::size_t count : {60u, 120u, 1'000u, 10'000u, 100'000u}) add("moving/2d", moving<2>(count));
    return result;
}

}  // namespace abut::bench
