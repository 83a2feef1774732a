// Broad phase benches: pairs of moving boxes, queries of static boxes, and a World's update.

#include "broad.hpp"

#include <algorithm>
#include <iterator>

namespace abut::bench {

std::vector<Bench> broad_benches() {
    std::vector<Bench> result;
    for (const auto& benches : {frame_benches(), thread_benches(), box_query_benches(), temporal_benches(),
                                world_benches(), world_frame_benches(), world_edge_benches(), world_batch_benches(),
                                world_past_benches(), world_change_benches(), world_interleaved_benches()})
        std::ranges::copy(benches, std::back_inserter(result));
    return result;
}

}  // namespace abut::bench
