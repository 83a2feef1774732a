// Broad phases: their pairs over frames, and their queries.

#include "../../scenes/moving_boxes.hpp"
#include "../broad_phase/any_broad_phase.hpp"
#include "sections.hpp"
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/k_nearest.hpp>
#include <abut/broad_phase/temporal.hpp>

#include <algorithm>

namespace abut::everywhere {
namespace {

void add_pairs(Hash& hash, std::span<const detail::ItemPair> pairs) {
    for (const auto& [i, j] : pairs) hash.add(std::uint64_t{i} << 32 | j);
}
void add_items(Hash& hash, std::vector<std::uint32_t>& items) {
    std::sort(items.begin(), items.end());
    for (const std::uint32_t item : items) hash.add(std::uint64_t{item});
    items.clear();
}

template <int D>
void add_phase(Hash& hash, test::AnyBroadPhase<D> phase) {
    scenes::MovingBoxes<D> scene(600, D);
    std::vector<detail::ItemPair> pairs;
    std::vector<std::uint32_t> items;
    std::vector<NearItem> nearest;
    phase.build(scene.boxes());
    for (int frame = 0; frame < 6; ++frame) {
        phase.sorted_pairs(pairs);
        add_pairs(hash, pairs);
        // The structure's own order is the same everywhere too.
        phase.each_pair([&](std::uint32_t i, std::uint32_t j) { hash.add(std::uint64_t{i} << 32 | j); });
        const Vec<D> corner(0.0f), middle(0.5f * scene.side());
        phase.each_overlapping(Aabb<D>{0.8f * middle, 1.1f * middle}, [&](std::uint32_t i) { items.push_back(i); });
        add_items(hash, items);
        phase.raycast(Ray<D>::between(corner, middle), [&](std::uint32_t i) { items.push_back(i); });
        add_items(hash, items);
        k_nearest(phase, scene.boxes(), middle, 10, nearest);
        for (const NearItem& near : nearest) {
            hash.add(near.distance);
            hash.add(std::uint64_t{near.item});
        }
        scene.step();
        phase.update(scene.boxes());
    }
}

template <int D>
void add_temporal(Hash& hash) {
    scenes::MovingBoxes<D> scene(600, 7);
    const std::vector<float> speeds(scene.boxes().size(), 0.2f);
    Temporal<D> phase;
    std::vector<detail::ItemPair> pairs;
    phase.build(scene.boxes(), speeds);
    for (int frame = 0; frame < 20; ++frame) {
        phase.sorted_pairs(pairs);
        add_pairs(hash, pairs);
        scene.step();
        phase.update(scene.boxes(), 1);
    }
}

template <int D>
void add_all(Hash& hash) {
    using Any = test::AnyBroadPhase<D>;
    add_phase<D>(hash, Any::template of<BruteForce<D>>());
    add_phase<D>(hash, Any::template of<Grid<D>>());
    add_phase<D>(hash, Any::template of<LayeredGrid<D>>());
    add_phase<D>(hash, Any::template of<SweepAndPrune<D>>());
    add_phase<D>(hash, Any::template of<Bvh<D>>());
    add_phase<D>(hash, Any::template of<Bsp<D>>());
    add_phase<D>(hash, Any::template of<ChosenBroadPhase<D>>());
    add_temporal<D>(hash);
}

}  // namespace

void add_broad_phases(Hash& hash) {
    add_all<2>(hash);
    add_all<3>(hash);
}

}  // namespace abut::everywhere
