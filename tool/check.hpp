#pragma once

// Which objects of a scene or a level touch, where, how deep and when.

#include "objects.hpp"
#include "progress.hpp"
#include "selection.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace abut::tool {

struct CheckOptions {
    float clearance = 0;              ///< pairs closer than this are found as well, unless they rest on one another
    std::optional<float> allow = {};  ///< how deep is nothing to speak of; by default 1e-3 of the smaller object's size
    std::vector<PairPattern> pairs = {};  ///< only those that one of these describes, either way round; none: all
};

/// One pair, over one unbroken interval of frames, at its deepest moment.
template <int D>
struct Finding {
    std::size_t a = 0, b = 0;                                 ///< objects; a < b, in the order of their paths
    std::size_t first = 0, last = 0, deepest = 0;             ///< frames
    float distance = std::numeric_limits<float>::infinity();  ///< signed
    float allow = 0;                                          ///< what was allowed of this pair then
    Vec<D> normal{};                                          ///< from a to b
    std::vector<Vec<D>> points;
    bool inside = false;  ///< a body is inside of the other, whose surface it meets nowhere, or no deeper than allowed
};

template <int D>
struct CheckResult {
    std::vector<Finding<D>> findings;  ///< sorted by pair and time
    std::uint64_t tested = 0;          ///< pairs looked at, over all frames
    std::uint64_t possible = 0;        ///< all pairs there are, over all frames
};

/// Takes the objects through the times, which it expects them to be at the first of. A pair of which neither moved
/// since the frame before isn't tested again. Progress is told in frames. A Problem where an object can't be placed.
template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress);

}  // namespace abut::tool
