#pragma once

// The rows about many boxes.

#include "bench.hpp"
#include "broad_peers.hpp"
#include "structures.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::bench {

inline constexpr std::uint64_t broad_seed = 1;

/// Many frames of a scene, and what is known of it.
template <int D>
struct BoxFrames {
    std::size_t count = 0;  ///< boxes
    MakeScene<D> scene = nullptr;
    Upkeep upkeep = Upkeep::update;
    bool skewed = false;
    double moved = 1;  ///< the share of the boxes that do
};

/// A job that counts all pairs of each frame: by every structure of the library, by the lesson's grid and by every peer
/// whose limits let it in.
template <int D>
Job pairs_of_frames(const BoxFrames<D>& frames);

std::vector<Bench> frame_benches();
std::vector<Bench> box_query_benches();
std::vector<Bench> thread_benches();
std::vector<Bench> temporal_benches();
std::vector<Bench> world_benches();
/// What changes to a World cost, and queries after them.
std::vector<Bench> world_change_benches();

}  // namespace abut::bench
