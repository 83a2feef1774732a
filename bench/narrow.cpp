// Pairs of shapes: distances, decisions, contacts, overlaps and rays. Each pair from nothing, but for those named
// coherent: there each call is about the next frame of a motion, and what a side can keep of the last one, it keeps.

#include "narrow.hpp"

#include <algorithm>
#include <iterator>

namespace abut::bench {

std::vector<Bench> narrow_benches() {
    std::vector<Bench> result;
    for (const auto& benches :
         {closest_benches(), overlaps_benches(), contact_benches(), plane_benches(), raycast_benches()})
        std::ranges::copy(benches, std::back_inserter(result));
    return result;
}

}  // namespace abut::bench
