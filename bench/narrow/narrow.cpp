// Pairs of shapes: distances, overlap tests, contacts, intersections and ray casts. Each call starts cold, except in
// coherent rows: there each call is about the next frame of a motion, and sides may warm start.

#include "narrow.hpp"

#include <algorithm>
#include <iterator>

namespace abut::bench {

std::vector<Bench> narrow_benches() {
    std::vector<Bench> result;
    for (const auto& benches : {closest_benches(), overlaps_benches(), contact_benches(), plane_benches(),
                                raycast_benches(), solid_benches()})
        std::ranges::copy(benches, std::back_inserter(result));
    return result;
}

}  // namespace abut::bench
