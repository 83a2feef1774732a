#pragma once

// The rows of the broad phase.

#include "../bench.hpp"
#include "broad_peers.hpp"
#include "structures.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::bench {

inline constexpr std::uint64_t broad_seed = 1;

/// A scene over many frames, and its properties.
template <int D>
struct BoxFrames {
    std::size_t count = 0;  ///< count of boxes
    MakeScene<D> scene = nullptr;
    Upkeep upkeep = Upkeep::update;
    bool skewed = false;
    double moved = 1;  ///< fraction of the boxes that move
};

/// A job that counts all pairs of each frame: with every structure of the library, the textbook grid and every peer
/// whose limits admit the scene.
template <int D>
Job pairs_of_frames(const BoxFrames<D>& frames);

std::vector<Bench> frame_benches();
std::vector<Bench> box_query_benches();
std::vector<Bench> thread_benches();
std::vector<Bench> temporal_benches();
std::vector<Bench> world_benches();
/// A frame of a World in which all loose items move.
std::vector<Bench> world_frame_benches();
/// The cost of the filter of internal edges.
std::vector<Bench> world_edge_benches();
/// Many changes of a World and questions to it in one call.
std::vector<Bench> world_batch_benches();
/// The cost of a World's past.
std::vector<Bench> world_past_benches();
/// The cost of changes to a World, and of queries after them.
std::vector<Bench> world_change_benches();
/// The cost of changes to a World with a query after each.
std::vector<Bench> world_interleaved_benches();

}  // namespace abut::bench
