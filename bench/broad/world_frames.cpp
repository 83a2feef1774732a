// A frame of a World in which all loose items move: beside its own parts without a World, and beside peers' worlds.

#include "crowd.hpp"
#include <abut/world/large_world.hpp>

namespace abut::bench {

namespace {

/// The same update in a LargeWorld, ten thousand kilometres from the origin.
template <int D>
Side update_far_away(const Crowd<D>& crowd) {
    struct State {
        explicit State(const Crowd<D>& items) : shaken(items) {
            for (const auto& item : items.items)
                ids.push_back(std::visit(
                    [&](const auto& shape) { return world.add(shape, far(item.pose), {.fixed = item.fixed}); },
                    item.shape));
        }
        static PoseD<D> far(const Pose<D>& pose) {
            return {detail::DVec<D>(1e7) + detail::DVec<D>(pose.position), pose.rotation};
        }
        ShakenCrowd<D> shaken;
        LargeWorld<D> world;
        std::vector<Id> ids;
    };
    const auto state = std::make_shared<State>(crowd);
    const auto run = [state](std::span<double> values) {
        for (std::size_t i = 0; i < state->ids.size(); ++i)
            if (!state->shaken.crowd.items[i].fixed)
                state->world.move(state->ids[i], State::far(state->shaken.poses[i]));
        values[0] = CrowdedWorld<D>::touching(state->world.update());
    };
    return {"abut in double", run, [state] { state->shaken.shake(); }};
}

/// One contact in a hundred may differ from a peer's, which round corners or let points that were in contact drift.
template <int D>
Bench frame(const std::string& scene, std::function<Crowd<D>()> make) {
    return of_crowd<D>("broad/world/frame/" + scene, std::move(make), [](const Crowd<D>& crowd) -> Job {
        Side peer;
        if constexpr (D == 2)
            peer = box2d_world(crowd);
        else
            peer = bullet_world(crowd);
        return {.tolerance = 0.01 * static_cast<double>(crowd.items.size()),
                .sides = {update("abut", crowd, true), update("abut without filter", crowd, false),
                          contacts_without_world(crowd), update_far_away(crowd), peer}};
    });
}

}  // namespace

std::vector<Bench> world_frame_benches() {
    std::vector<Bench> result;
    for (const std::size_t count : {1'000, 10'000, 50'000}) {
        const std::string name = "/" + std::to_string(count);
        const auto side = [count](double items_per_cell, int dimensions) {
            return static_cast<int>(std::pow(static_cast<double>(count) / items_per_cell, 1.0 / dimensions));
        };
        result.push_back(frame<2>("sparse/2d" + name, [count] { return scattered<2>(count, 8, Kinds::no_capsules); }));
        result.push_back(frame<2>("pile/2d" + name, [side] { return thrown_onto_a_floor<2>(side(6, 1)); }));
        result.push_back(frame<3>("sparse/3d" + name, [count] { return scattered<3>(count, 20); }));
        result.push_back(frame<3>("pile/3d" + name, [side] { return thrown_onto_a_floor<3>(side(33.0 / 16, 2)); }));
    }
    return result;
}

}  // namespace abut::bench
