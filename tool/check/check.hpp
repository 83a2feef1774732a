#pragma once

// Checks which objects of a scene or a level touch, where, how deep and when.

#include "tool/check/contact_findings.hpp"
#include "tool/check/pair_filter.hpp"
#include "tool/check/piles.hpp"
#include "tool/objects/objects.hpp"
#include "tool/shared/progress.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::tool {

struct CheckOptions {
    Limits limits;                        ///< pairs closer than the clearance are reported as well, unless they touch
    std::vector<PairPattern> pairs = {};  ///< only pairs that match one of these, in either order; empty: all
    std::vector<std::uint32_t> bodies = {};  ///< per object; pairs with equal numbers are not tested; empty: none are
    std::size_t max_findings = 100'000;      ///< only the deepest findings are reported beyond this
    std::size_t threads = 1;                 ///< the result is the same with any number
};

template <int D>
struct CheckResult {
    std::vector<ContactFinding<D>> findings;  ///< sorted by pair and time
    std::vector<Pile<D>> piles;               ///< their pairs are not among the findings
    std::uint64_t left_out = 0;               ///< count of findings beyond the maximum
    std::uint64_t tested = 0;                 ///< count of pair tests, over all frames
    std::uint64_t swept = 0;                  ///< count of pairs swept between frames, over all stages
    std::uint64_t possible = 0;               ///< count of all pairs, over all frames
};

/// Moves the objects through the times; they must be at the first one. A pair of which neither object moved since the
/// last frame isn't tested again. Between frames pairs are swept. Progress counts frames. Returns a Problem if an
/// object can't be placed, or too many pairs overlap.
template <int D>
Result<CheckResult<D>> check(Objects<D>& objects, const std::vector<double>& times, const CheckOptions& options,
                             ProgressCall progress);

}  // namespace abut::tool
