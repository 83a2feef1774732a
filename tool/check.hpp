#pragma once

// Which objects of a scene or a level touch, where, how deep and when.

#include "findings.hpp"
#include "objects.hpp"
#include "progress.hpp"
#include "selection.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::tool {

struct CheckOptions {
    Limits limits;  ///< pairs nearer than the clearance are found as well, unless they rest on one another
    std::vector<PairPattern> pairs = {};  ///< only those that one of these describes, either way round; none: all
    std::size_t max_findings = 100'000;   ///< of more, the deepest
};

template <int D>
struct CheckResult {
    std::vector<Finding<D>> findings;  ///< sorted by pair and time
    std::uint64_t left_out = 0;        ///< findings that there were beyond those
    std::uint64_t tested = 0;          ///< pairs looked at, over all frames
    std::uint64_t swept = 0;           ///< pairs followed from one frame to the next, over all stages of the way
    std::uint64_t possible = 0;        ///< all pairs there are, over all frames
};

/// Takes the objects through the times, which it expects them to be at the first of. A pair of which neither moved
/// since the frame before isn't tested again. Between the frames pairs are swept. Progress counts frames. A Problem
/// where an object can't be placed, or too many are in one place.
template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress);

}  // namespace abut::tool
