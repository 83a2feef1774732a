// The cost of the filter of internal edges: an update of a World in which all loose items move, with the filter,
// without it, and the contacts of all pairs without a World. And the update on two threads.

#include "crowd.hpp"
#include <abut/math/thread_pool.hpp>

namespace abut::bench {

using namespace detail;

namespace {

/// Boxes that rest on such a floor, each on four boxes of it.
Crowd<3> on_a_floor() {
    oracle::Random random(broad_seed);
    Crowd<3> crowd;
    add_floor(crowd, 40);
    crowd.shake = 0.002;
    for (int i = 0; i < 400; ++i) {
        const Vec3 place(2.0f * static_cast<float>(i % 20), 0.49f, 2.0f * static_cast<float>(i / 20));
        crowd.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}},
                  place + Vec3(random.uniform_float(0, 0.5), 0, random.uniform_float(0, 0.5)));
    }
    return crowd;
}

template <int D>
Bench edges(const std::string& scene, std::function<Crowd<D>()> make) {
    return of_crowd<D>("broad/world/edges/" + scene, std::move(make), [](const Crowd<D>& crowd) -> Job {
        return {.tolerance = 1,  // touching is decided to within the tolerance
                .sides = {update("abut", crowd, true), update("abut without filter", crowd, false),
                          contacts_without_world(crowd)}};
    });
}

template <int D>
Bench threads(const std::string& scene, std::function<Crowd<D>()> make) {
    return of_crowd<D>("broad/world/threads/" + scene, std::move(make), [](const Crowd<D>& crowd) -> Job {
        return {.on_the_wall = true,
                .tolerance = 0,
                .sides = {update("abut, 2 threads", crowd, true, false, std::make_shared<ThreadPool>(2)),
                          update("abut", crowd, true, false)}};
    });
}

}  // namespace

std::vector<Bench> world_edge_benches() {
    return {
        threads<2>("sparse/2d", [] { return scattered<2>(10'000, 8); }),
        threads<3>("sparse/3d", [] { return scattered<3>(10'000, 20); }),
        threads<3>("pile/3d", [] { return thrown_onto_a_floor<3>(40); }),
        threads<3>("packed/3d/1700", [] { return packed<3>(1700, 12); }),
        edges<2>("sparse/2d", [] { return scattered<2>(10'000, 8); }),
        edges<3>("sparse/3d", [] { return scattered<3>(10'000, 20); }),
        edges<3>("floor/3d", on_a_floor),
        edges<3>("pile/3d", [] { return thrown_onto_a_floor<3>(40); }),
        edges<2>("packed/2d/400", [] { return packed<2>(400, 12); }),
        edges<2>("packed/2d/1600", [] { return packed<2>(1600, 12); }),
        edges<3>("packed/3d/1700", [] { return packed<3>(1700, 12); }),
    };
}

}  // namespace abut::bench
