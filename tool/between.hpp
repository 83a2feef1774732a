#pragma once

// What meets between two frames.

#include "findings.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace abut::tool {

/// Follows the objects from one frame to the next, stage by stage: each pair that isn't found at the first frame is
/// swept, and where it meets it is looked at from there on, until it is apart again, whether it gets deeper than is
/// allowed.
template <int D>
class Between {
public:
    /// Refers to all of it.
    Between(const Objects<D>& objects, const Limits& limits, const Selection& selection)
        : objects_(objects), limits_(limits), near_(selection) {}

    /// One stage of the way that begins at a frame with these findings.
    std::optional<Problem> look_at(const Stage<D>& stage, const Findings<D>& at_first);

    /// Gives what was found on the way to the findings, which have come to the frame at its end by now: all but pairs
    /// that are found there too. The way began at the frame `first`.
    void end(std::size_t first, Findings<D>& findings);

    /// How many pairs were swept so far.
    std::uint64_t swept() const { return swept_; }

private:
    void look_at(const Pair& pair, const Stage<D>& stage, float clearance);
    void found(const Pair& pair, double first, double time, Meeting<D>&& meeting);

    const Objects<D>& objects_;
    const Limits& limits_;
    NearPairs<D> near_;
    std::vector<Aabb<D>> boxes_;
    std::map<Pair, Finding<D>> found_;
    std::uint64_t swept_ = 0;
};

}  // namespace abut::tool
